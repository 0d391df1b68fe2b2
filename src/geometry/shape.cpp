// Bounds of the collision shapes in closed form. The radial extent of a disc along a world axis is taken from
// the other two entries of the rotation's row, which keeps all digits when the disc's axis is nearly that
// world axis.
#include "geometry/shape.h"

#include <algorithm>
#include <limits>

#include "geometry/convex_hull.h"
#include "geometry/triangle_surface.h"

namespace roboss {
namespace {

constexpr double kGroundDepth = 10.0;  // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double box_extent(const Vec3& row, const Vec3& half) {
    return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
}

double cylinder_extent(const Vec3& row, const Shape& s) {
    return std::fabs(row.z) * s.half_length + std::sqrt(row.x * row.x + row.y * row.y) * s.radius;
}

double capsule_extent(const Vec3& row, const Shape& s) {
    return std::fabs(row.z) * s.half_length + s.radius;
}

double ellipsoid_extent(const Vec3& row, const Vec3& radii) {
    return norm(Vec3{row.x * radii.x, row.y * radii.y, row.z * radii.z});
}

Aabb hull_bounds(const ConvexHull& hull, const Transform& X_WS) {
    Aabb box;
    for (const Vec3& v : hull.vertices) box.include(X_WS * v);
    return box;
}

Aabb surface_bounds(const TriangleSurface& surface, const Transform& X_WS) {
    const Vec3 half = (surface.box().max - surface.box().min) * 0.5;
    const Vec3 centre = X_WS * surface.box().centre();
    const Mat3& R = X_WS.R;
    const Vec3 extent{box_extent(R.r0, half), box_extent(R.r1, half), box_extent(R.r2, half)};
    // What is below ground is in it.
    const Vec3 depth = surface.is_ground() ? R.col(2) * -kGroundDepth : Vec3{};
    Aabb box{centre - extent, centre + extent};
    box.include(Aabb{box.min + depth, box.max + depth});
    return box;
}

Vec3 half_extents(const Shape& s, const Mat3& R) {
    switch (s.kind) {
        case ShapeKind::kPlane:
            return {kInfinity, kInfinity, kInfinity};
        case ShapeKind::kSphere:
            return {s.radius, s.radius, s.radius};
        case ShapeKind::kBox:
            return {box_extent(R.r0, s.half), box_extent(R.r1, s.half), box_extent(R.r2, s.half)};
        case ShapeKind::kCylinder:
            return {cylinder_extent(R.r0, s), cylinder_extent(R.r1, s), cylinder_extent(R.r2, s)};
        case ShapeKind::kCapsule:
            return {capsule_extent(R.r0, s), capsule_extent(R.r1, s), capsule_extent(R.r2, s)};
        case ShapeKind::kEllipsoid:
            return {ellipsoid_extent(R.r0, s.half), ellipsoid_extent(R.r1, s.half),
                    ellipsoid_extent(R.r2, s.half)};
        case ShapeKind::kHull:
        case ShapeKind::kSurface:
            break;
    }
    return {kInfinity, kInfinity, kInfinity};
}

}  // namespace

Aabb bounds(const Shape& shape, const Transform& X_WS) {
    if (shape.kind == ShapeKind::kHull) return hull_bounds(*shape.hull, X_WS);
    if (shape.kind == ShapeKind::kSurface) return surface_bounds(*shape.surface, X_WS);
    const Vec3 h = half_extents(shape, X_WS.R);
    return {X_WS.p - h, X_WS.p + h};
}

double bounding_radius(const Shape& shape) {
    switch (shape.kind) {
        case ShapeKind::kPlane:
            return kInfinity;
        case ShapeKind::kSphere:
            return shape.radius;
        case ShapeKind::kBox:
            return norm(shape.half);
        case ShapeKind::kCylinder:
            return std::sqrt(shape.radius * shape.radius + shape.half_length * shape.half_length);
        case ShapeKind::kCapsule:
            return shape.radius + shape.half_length;
        case ShapeKind::kEllipsoid:
            return std::max(shape.half.x, std::max(shape.half.y, shape.half.z));
        case ShapeKind::kHull:
            return shape.hull->radius;
        case ShapeKind::kSurface: {
            const Aabb& box = shape.surface->box();
            return norm(Vec3{std::fmax(std::fabs(box.min.x), std::fabs(box.max.x)),
                             std::fmax(std::fabs(box.min.y), std::fabs(box.max.y)),
                             std::fmax(std::fabs(box.min.z), std::fabs(box.max.z))});
        }
    }
    return kInfinity;
}

}  // namespace roboss
