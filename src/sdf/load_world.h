// load_world: an SDFormat, URDF or MJCF file to a World, with every finding in `diagnostics`. Large worlds
// load fast: models that are equal but for name and pose are found, and each distinct one is read once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "world/world.h"

namespace roboss {

/// Where load_world() looks for files, and what it reads.
struct LoadOptions {
    /// Folders in which model://, package://, file:// and relative URIs are looked for, before those of the
    /// environment (docs/worlds.md).
    std::vector<std::string> search_paths;
    /// Name of the `<physics>` profile to use; empty: the one with `default="true"`, else the first.
    std::string profile{};
    /// Reads also what is only drawn: meshes and pictures of visuals. Without, such files are looked for, not
    /// opened.
    bool looks = true;
    /// Name or number of the keyframe of an MJCF file that the world starts from; empty: as the bodies stand.
    std::string keyframe{};
};

/// The world of `file` (its first one; a file with a model only becomes a world with that model), checked as
/// validate() does. nullopt if the file cannot be read as a world at all. A model with errors is left out of
/// the World, with an error "left-out" that names it: ask diagnostics.refuses() whether anything else is
/// wrong, or has_errors() to refuse such worlds too. Never throws and never prints.
std::optional<World> load_world(const std::string& file, const LoadOptions& options,
                                Diagnostics& diagnostics);

/// The same of a file's text. Diagnostics call it `name`; relative URIs start at the folder of `name`.
std::optional<World> load_world_text(const std::string& text, const std::string& name,
                                     const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace roboss
