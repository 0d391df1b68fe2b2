// Pictures that a mesh names are looked for beside it, and where Gazebo's models have them.
#include "sdf/look_files.h"

#include <filesystem>

#include "mesh/picture_file.h"
#include "sdf/shape_files.h"

namespace roboss::sdf_import {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBytesMax = 128u << 20;
const char* const kPlain = "Until then it is drawn in plain colour.";

}  // namespace

std::shared_ptr<const PictureSpec> LookFiles::open(const std::string& path, const SourceLocation& where,
                                                   const std::string& whose, Diagnostics& diagnostics) {
    const auto [entry, is_new] = pictures_.try_emplace(path);
    if (!is_new || !opens_) return entry->second;
    return entry->second = keep(read_picture(path), path, where, whose, diagnostics);
}

std::shared_ptr<const PictureSpec> LookFiles::keep(Result<PictureSpec> picture, const std::string& path,
                                                   const SourceLocation& where, const std::string& whose,
                                                   Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& why, const std::string& remedy) {
        diagnostics.warning(where, "bad-picture", whose + " '" + path + "' " + why, remedy + " " + kPlain);
        return nullptr;
    };
    if (!picture) return refuse(picture.error().message, picture.error().remedy);
    if (bytes_ + picture.value().bytes.size() > kBytesMax)
        return refuse("is one too many: all pictures of a world have 128 MiB at most",
                      "Save them with fewer pixels, or as JPEG.");
    bytes_ += picture.value().bytes.size();
    return std::make_shared<const PictureSpec>(std::move(picture).value());
}

std::shared_ptr<const PictureSpec> LookFiles::picture(const Element& parent, const char* child,
                                                      Diagnostics& diagnostics) {
    const Element element = parent.child(child);
    const std::string uri(element.node.text().get());
    if (uri.empty()) return nullptr;
    const Resolved found = paths_.resolve(uri, element.source->folder());
    const std::string whose = "the picture of <" + std::string(child) + ">";
    if (found.path) return open(*found.path, element.where(), whose, diagnostics);
    diagnostics.warning(
        element.where(), "file-not-found",
        whose + " '" + uri + "' was not found; searched: " +
            (found.remote ? "Fuel's cache (nothing is fetched)" : list_of(found.searched)),
        "Give the folder that holds it with --path, or in GZ_SIM_RESOURCE_PATH. " + std::string(kPlain));
    return nullptr;
}

std::shared_ptr<const PictureSpec> LookFiles::picture_of_mesh(MeshPicture picture, const Element& mesh,
                                                              const GeometrySpec& spec,
                                                              Diagnostics& diagnostics) {
    const std::string& name = picture.name;
    if (name.empty()) return nullptr;
    const fs::path folder = fs::path(spec.uri).parent_path(), file = fs::path(name).filename();
    const std::string whose = "the mesh '" + spec.uri + "' names the picture";
    if (!picture.bytes.empty()) {
        const std::string source = spec.uri + "#" + name;
        const auto [entry, is_new] = pictures_.try_emplace(source);
        if (is_new)
            entry->second =
                keep(picture_in(std::move(picture.bytes), source), source, mesh.where(), whose, diagnostics);
        return entry->second;
    }
    for (const fs::path& path :
         {folder / name, folder / file, folder.parent_path() / "materials" / "textures" / file}) {
        std::error_code error;
        if (fs::is_regular_file(path, error)) return open(path.string(), mesh.where(), whose, diagnostics);
    }
    const Resolved found = paths_.resolve(name, folder.string());
    if (found.path) return open(*found.path, mesh.where(), whose, diagnostics);
    diagnostics.warning(mesh.where(), "file-not-found", whose + " '" + name + "', which was not found",
                        "Put it beside the mesh, or into ../materials/textures. " + std::string(kPlain));
    return nullptr;
}

const std::vector<MeshLook>& LookFiles::parts(const Element& mesh, const GeometrySpec& spec,
                                              Diagnostics& diagnostics) {
    const MeshRequest request = mesh_request(mesh, spec);
    const auto [entry, is_new] = meshes_.try_emplace(key_of(request));
    if (!is_new || !opens_) return entry->second;
    Result<std::vector<MeshPart>> read = read_mesh_parts(request);
    if (!read)
        diagnostics.warning(mesh.where(), "bad-mesh", "the mesh '" + spec.uri + "' " + read.error().message,
                            read.error().remedy + " Until then it is not drawn.");
    if (!read) return entry->second;
    for (MeshPart& part : read.value()) {
        MeshLook look{nullptr, part.rgb, part.alpha, {}};
        look.finish.colour = picture_of_mesh(std::move(part.colour), mesh, spec, diagnostics);
        look.finish.normal = picture_of_mesh(std::move(part.normal), mesh, spec, diagnostics);
        look.mesh = std::make_shared<const MeshSpec>(std::move(part.mesh));
        entry->second.push_back(std::move(look));
    }
    return entry->second;
}

}  // namespace roboss::sdf_import
