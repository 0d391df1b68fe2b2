// LookFiles: materials of OGRE scripts. A <uri> names a script file, or a folder of scripts or pictures.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sdf/look_files.h"

namespace roboss::sdf_import {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kScriptBytesMax = 1u << 20;

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (file && !error && size <= kScriptBytesMax) text << file.rdbuf();
    return text.str();
}

/// The script itself, or the scripts of a folder in the order of their names.
std::vector<fs::path> scripts_of(const fs::path& path) {
    std::error_code error;
    if (fs::is_regular_file(path, error)) return {path};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path, error))
        if (entry.path().extension() == ".material") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

const OgreMaterials& LookFiles::scripts_in(const std::string& path) {
    const auto [entry, is_new] = scripts_.try_emplace(path);
    if (!is_new) return entry->second;
    for (const fs::path& file : scripts_of(path))
        for (auto& [name, material] : parse_material_script(content_of(file)))
            entry->second.insert_or_assign(name, std::move(material));
    return entry->second;
}

std::vector<std::string> LookFiles::script_places(const Element& script) const {
    std::vector<std::string> places;
    for (const auto node : script.node.children("uri")) {
        const Resolved found = paths_.resolve(node.text().get(), script.source->folder());
        if (found.path) places.push_back(*found.path);
    }
    return places;
}

std::optional<OgreMaterial> LookFiles::script_material(const Element& material, Diagnostics& diagnostics) {
    const Element script = material.child("script");
    const std::string name = script ? script.text("name") : "";
    if (name.empty()) return std::nullopt;
    for (const std::string& place : script_places(script)) {
        const OgreMaterials& known = scripts_in(place);
        if (const auto found = known.find(name); found != known.end()) return found->second;
    }
    if (const OgreMaterial* gazebo = gazebo_material(name)) return *gazebo;
    diagnostics.note(script.where(), "unknown-material",
                     "the material '" + name + "' is in no script that was found, and is none of Gazebo's",
                     "Write <diffuse>, or give the folder with its .material file as <uri>.");
    return std::nullopt;
}

std::shared_ptr<const PictureSpec> LookFiles::picture_of_script(const std::string& name,
                                                                const Element& material,
                                                                Diagnostics& diagnostics) {
    if (name.empty() || !opens_) return nullptr;
    const Element script = material.child("script");
    std::error_code error;
    for (const std::string& place : script_places(script)) {
        const fs::path folder =
            fs::is_directory(place, error) ? fs::path(place) : fs::path(place).parent_path();
        for (const fs::path& path : {folder / name, folder.parent_path() / "textures" / name})
            if (fs::is_regular_file(path, error))
                return open(path.string(), script.where(), "the material script names the picture",
                            diagnostics);
    }
    diagnostics.note(script.where(), "file-not-found",
                     "the picture '" + name + "' of the material '" + script.text("name") + "' was not found",
                     "Put it into materials/textures of the model. Until then it is drawn in plain colour.");
    return nullptr;
}

}  // namespace roboss::sdf_import
