// ResourcePaths: URIs of models and meshes to files: model://, package://, file://, plain paths, and what of
// Gazebo Fuel is already on this machine. Nothing is fetched from the network. docs/worlds.md has the order.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace roboss::sdf_import {

struct Resolved {
    std::optional<std::string> path;
    std::vector<std::string> searched;  // in order; for the diagnostic
    bool remote = false;                // http(s), not found on this machine
};

class ResourcePaths {
  public:
    /// `first` before the folders that the environment names.
    explicit ResourcePaths(std::vector<std::string> first);

    /// A file or folder. `base` is the folder of the file that holds the URI.
    Resolved resolve(const std::string& uri, const std::string& base) const;

    /// As resolve, but a folder becomes the model file in it (model.config, else model.sdf).
    Resolved resolve_model(const std::string& uri, const std::string& base) const;

  private:
    /// A relative path; `has_scheme`: it was written as model://, package:// or file://.
    void look(const std::filesystem::path& path, const std::string& base, bool has_scheme,
              Resolved& result) const;
    Resolved resolve_remote(const std::string& uri, const std::string& base) const;
    std::vector<std::string> folders_;
};

/// "a, b and c" for messages; says so when nothing was searched.
std::string list_of(const std::vector<std::string>& paths);

}  // namespace roboss::sdf_import
