// load_mjcf: a file of MuJoCo (MJCF) to a World, with every finding in `diagnostics`. docs/worlds.md says
// what is read; decision 0028 says why it is read this way. load_world() calls it for files that begin with
// <mujoco>.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "world/world.h"
#include "xml/source_file.h"

namespace roboss {

/// Where load_mjcf() looks for files, and what it reads.
struct MjcfOptions {
    std::vector<std::string> search_paths;  ///< for meshes and pictures, after those that the file names
    bool looks = true;                      ///< reads also meshes that are only drawn
    std::string keyframe{};                 ///< to start from: name or number of a <key>; empty: none
};

/// The world of a file whose root element is <mujoco>, checked as validate() does. nullopt if it cannot be
/// used. Never throws and never prints.
std::optional<World> load_mjcf(std::unique_ptr<xml::SourceFile> file, const MjcfOptions& options,
                               Diagnostics& diagnostics);

}  // namespace roboss
