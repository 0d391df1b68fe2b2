// FuelUri: the address of a model on Gazebo Fuel, and where its copy may lie on this machine. Nothing is
// fetched.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace roboss::sdf_import {

/// "%20" and the like as the characters they stand for.
std::string percent_decoded(const std::string& text);

/// The entry of `folder` with this name: the exact one, else one that differs in case only. nullopt: none.
std::optional<std::filesystem::path> entry_named(const std::filesystem::path& folder,
                                                 const std::string& name);

/// https://SERVER/1.0/OWNER/models/NAME[/VERSION][/files/FILE], all decoded.
struct FuelUri {
    std::string server, owner, name;
    std::optional<int> version;  // none: the newest ("tip")
    std::filesystem::path file;  // in the model; empty: the model itself

    /// nullopt: not the address of a model.
    static std::optional<FuelUri> parse(const std::string& uri);

    /// Where the model's copy lies under a cache folder, or would lie if it were there. Fuel's tools keep it
    /// as SERVER/OWNER/models/NAME/VERSION, owner and name in lower case, the server under its old or new
    /// name.
    std::filesystem::path model_in(const std::filesystem::path& cache) const;
};

/// The cache folders of this machine: GZ_FUEL_CACHE_PATH, IGN_FUEL_CACHE_PATH, ~/.gz/fuel, ~/.ignition/fuel.
std::vector<std::filesystem::path> fuel_caches();

}  // namespace roboss::sdf_import
