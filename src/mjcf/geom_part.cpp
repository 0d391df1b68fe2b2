// Geoms: sizes are half lengths in MJCF; a geom stands for a collision, for a visual and for mass at once.
#include <algorithm>
#include <array>
#include <cmath>

#include "mjcf/orientation.h"
#include "mjcf/tree.h"

namespace roboss::mjcf {
namespace {

constexpr double kLeastVolume = 1e-14;  // m^3 or m^2; of MuJoCo (mjEPS)

using Size = std::array<double, 3>;

/// nullopt: a type that has no shape here.
std::optional<GeometryKind> kind_of(const Attributes& geom) {
    const std::string type = geom.text("type", "sphere");
    if (type == "sphere") return GeometryKind::kSphere;
    if (type == "capsule") return GeometryKind::kCapsule;
    if (type == "ellipsoid") return GeometryKind::kEllipsoid;
    if (type == "cylinder") return GeometryKind::kCylinder;
    if (type == "box") return GeometryKind::kBox;
    if (type == "mesh") return GeometryKind::kMesh;
    if (type == "plane") return GeometryKind::kPlane;
    if (type == "hfield") return GeometryKind::kHeightmap;
    if (type == "sdf")
        geom.diagnostics().warning(geom.where(), "unknown-shape", "a <geom> of type sdf does not collide",
                                   "Use a mesh.");
    else
        geom.bad_value("type", "plane, hfield, sphere, capsule, ellipsoid, cylinder, box or mesh");
    return std::nullopt;
}

/// Size and pose from the two ends of `fromto`.
void stretch(const Attributes& geom, GeometryKind kind, Size& size, Pose& X) {
    double ends[6];
    if (!geom.numbers("fromto", ends)) return;
    const Vec3 from{ends[0], ends[1], ends[2]}, to{ends[3], ends[4], ends[5]};
    const Vec3 along = from - to;
    if (norm(along) < 1e-14) return geom.bad_value("fromto", "two different points");
    X = {(from + to) * 0.5, from_z(along)};
    size[1] = norm(along) / 2;
    if (kind == GeometryKind::kBox || kind == GeometryKind::kEllipsoid) size[2] = size[1], size[1] = size[0];
}

void set_size(GeometryKind kind, const Size& size, GeometrySpec& shape) {
    shape.kind = kind;
    shape.radius = size[0];
    shape.length = 2 * size[1];
    const Vec3 all{size[0], size[1], size[2]};
    if (kind == GeometryKind::kEllipsoid) shape.size = all;
    if (kind == GeometryKind::kBox) shape.size = all * 2.0;
    if (kind == GeometryKind::kPlane)  // 0 is infinite; it is drawn 20 m wide
        shape.size = {size[0] > 0 ? 2 * size[0] : 20, size[1] > 0 ? 2 * size[1] : 20, 0};
}

/// How many numbers of `size` must be above 0.
std::size_t sizes_of(GeometryKind kind) {
    if (kind == GeometryKind::kSphere) return 1;
    if (kind == GeometryKind::kCapsule || kind == GeometryKind::kCylinder) return 2;
    return kind == GeometryKind::kBox || kind == GeometryKind::kEllipsoid ? 3 : 0;
}

/// The size of a primitive in place of a mesh, as MuJoCo fits it (mjCMesh::FitGeom): to the box of equal
/// inertia, or to the box around the mesh. `X` leads from the primitive to the mesh's frame.
void fit_primitive(const MeshAsset& asset, GeometryKind kind, const Settings& settings, double scale,
                   Size& size, Pose& X) {
    const InertiaBox box = inertia_box(*asset.solid);
    X = {asset.solid->centre, box.q};
    Vec3 half = box.half;
    const bool round = kind == GeometryKind::kCapsule || kind == GeometryKind::kCylinder;
    if (settings.fit_aabb) {
        Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
        for (const Vec3& vertex : asset.mesh->vertices) {
            const Vec3 p = inverse(X) * vertex;
            for (std::size_t k = 0; k < 3; ++k)
                low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
        }
        X = X * Pose{(low + high) * 0.5, {}};
        half = (high - low) * 0.5;
        size = {half.x, half.y, half.z};
        if (kind == GeometryKind::kSphere) size[0] = std::max({half.x, half.y, half.z});
        if (round) size = {std::max(half.x, half.y), half.z, 0};
        if (kind == GeometryKind::kCapsule) size[1] -= size[0];
    } else {
        size = {half.x, half.y, half.z};
        if (kind == GeometryKind::kSphere) size[0] = (half.x + half.y + half.z) / 3;
        if (round) size = {(half.x + half.y) / 2, half.z, 0};
        if (kind == GeometryKind::kCapsule) size[1] = std::max(0.0, half.z - size[0] / 2);
    }
    for (double& number : size) number *= scale;
}

/// Friction, by the number of directions that MuJoCo gives a contact (condim).
SurfaceSpec read_surface(const Attributes& geom) {
    double friction[3] = {1, 0.005, 0.0001};
    geom.overlay("friction", friction);
    const int condim = geom.integer("condim", 3);
    SurfaceSpec surface;
    surface.mu = surface.mu2 = condim >= 3 ? friction[0] : 0;
    // MuJoCo bounds the torque about the normal by friction[1] (m) times the normal force; here the bound is
    // 3 pi / 16 * torsional_mu * torsional_radius times the normal force.
    if (condim >= 4) surface.torsional_radius = friction[1] * 16 / (3 * kPi);
    if (condim >= 6) surface.rolling_mu = friction[2];
    return surface;
}

void read_colour(const Attributes& geom, Assets& assets, GeomPart& part) {
    double rgba[4] = {0.5, 0.5, 0.5, 1};
    if (const std::string name = geom.text("material"); !name.empty()) {
        if (const MaterialAsset* material = assets.material(name, geom))
            rgba[0] = material->rgb.x, rgba[1] = material->rgb.y, rgba[2] = material->rgb.z,
            rgba[3] = material->alpha;
    }
    geom.overlay("rgba", rgba);
    part.rgb = {rgba[0], rgba[1], rgba[2]};
    part.alpha = rgba[3];
}

/// Mass by `mass`, else by density.
std::optional<GeomMass> read_mass(const Attributes& geom, const std::optional<Solid>& solid, const Pose& X,
                                  int group) {
    if (!solid) return std::nullopt;
    const double density = geom.number("density", 1000);
    if (!geom.has("mass")) return GeomMass{placed(*solid, X, density), group};
    if (!(solid->volume > kLeastVolume)) return std::nullopt;
    return GeomMass{placed(*solid, X, geom.number("mass", 0) / solid->volume), group};
}

/// A shape that a mesh file gives; false: it cannot be read.
bool read_mesh_shape(const Attributes& geom, GeometryKind kind, bool needed, const Reading& reading,
                     Size& size, GeomPart& part, std::optional<Solid>& solid) {
    const std::string name = geom.text("mesh");
    if (name.empty()) {
        reading.diagnostics.error(geom.where(), "unknown-asset", "a <geom> of type mesh names no mesh",
                                  "Write its mesh attribute.");
        return false;
    }
    if (!needed && !reading.looks) return false;
    const MeshAsset* asset = reading.assets.mesh(name, geom, needed ? Severity::kError : Severity::kWarning);
    if (asset == nullptr) return false;
    if (kind == GeometryKind::kMesh) {
        solid = asset->solid;
        part.shape.mesh = asset->mesh;
        part.shape.uri = asset->mesh->source;
        part.shape.as_hull = true;  // MuJoCo collides with convex hulls only
        return true;
    }
    Pose X_fit;
    if (!asset->solid) return false;
    fit_primitive(*asset, kind, reading.settings, geom.number("fitscale", 1), size, X_fit);
    part.X_BG = part.X_BG * X_fit;
    return true;
}

void check_size(const Attributes& geom, GeometryKind kind, const Size& size) {
    for (std::size_t k = 0; k < sizes_of(kind); ++k) {
        if (size[k] > 0) continue;
        geom.diagnostics().error(geom.where(), "bad-size",
                                 "<geom type=\"" + geom.text("type", "sphere") + "\"> needs " +
                                     std::to_string(sizes_of(kind)) + " sizes above 0",
                                 "Write them in size: radius, half length, or half edges.");
        return;
    }
}

}  // namespace

GeomPart read_geom(const Attributes& geom, const Scope& scope, const Reading& reading) {
    GeomPart part;
    part.name = scope.names.full(geom.name());
    part.where = geom.where();
    part.group = geom.integer("group", 0);
    part.contype = static_cast<unsigned>(geom.integer("contype", 1));
    part.conaffinity = static_cast<unsigned>(geom.integer("conaffinity", 1));
    if (!reading.settings.contacts) part.contype = part.conaffinity = 0;
    part.surface = read_surface(geom);
    part.surface.category_bitmask = part.contype, part.surface.collide_bitmask = part.conaffinity;
    read_colour(geom, reading.assets, part);
    const auto kind = kind_of(geom);
    part.has_shape = kind.has_value();
    if (!kind) return part;
    Size size{};
    geom.overlay("size", size);
    part.X_BG = read_pose(geom, reading.settings);
    if (geom.has("fromto") && sizes_of(*kind) >= 2 && !geom.has("mesh"))
        stretch(geom, *kind, size, part.X_BG);
    part.X_BG = scope.X_BF * part.X_BG;
    std::optional<Solid> solid;
    const bool from_mesh = *kind == GeometryKind::kMesh || (geom.has("mesh") && sizes_of(*kind) > 0);
    const bool needed = part.collides() || scope.masses;
    if (from_mesh)
        part.has_shape = read_mesh_shape(geom, *kind, needed, reading, size, part, solid);
    else
        check_size(geom, *kind, size);
    set_size(*kind, size, part.shape);
    if (*kind == GeometryKind::kHeightmap) {
        part.shape.heights = reading.assets.height_field(geom.text("hfield"), geom);
        part.has_shape = part.shape.heights != nullptr;
    }
    if (*kind != GeometryKind::kMesh)
        solid = geom.boolean("shellinertia", false) ? shell_of(part.shape) : solid_of(part.shape);
    part.mass = read_mass(geom, solid, part.X_BG, part.group);
    return part;
}

}  // namespace roboss::mjcf
