// Geometry and collisions.
#include <cstring>

#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

/// The shortest rotation that turns z into the unit vector n.
Quat from_z_to(const Vec3& n) {
    if (n.z < -1.0 + 1e-12) return {0, 1, 0, 0};
    return normalized(Quat{1.0 + n.z, -n.y, n.x, 0.0});
}

void read_plane(const Element& plane, const Import& import, GeometrySpec& spec, Pose& X) {
    const Vec3 normal = import.reader.vector(plane, "normal", {0, 0, 1});
    const double length = norm(normal);
    if (length < 1e-12) {
        import.diagnostics().error(plane.where(), "bad-value", "the <normal> of a plane has no length",
                                   "Write a direction, for instance 0 0 1.");
    } else {
        X.q = X.q * from_z_to(normal / length);
    }
    const auto words = words_of(plane.node.child("size").text().get());
    const auto x = words.size() == 2 ? parse_number(words[0]) : std::nullopt;
    const auto y = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    spec.size = {x.value_or(1), y.value_or(1), 0};
}

/// The file behind <uri>; a missing one is reported with the places searched: an error where it should
/// collide.
bool find_file(const Element& shape, GeometryUse use, const Import& import, GeometrySpec& spec) {
    const std::string uri = shape.text("uri");
    const Resolved found = import.paths.resolve(uri, shape.source->folder());
    spec.uri = found.path.value_or(uri);
    if (found.path) return true;
    import.diagnostics().add(
        {use == GeometryUse::kCollide ? Severity::kError : Severity::kWarning, shape.where(),
         "file-not-found",
         "the " + std::string(shape.node.name()) + " '" + uri + "' was not found; searched: " +
             (found.remote ? "Fuel's cache (nothing is fetched)" : list_of(found.searched)),
         "Give the folder that holds it with --path, or in GZ_SIM_RESOURCE_PATH."});
    return false;
}

bool read_shape(const Element& shape, GeometryUse use, const Import& import, GeometrySpec& spec, Pose& X) {
    const ElementReader& reader = import.reader;
    const std::string kind = shape.node.name();
    spec.radius = reader.number(shape, "radius", 1);
    spec.length = reader.number(shape, "length", 1);
    if (kind == "box") {
        spec.kind = GeometryKind::kBox;
        spec.size = reader.vector(shape, "size", {1, 1, 1});
    } else if (kind == "sphere") {
        spec.kind = GeometryKind::kSphere;
    } else if (kind == "cylinder") {
        spec.kind = GeometryKind::kCylinder;
    } else if (kind == "capsule") {
        spec.kind = GeometryKind::kCapsule;
    } else if (kind == "cone") {
        spec.kind = GeometryKind::kCone;
        spec.radius = reader.number(shape, "radius", 0.5);
    } else if (kind == "ellipsoid") {
        spec.kind = GeometryKind::kEllipsoid;
        spec.size = reader.vector(shape, "radii", {1, 1, 1});
    } else if (kind == "plane") {
        spec.kind = GeometryKind::kPlane;
        read_plane(shape, import, spec, X);
    } else if (kind == "mesh") {
        spec.kind = GeometryKind::kMesh;
        spec.scale = reader.vector(shape, "scale", {1, 1, 1});
        if (find_file(shape, use, import, spec) && use == GeometryUse::kCollide)
            import.files.read_mesh(shape, import.diagnostics(), spec);
    } else if (kind == "heightmap") {
        spec.kind = GeometryKind::kHeightmap;
        spec.size = reader.vector(shape, "size", {1, 1, 1});
        if (find_file(shape, use, import, spec) && (use == GeometryUse::kCollide || import.looks.opens()))
            import.files.read_heightmap(shape, reader, use, spec);
    } else if (kind == "polyline") {
        spec.kind = GeometryKind::kPolyline;
        spec.length = reader.number(shape, "height", 1);
        read_polyline(shape, reader, spec);
    } else {
        return false;
    }
    return true;
}

/// The shape element of a <geometry>: its first child that is not of another namespace.
Element shape_of(const Element& geometry) {
    for (const auto node : geometry.node.children()) {
        if (node.type() == pugi::node_element && std::strchr(node.name(), ':') == nullptr)
            return {geometry.source, node};
    }
    return {};
}

/// Contact points of URDF are spheres of radius 0, plates boxes of height 0.
void give_size(CollisionSpec& spec, const Import& import) {
    constexpr double kLeast = 1e-3;  // m
    GeometrySpec& g = spec.geometry;
    std::vector<double*> sizes;
    if (g.kind == GeometryKind::kBox || g.kind == GeometryKind::kEllipsoid)
        sizes = {&g.size.x, &g.size.y, &g.size.z};
    if (g.kind == GeometryKind::kSphere) sizes = {&g.radius};
    if (g.kind == GeometryKind::kCylinder || g.kind == GeometryKind::kCapsule ||
        g.kind == GeometryKind::kCone)
        sizes = {&g.radius, &g.length};
    bool given = false;
    for (double* size : sizes) {
        if (*size != 0) continue;
        *size = kLeast;
        given = true;
    }
    if (given)
        import.diagnostics().warning(
            spec.where, "no-size",
            "collision '" + spec.name + "' has a size of 0; it collides with 1 mm instead",
            "Write its size, or remove it.");
}

void does_not_collide(const Element& shape, const Import& import) {
    import.diagnostics().warning(shape.where(), "unknown-shape",
                                 "shapes of kind <" + std::string(shape.node.name()) + "> do not collide",
                                 "Build the collision from other shapes, or give it as a mesh.");
}

}  // namespace

std::optional<GeometrySpec> convert_geometry(const Element& geometry, GeometryUse use, const Import& import,
                                             Pose& X) {
    const Element shape = shape_of(geometry);
    GeometrySpec spec;
    if (!shape || !read_shape(shape, use, import, spec, X)) return std::nullopt;
    return spec;
}

std::optional<CollisionSpec> convert_collision(const Element& collision, const Pose& X_LS,
                                               const Import& import) {
    CollisionSpec spec;
    spec.name = collision.name();
    spec.where = collision.where();
    spec.X_LS = X_LS;
    const Element geometry = collision.child("geometry");
    const Element shape = shape_of(geometry);
    const auto known = convert_geometry(geometry, GeometryUse::kCollide, import, spec.X_LS);
    if (!known) {
        if (!shape) {
            import.diagnostics().warning(collision.where(), "no-geometry",
                                         "collision '" + spec.name + "' has no shape",
                                         "Give it a <geometry>, or remove it.");
        } else if (std::strcmp(shape.node.name(), "empty") != 0) {
            does_not_collide(shape, import);
        }
        return std::nullopt;
    }
    spec.geometry = *known;
    give_size(spec, import);
    spec.surface = convert_surface(collision, import);
    spec.moves = takes_part_in_motion(collision);
    spec.laser_retro = import.reader.number(collision, "laser_retro", 0);
    return spec;
}

}  // namespace roboss::sdf_import
