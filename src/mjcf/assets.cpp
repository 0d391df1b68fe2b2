// See assets.h.
#include "mjcf/assets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/similar.h"
#include "mesh/mesh_file.h"
#include "mesh/msh_file.h"
#include "mesh/obj_points.h"
#include "mjcf/orientation.h"

namespace roboss::mjcf {
namespace {

namespace fs = std::filesystem;

/// The name of an asset that has none: that of its file.
std::string name_of(const Attributes& asset) {
    if (!asset.name().empty()) return asset.name();
    return fs::path(asset.text("file")).stem().string();
}

MaterialAsset read_material(const Attributes& source) {
    double rgba[4] = {1, 1, 1, 1};
    source.overlay("rgba", rgba);
    return {{rgba[0], rgba[1], rgba[2]}, rgba[3], source.text("texture")};
}

MeshInertia read_inertia_kind(const Attributes& source) {
    const std::string kind = source.text("inertia", "legacy");
    if (kind == "exact") return MeshInertia::kExact;
    if (kind == "convex") return MeshInertia::kConvex;
    if (kind == "shell") return MeshInertia::kShell;
    if (kind != "legacy") source.bad_value("inertia", "legacy, exact, convex or shell");
    return MeshInertia::kLegacy;
}

/// refpos, refquat and scale, in this order.
void transform(const Attributes& source, MeshSpec& mesh) {
    const Vec3 origin = source.vector("refpos", {}), scale = source.vector("scale", {1, 1, 1});
    double quat[4] = {1, 0, 0, 0};
    source.numbers("refquat", quat);
    const Mat3 R = to_matrix(normalized(Quat{quat[0], quat[1], quat[2], quat[3]}));
    for (Vec3& vertex : mesh.vertices) {
        const Vec3 p = transpose(R) * (vertex - origin);
        vertex = {p.x * scale.x, p.y * scale.y, p.z * scale.z};
    }
    if (scale.x * scale.y * scale.z < 0)
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

template <class Map>
std::vector<std::string> names_in(const Map& map) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : map) names.push_back(name);
    return names;
}

void report_unknown(const char* what, const std::string& name, const std::vector<std::string>& names,
                    Severity severity, const Attributes& user) {
    user.diagnostics().add({severity, user.where(), "unknown-asset",
                            "<" + std::string(user.element().node.name()) + "> names the " + what + " '" +
                                name + "', which the file does not have",
                            did_you_mean(name, names, "Add it to <asset>.")});
}

/// Whether the file's name ends so, in letters of either case.
bool has_ending(const std::string& path, std::string_view ending) {
    std::string found = fs::path(path).extension().string();
    for (char& c : found) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return found == ending;
}

/// The vertices and faces that the element itself holds.
std::optional<MeshSpec> triangles_in(const Attributes& source, Diagnostic& problem) {
    const std::vector<double> numbers = source.list("vertex"), faces = source.list("face");
    problem.message = "vertex and face of the mesh '" + source.name() + "' do not fit together";
    problem.remedy =
        "Write three coordinates for each vertex, at least four vertices, and three numbers for each face.";
    if (numbers.size() % 3 != 0 || numbers.size() < 12 || faces.size() % 3 != 0) return std::nullopt;
    const auto stored = [](double x) {
        return static_cast<double>(static_cast<float>(x));
    };  // as MuJoCo does
    MeshSpec mesh;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        mesh.vertices.push_back({stored(numbers[i]), stored(numbers[i + 1]), stored(numbers[i + 2])});
    const auto count = static_cast<double>(mesh.vertices.size());
    if (!std::ranges::all_of(faces, [&](double v) { return v >= 0 && v < count; })) return std::nullopt;
    for (std::size_t i = 0; i < faces.size(); i += 3)
        mesh.triangles.push_back({static_cast<std::uint32_t>(faces[i]),
                                  static_cast<std::uint32_t>(faces[i + 1]),
                                  static_cast<std::uint32_t>(faces[i + 2])});
    return mesh;
}

}  // namespace

Assets::Assets(const Document& document, const Defaults& defaults, const Settings& settings,
               std::vector<std::string> search_paths, Diagnostics& diagnostics)
    : document_(document),
      settings_(settings),
      search_paths_(std::move(search_paths)),
      diagnostics_(diagnostics) {
    for (const Element& element : document.in_sections("asset")) {
        const std::string kind = element.node.name();
        if (kind != "mesh" && kind != "hfield" && kind != "material") continue;
        const Attributes source = defaults.of(element);
        if (kind == "mesh") mesh_sources_.emplace(name_of(source), source);
        if (kind == "hfield") height_sources_.emplace(name_of(source), source);
        if (kind == "material") materials_.emplace(source.name(), read_material(source));
    }
}

const MaterialAsset* Assets::material(const std::string& name, const Attributes& user) {
    const auto found = materials_.find(name);
    if (found != materials_.end()) return &found->second;
    report_unknown("material", name, names_in(materials_), Severity::kWarning, user);
    return nullptr;
}

std::optional<std::string> Assets::find_file(const std::string& name, const Attributes& asset,
                                             Diagnostic& problem) const {
    const fs::path file = settings_.strip_path ? fs::path(name).filename() : fs::path(name);
    const std::string& folder = settings_.mesh_folder;
    std::vector<fs::path> places{fs::path(document_.folder()) / folder / file,
                                 fs::path(document_.folder()) / file,
                                 fs::path(asset.element().source->folder()) / folder / file};
    for (const std::string& path : search_paths_) {
        places.push_back(fs::path(path) / folder / file);
        places.push_back(fs::path(path) / file);
    }
    std::error_code error;
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error)) return place.string();
    problem.code = "file-not-found";
    problem.message = "the file '" + name + "' of <" + asset.element().node.name() +
                      "> was not found; searched: '" + places.front().parent_path().string() +
                      "' and the folders of --path";
    problem.remedy = "Correct its path, or meshdir of <compiler>; or give its folder with --path.";
    return std::nullopt;
}

std::optional<MeshSpec> Assets::triangles_of(const Attributes& source, Diagnostic& problem) {
    const std::string file = source.text("file");
    problem.code = "bad-mesh";
    if (file.empty()) {
        if (source.has("vertex")) return triangles_in(source, problem);
        problem.message = "the mesh '" + source.name() + "' has neither a file nor vertices";
        if (source.has("builtin")) problem.message += "; builtin meshes are not made here";
        problem.remedy = "Save it as an STL or OBJ file and name that.";
        return std::nullopt;
    }
    const auto path = find_file(file, source, problem);
    if (!path) return std::nullopt;
    if (has_ending(*path, ".msh")) {
        Result<MeshSpec> read = read_msh(*path);
        if (read) return std::move(read).value();
        problem.message = "the mesh '" + *path + "' " + read.error().message;
        problem.remedy = read.error().remedy;
        return std::nullopt;
    }
    MeshRequest request;
    request.path = *path;
    Result<MeshFile> read = read_mesh(request);
    if (read) return std::move(read.value().mesh);
    if (has_ending(*path, ".obj"))
        if (Result<MeshSpec> points = read_obj_points(*path)) return std::move(points).value();
    problem.message = "the mesh '" + *path + "' " + read.error().message;
    problem.remedy = read.error().remedy;
    return std::nullopt;
}

void Assets::load(const Attributes& source, MeshAsset& asset) {
    Diagnostic problem;
    problem.where = source.where();
    std::optional<MeshSpec> mesh = triangles_of(source, problem);
    if (mesh) transform(source, *mesh);
    if (mesh && mesh->triangles.empty()) mesh = hull_of(*mesh);
    if (!mesh) {
        asset.problem = std::move(problem);
        return;
    }
    asset.solid = mesh_solid(*mesh, read_inertia_kind(source));
    if (mesh->source.empty()) mesh->source = name_of(source);
    asset.mesh = std::make_shared<const MeshSpec>(std::move(*mesh));
}

const MeshAsset* Assets::mesh(const std::string& name, const Attributes& user, Severity severity) {
    const auto source = mesh_sources_.find(name);
    if (source == mesh_sources_.end()) {
        report_unknown("mesh", name, names_in(mesh_sources_), severity, user);
        return nullptr;
    }
    const auto [entry, is_new] = meshes_.try_emplace(name);
    MeshAsset& asset = entry->second;
    if (is_new) load(source->second, asset);
    if (!asset.problem) return &asset;
    Diagnostic problem = *asset.problem;
    problem.severity = severity;
    if (severity != Severity::kError) problem.remedy += " Until then it is not drawn.";
    diagnostics_.add(std::move(problem));
    return nullptr;
}

}  // namespace roboss::mjcf
