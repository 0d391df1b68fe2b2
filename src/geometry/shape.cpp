// Bounds of the collision shapes in closed form. The radial extent of a disc along a world axis is taken from
// the other two entries of the rotation's row, which keeps all digits when the disc's axis is nearly that
// world axis.
#include "geometry/shape.h"

#include <limits>

namespace roboss {
namespace {

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
    }
    return {kInfinity, kInfinity, kInfinity};
}

}  // namespace

Aabb bounds(const Shape& shape, const Transform& X_WS) {
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
    }
    return kInfinity;
}

}  // namespace roboss
