// Looks for resources in the folders of --path and of the environment variables that Gazebo and ROS use.
#include "sdf/resource_paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "sdf/fuel_cache.h"
#include "sdf/source_file.h"
#include "xml/source_file.h"

namespace roboss::sdf_import {
namespace {

namespace fs = std::filesystem;

/// Folders, separated by colons. AMENT_PREFIX_PATH holds packages in PREFIX/share.
struct Variable {
    const char* name;
    const char* within = "";
};
constexpr Variable kVariables[] = {{"SDF_PATH"},
                                   {"GZ_SIM_RESOURCE_PATH"},
                                   {"IGN_GAZEBO_RESOURCE_PATH"},
                                   {"GZ_FILE_PATH"},
                                   {"IGN_FILE_PATH"},
                                   {"GAZEBO_MODEL_PATH"},
                                   {"GAZEBO_RESOURCE_PATH"},
                                   {"GAZEBO_RESOURCE_PATH", "media/models"},
                                   {"GAZEBO_RESOURCE_PATH", "Media/models"},
                                   {"ROS_PACKAGE_PATH"},
                                   {"AMENT_PREFIX_PATH", "share"}};
constexpr int kFoldersAbove = 6;  // of the file that holds the URI

bool starts_with(const std::string& text, const std::string& prefix) {
    return text.compare(0, prefix.size(), prefix) == 0;
}

/// Only files and folders: a device such as /dev/zero has no end, and a pipe may never have a beginning.
bool is_there(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::is_regular_file(status) || fs::is_directory(status);
}

void append_variable(const Variable& variable, std::vector<std::string>& folders) {
    const char* value = std::getenv(variable.name);
    if (value == nullptr) return;
    std::string rest = value;
    while (!rest.empty()) {
        const std::size_t colon = rest.find(':');
        if (colon != 0) folders.push_back((fs::path(rest.substr(0, colon)) / variable.within).string());
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

/// As try_path, for one of many places that the diagnostic does not list.
void try_quietly(const fs::path& candidate, Resolved& result) {
    if (!result.path && is_there(candidate)) result.path = candidate.lexically_normal().string();
}

/// `base` and the folders above it, up to a repository's or six, the root never.
std::vector<fs::path> folders_above(const std::string& base) {
    std::error_code error;
    fs::path at = fs::absolute(base.empty() ? "." : base, error).lexically_normal();
    if (!at.has_filename()) at = at.parent_path();
    std::vector<fs::path> result;
    for (int i = 0; i <= kFoldersAbove && at.has_relative_path(); ++i, at = at.parent_path()) {
        result.push_back(at);
        if (is_there(at / ".git")) break;
    }
    return result;
}

/// As path under the folder, in upper or lower case as the folder has it: for files of systems where both are
/// one.
void try_any_case(fs::path folder, const fs::path& path, Resolved& result) {
    if (result.path) return;
    for (const fs::path& part : path) {
        if (part == "." || part == "..") {
            folder /= part;
        } else if (const auto entry = entry_named(folder, part.string())) {
            folder = *entry;
        } else {
            return;
        }
    }
    try_quietly(folder, result);
}

/// A path of somebody else's computer, /home/ada/car/meshes/a.stl: where its end, with a folder at least, is
/// below the folder of the file that names it, or that one's parent.
void try_end_of(const fs::path& absolute, const std::string& base, Resolved& result) {
    if (result.path) return;
    const fs::path here = fs::path(base.empty() ? "." : base);
    fs::path end = absolute.relative_path();
    for (; end.has_parent_path(); end = end.lexically_relative(*end.begin())) {
        try_quietly(here / end, result);
        try_quietly(here / ".." / end, result);
    }
}

std::string package_name(const fs::path& folder) {
    pugi::xml_document package;
    if (!package.load_file((folder / "package.xml").c_str())) return {};
    return package.document_element().child("name").text().get();
}

/// The folders that the package.xml in `folder` exports to Gazebo: <gazebo_ros gazebo_model_path="..."
/// gazebo_media_path="..."/>, with colons between them and ${prefix} for `folder`.
std::vector<fs::path> exported_folders(const fs::path& folder) {
    pugi::xml_document package;
    std::vector<fs::path> result;
    if (!package.load_file((folder / "package.xml").c_str())) return result;
    for (const auto gazebo : package.document_element().child("export").children())
        for (const char* name : {"gazebo_model_path", "gazebo_media_path"}) {
            std::istringstream paths(gazebo.attribute(name).value());
            for (std::string path; std::getline(paths, path, ':');) {
                const std::string prefix = "${prefix}";
                if (const std::size_t at = path.find(prefix); at != path.npos)
                    path.replace(at, prefix.size(), folder.string());
                if (!path.empty()) result.push_back(folder / path);
            }
        }
    return result;
}

/// In the folders that a package exports, or one that lies in `folder`.
void try_exports(const fs::path& folder, const fs::path& path, Resolved& result) {
    const auto try_package = [&](const fs::path& package) {
        for (const fs::path& exported : exported_folders(package)) try_quietly(exported / path, result);
    };
    if (result.path) return;
    try_package(folder);
    std::error_code error;
    std::vector<fs::path> inner;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (is_there(at->path() / "package.xml")) inner.push_back(at->path());
    std::ranges::sort(inner);
    for (const fs::path& package : inner) try_package(package);
}

/// Packages around the file, and beside the one that it is in.
void try_exports_above(const std::string& base, const fs::path& path, Resolved& result) {
    bool in_package = false;
    for (const fs::path& folder : folders_above(base)) {
        if (in_package || is_there(folder / "package.xml")) try_exports(folder, path, result);
        in_package |= is_there(folder / "package.xml");
    }
}

/// Where a model of a checked-out project names its neighbours, or a robot its own package: in a folder above
/// the file, in `models` of one, or in the ROS package around it whatever its folder is called.
void try_above(const std::string& base, const fs::path& path, Resolved& result) {
    if (result.path || path.empty()) return;
    result.searched.push_back("the folders above '" + base + "'");
    const fs::path inner = path.lexically_relative(*path.begin());
    for (const fs::path& folder : folders_above(base)) {
        try_quietly(folder / path, result);
        try_quietly(folder / "models" / path, result);
        if (!result.path && package_name(folder) == path.begin()->string())
            try_quietly(folder / inner, result);
    }
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
    for (const Variable& variable : kVariables) append_variable(variable, folders_);
}

Resolved ResourcePaths::resolve(const std::string& uri, const std::string& base) const {
    Resolved result;
    if (starts_with(uri, "http://") || starts_with(uri, "https://")) return resolve_remote(uri, base);
    const std::size_t scheme = uri.find("://");
    const bool is_file = starts_with(uri, "file://");
    fs::path path = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    if (path.is_absolute() && (is_file || scheme == std::string::npos)) {
        try_path(path, result);
        try_path(percent_decoded(path.string()), result);
        try_end_of(path, base, result);
        return result;
    }
    path = path.relative_path();  // model:///car is meant as model://car
    if (path.empty()) return result;
    look(path, base, scheme != std::string::npos, result);
    const fs::path decoded = percent_decoded(path.string());
    if (decoded != path) look(decoded, base, scheme != std::string::npos, result);
    return result;
}

void ResourcePaths::look(const fs::path& path, const std::string& base, bool has_scheme,
                         Resolved& result) const {
    try_path(fs::path(base) / path, result);
    // A folder "models" beside the world is where most projects keep them.
    if (has_scheme) try_path(fs::path(base) / "models" / path, result);
    for (const std::string& folder : folders_) try_path(fs::path(folder) / path, result);
    // --path may name the model's own folder: model://car/meshes/a.stl is then <folder>/meshes/a.stl.
    for (const std::string& folder : folders_) {
        const fs::path own = (fs::path(folder) / ".").lexically_normal().parent_path();
        if (own.filename() == *path.begin()) try_path(own.parent_path() / path, result);
    }
    if (has_scheme) try_above(base, path, result);
    if (has_scheme) {
        try_exports_above(base, path, result);
        for (const std::string& folder : folders_) try_exports(folder, path, result);
    }
    try_any_case(base, path, result);
    for (const std::string& folder : folders_) try_any_case(folder, path, result);
    if (has_scheme)
        for (const fs::path& folder : folders_above(base)) try_any_case(folder, path, result);
}

Resolved ResourcePaths::resolve_remote(const std::string& uri, const std::string& base) const {
    Resolved result;
    const auto fuel = FuelUri::parse(uri);
    if (fuel) {
        for (const fs::path& cache : fuel_caches()) try_path(fuel->model_in(cache) / fuel->file, result);
        for (const std::string& folder : folders_)
            if (const auto model = entry_named(folder, fuel->name)) try_path(*model / fuel->file, result);
        // A model often names its own files by their addresses.
        if (!fuel->file.empty()) {
            for (const fs::path& folder : folders_above(base))
                if (const auto model = entry_named(folder.parent_path(), fuel->name); model == folder)
                    try_path(folder / fuel->file, result);
        }
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
