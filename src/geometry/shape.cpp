// Bounds of the collision shapes; see shape_bounds.h.
#include "geometry/shape.h"

#include <algorithm>
#include <limits>

#include "core/fixed_math.h"
#include "geometry/shape_bounds.h"
#include "geometry/triangle_surface.h"

namespace roboss {
namespace {

constexpr double kGroundDepth = 10.0;  // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Aabb surface_bounds(const TriangleSurface& surface, const Transform& X_WS) {
    const Vec3 half = (surface.box().max - surface.box().min) * 0.5;
    const Vec3 centre = X_WS * surface.box().centre();
    const Mat3& R = X_WS.R;
    const Vec3 extent{extent::of_box(R.r0, half), extent::of_box(R.r1, half), extent::of_box(R.r2, half)};
    // What is below ground is in it.
    const Vec3 depth = surface.is_ground() ? R.col(2) * -kGroundDepth : Vec3{};
    Aabb box{centre - extent, centre + extent};
    box.include(Aabb{box.min + depth, box.max + depth});
    return box;
}

}  // namespace

Aabb bounds(const Shape& shape, const Transform& X_WS) {
    return shape.kind == ShapeKind::kSurface ? surface_bounds(*shape.surface, X_WS)
                                             : solid_bounds(shape, X_WS);
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
            return norm(Vec3{fixed_max(std::fabs(box.min.x), std::fabs(box.max.x)),
                             fixed_max(std::fabs(box.min.y), std::fabs(box.max.y)),
                             fixed_max(std::fabs(box.min.z), std::fabs(box.max.z))});
        }
    }
    return kInfinity;
}

}  // namespace roboss
