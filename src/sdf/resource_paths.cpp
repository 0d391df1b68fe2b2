// Looks for resources in the folders of --path and of the environment variables that Gazebo and ROS use.
#include "sdf/resource_paths.h"

#include <cstdlib>
#include <filesystem>
#include <pugixml.hpp>

#include "sdf/source_file.h"

namespace roboss::sdf_import {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariables[] = {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH",
                                      "GAZEBO_MODEL_PATH", "ROS_PACKAGE_PATH"};

bool starts_with(const std::string& text, const std::string& prefix) {
    return text.compare(0, prefix.size(), prefix) == 0;
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

void append_variable(const char* name, std::vector<std::string>& folders) {
    const char* value = std::getenv(name);
    if (value == nullptr) return;
    std::string rest = value;
    while (!rest.empty()) {
        const std::size_t colon = rest.find(':');
        if (colon != 0) folders.push_back(rest.substr(0, colon));
        rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
}

/// Tries candidates in order and notes them.
void try_path(const fs::path& candidate, Resolved& result) {
    if (result.path) return;
    const std::string text = candidate.lexically_normal().string();
    result.searched.push_back(text);
    if (is_there(candidate)) result.path = text;
}

/// Fuel's cache keeps a model as .../models/NAME/VERSION/: the highest version there.
std::optional<fs::path> newest_version(const fs::path& model) {
    std::optional<fs::path> newest;
    int highest = -1;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(model, ignored)) {
        const int number = std::atoi(entry.path().filename().c_str());
        if (entry.is_directory(ignored) && number > highest) {
            highest = number;
            newest = entry.path();
        }
    }
    return newest;
}

/// The model file that model.config names for the highest SDF version, else model.sdf.
fs::path model_file_in(const fs::path& folder) {
    pugi::xml_document config;
    std::string best;
    int best_version = -1;
    if (config.load_file((folder / "model.config").c_str())) {
        for (const auto sdf : config.document_element().children("sdf")) {
            const int version = parse_version(sdf.attribute("version").value());
            const std::string name = sdf.text().get();
            if (version > best_version && !name.empty()) {
                best_version = version;
                best = name;
            }
        }
    }
    return folder / (best.empty() ? "model.sdf" : best);
}

}  // namespace

std::string list_of(const std::vector<std::string>& paths) {
    if (paths.empty()) return "nowhere";
    std::string text;
    for (std::size_t i = 0; i < paths.size(); ++i) text += (i == 0 ? "" : ", ") + paths[i];
    return text;
}

ResourcePaths::ResourcePaths(std::vector<std::string> first) : folders_(std::move(first)) {
    for (const char* name : kVariables) append_variable(name, folders_);
}

Resolved ResourcePaths::resolve(const std::string& uri, const std::string& base) const {
    Resolved result;
    if (starts_with(uri, "http://") || starts_with(uri, "https://")) return resolve_remote(uri);
    if (starts_with(uri, "file://")) {
        const fs::path path = uri.substr(7);
        try_path(path.is_absolute() ? path : fs::path(base) / path, result);
        return result;
    }
    const std::size_t scheme = uri.find("://");
    const std::string rest = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    const fs::path path = rest;
    if (scheme == std::string::npos && path.is_absolute()) {
        try_path(path, result);
        return result;
    }
    try_path(fs::path(base) / path, result);
    // A folder "models" beside the world is where most projects keep them.
    if (scheme != std::string::npos) try_path(fs::path(base) / "models" / path, result);
    for (const std::string& folder : folders_) try_path(fs::path(folder) / path, result);
    // --path may name the model's own folder: model://car/meshes/a.stl is then <folder>/meshes/a.stl.
    for (const std::string& folder : folders_) {
        const fs::path own = (fs::path(folder) / ".").lexically_normal().parent_path();
        if (!path.empty() && own.filename() == *path.begin()) try_path(own.parent_path() / path, result);
    }
    return result;
}

Resolved ResourcePaths::resolve_remote(const std::string& uri) const {
    Resolved result;
    const fs::path rest = uri.substr(uri.find("://") + 3);
    // .../OWNER/models/NAME[/VERSION][/files/...]
    std::vector<std::string> parts(rest.begin(), rest.end());
    while (!parts.empty() && parts.back().empty()) parts.pop_back();
    std::size_t models = 0;
    while (models < parts.size() && parts[models] != "models") ++models;
    if (models >= 1 && models + 1 < parts.size()) {
        const std::string owner = parts[models - 1], name = parts[models + 1];
        std::vector<fs::path> caches;
        if (const char* cache = std::getenv("GZ_FUEL_CACHE_PATH")) caches.emplace_back(cache);
        if (const char* home = std::getenv("HOME")) {
            caches.push_back(fs::path(home) / ".gz" / "fuel");
            caches.push_back(fs::path(home) / ".ignition" / "fuel");
        }
        for (const fs::path& cache : caches) {
            const fs::path model = cache / parts.front() / owner / "models" / name;
            try_path(newest_version(model).value_or(model), result);
        }
        for (const std::string& folder : folders_) try_path(fs::path(folder) / name, result);
    }
    result.remote = !result.path;
    return result;
}

Resolved ResourcePaths::resolve_model(const std::string& uri, const std::string& base) const {
    Resolved result = resolve(uri, base);
    std::error_code ignored;
    if (!result.path || !fs::is_directory(*result.path, ignored)) return result;
    const fs::path file = model_file_in(*result.path);
    result.path.reset();
    try_path(file, result);
    return result;
}

}  // namespace roboss::sdf_import
