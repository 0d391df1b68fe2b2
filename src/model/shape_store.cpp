// See the header. Everything here runs once, at compile.
#include "model/shape_store.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "geometry/height_field.h"
#include "geometry/hull_points.h"
#include "geometry/polygon_pieces.h"
#include "geometry/triangle_mesh.h"

namespace roboss {
namespace {

constexpr std::size_t kCostlyCorners = 500;
constexpr int kConeCorners = 128;   // of the rim: flatter by 0.03 % of the radius than a circle
constexpr double kThinnest = 1e-3;  // m, of the hull of a flat mesh

Shape primitive(ShapeKind kind, const GeometrySpec& geometry) {
    Shape shape;
    shape.kind = kind;
    shape.radius = geometry.radius;
    shape.half_length = 0.5 * geometry.length;
    shape.half = kind == ShapeKind::kEllipsoid ? geometry.size : geometry.size * 0.5;
    return shape;
}

double volume_of(const MeshSpec& mesh) {
    double six = 0;
    for (const auto& t : mesh.triangles)
        six += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    return six / 6.0;
}

/// The rim is as wide as a circle of the same area: the volume is the cone's own.
std::vector<Vec3> cone_corners(const GeometrySpec& geometry) {
    const double step = 2.0 * kPi / kConeCorners;
    const double radius = geometry.radius * std::sqrt(step / fixed_sin(step));
    std::vector<Vec3> corners{{0, 0, 0.5 * geometry.length}};
    for (int k = 0; k < kConeCorners; ++k)
        corners.push_back(
            {radius * fixed_cos(k * step), radius * fixed_sin(k * step), -0.5 * geometry.length});
    return corners;
}

}  // namespace

std::vector<PlacedShape> ShapeStore::shapes_of(const CollisionSpec& collision, bool is_static) {
    const GeometrySpec& geometry = collision.geometry;
    switch (geometry.kind) {
        case GeometryKind::kPlane:
            return {{primitive(ShapeKind::kPlane, geometry), {}}};
        case GeometryKind::kBox:
            return {{primitive(ShapeKind::kBox, geometry), {}}};
        case GeometryKind::kSphere:
            return {{primitive(ShapeKind::kSphere, geometry), {}}};
        case GeometryKind::kCylinder:
            return {{primitive(ShapeKind::kCylinder, geometry), {}}};
        case GeometryKind::kCapsule:
            return {{primitive(ShapeKind::kCapsule, geometry), {}}};
        case GeometryKind::kEllipsoid:
            return {{primitive(ShapeKind::kEllipsoid, geometry), {}}};
        case GeometryKind::kMesh:
            if (!geometry.mesh) return {};
            return is_static && !geometry.as_hull ? surface_of(collision) : hull_of(collision, is_static);
        case GeometryKind::kHeightmap:
            return geometry.heights ? height_field_of(collision, is_static) : std::vector<PlacedShape>{};
        case GeometryKind::kPolyline:
            return prisms_of(collision);
        case GeometryKind::kCone:
            return cone_of(collision);
    }
    return {};
}

PlacedShape ShapeStore::keep(ConvexHull hull) {
    model_.hulls.push_back(std::make_shared<const ConvexHull>(std::move(hull)));
    return {hull_shape(*model_.hulls.back()), model_.hulls.back()->centroid};
}

std::vector<PlacedShape> ShapeStore::hull_of(const CollisionSpec& collision, bool is_static) {
    const MeshSpec& mesh = *collision.geometry.mesh;
    if (const auto known = hulls_.find(&mesh); known != hulls_.end()) return {known->second};
    auto hull = build_hull(mesh.vertices);
    if (!hull) hull = mended_hull(collision);
    if (!hull) {
        diagnostics_.error(collision.where, "bad-mesh",
                           "the mesh '" + mesh.source + "' of collision '" + collision.name +
                               "' has no convex hull: " + hull.error().message,
                           hull.error().remedy);
        return {};
    }
    const double share = volume_of(mesh) / hull.value().volume;
    if (!is_static && !collision.geometry.as_hull && share < 0.999) {
        diagnostics_.note(collision.where, "mesh-as-hull",
                          "the mesh '" + mesh.source +
                              "' can move, so its convex hull collides, which fills its hollows (" +
                              std::to_string(std::lround(100 * std::max(share, 0.0))) +
                              " % of the hull is mesh)",
                          "If hollows matter, build the collision from several convex meshes or shapes.");
    }
    if (hull.value().vertices.size() > kCostlyCorners) {
        diagnostics_.note(collision.where, "costly-hull",
                          "the hull of '" + mesh.source + "' has " +
                              std::to_string(hull.value().vertices.size()) + " corners, which costs time",
                          "A collision mesh of a few dozen corners is enough for most bodies.");
    }
    return {hulls_.emplace(&mesh, keep(std::move(hull).value())).first->second};
}

/// Of a mesh that has no hull as it is: flat, or with more corners than a hull may have.
Result<ConvexHull> ShapeStore::mended_hull(const CollisionSpec& collision) {
    const MeshSpec& mesh = *collision.geometry.mesh;
    std::vector<Vec3> points = extreme_points(mesh.vertices);
    if (auto hull = build_hull(points)) {
        diagnostics_.note(collision.where, "coarse-hull",
                          "the convex hull of '" + mesh.source + "' is built of " +
                              std::to_string(points.size()) + " of its corners: all together make none",
                          "A collision mesh of a few dozen corners is enough for most bodies.");
        return hull;
    }
    auto hull = build_hull(thickened(points, kThinnest));
    if (hull)
        diagnostics_.note(collision.where, "flat-mesh",
                          "the mesh '" + mesh.source + "' of collision '" + collision.name +
                              "' is flat; it collides as if it were 1 mm thick",
                          "Give it a box or a mesh with a volume.");
    return hull;
}

std::vector<PlacedShape> ShapeStore::cone_of(const CollisionSpec& collision) {
    const std::pair size(collision.geometry.radius, collision.geometry.length);
    if (const auto known = cones_.find(size); known != cones_.end()) return {known->second};
    auto hull = build_hull(cone_corners(collision.geometry));
    if (!hull) {
        diagnostics_.error(
            collision.where, "bad-size",
            "the cone of collision '" + collision.name + "' is too flat or too thin to collide",
            "Use a cylinder.");
        return {};
    }
    return {cones_.emplace(size, keep(std::move(hull).value())).first->second};
}

std::vector<PlacedShape> ShapeStore::surface_of(const CollisionSpec& collision) {
    const MeshSpec& mesh = *collision.geometry.mesh;
    const auto [entry, is_new] = surfaces_.try_emplace(&mesh);
    if (is_new) {
        auto surface = std::make_shared<const TriangleMesh>(mesh.vertices, mesh.triangles);
        entry->second = surface_shape(*surface);
        model_.surfaces.push_back(std::move(surface));
    }
    return {{entry->second, {}}};
}

std::vector<PlacedShape> ShapeStore::height_field_of(const CollisionSpec& collision, bool is_static) {
    const HeightGridSpec& grid = *collision.geometry.heights;
    if (!is_static) {
        diagnostics_.error(collision.where, "movable-heightmap",
                           "collision '" + collision.name + "' is a heightmap in a model that can move",
                           "Make the model static.");
        return {};
    }
    const auto [entry, is_new] = surfaces_.try_emplace(&grid);
    if (is_new) {
        auto field = std::make_shared<const HeightField>(grid.columns, grid.rows, grid.heights, grid.size_x,
                                                         grid.size_y);
        entry->second = surface_shape(*field);
        model_.surfaces.push_back(std::move(field));
    }
    return {{entry->second, grid.centre}};
}

std::vector<PlacedShape> ShapeStore::prisms_of(const CollisionSpec& collision) {
    const auto bad = [&](const std::string& why) {
        diagnostics_.error(
            collision.where, "bad-polyline", "the polyline of collision '" + collision.name + "' " + why,
            "Write its corners in order round the outline, none crossing another, and a <height> "
            "greater than 0.");
    };
    const double height = collision.geometry.length;
    if (!(height > 0) || !std::isfinite(height))
        return bad("has a height that is not greater than 0"), std::vector<PlacedShape>{};
    const auto pieces = convex_pieces(collision.geometry.outline);
    if (!pieces) return bad(pieces.error().message), std::vector<PlacedShape>{};
    std::vector<PlacedShape> shapes;
    for (const std::vector<Vec3>& piece : pieces.value()) {
        std::vector<Vec3> corners;
        for (const Vec3& p : piece) corners.push_back({p.x, p.y, 0}), corners.push_back({p.x, p.y, height});
        auto hull = build_hull(corners);
        if (!hull) return bad("has a part without volume"), std::vector<PlacedShape>{};
        shapes.push_back(keep(std::move(hull).value()));
    }
    return shapes;
}

}  // namespace roboss
