// How much of the air a link meets: the areas that its shapes throw as shadows along the link's axes, times
// drag coefficients by kind of shape (Hoerner, Fluid-Dynamic Drag, 1965, chapter 3: sphere .47, cube 1.05).
// Shapes that overlap count twice; a mesh or polyline counts as the box around it.
#include <cmath>
#include <span>

#include "core/fixed_math.h"
#include "math/aabb.h"
#include "model/compile_type.h"

namespace roboss {
namespace {

constexpr double kRound = 0.47, kAngular = 1.05;

Vec3 extent_of(std::span<const Vec3> points) {
    Aabb box;
    for (const Vec3& p : points) box.include(p);
    return points.empty() ? Vec3{} : box.max - box.min;
}

double box_shadow(const Vec3& size, const Vec3& d) {
    return std::fabs(d.x) * size.y * size.z + std::fabs(d.y) * size.x * size.z +
           std::fabs(d.z) * size.x * size.y;
}

/// Shadow of the shape along the unit vector d of its own frame, m^2.
double shadow(const GeometrySpec& g, const Vec3& d) {
    const double z = std::fabs(d.z);
    const double disc = kPi * g.radius * g.radius;
    const double side = 2.0 * g.radius * g.length * std::sqrt(std::fmax(0.0, 1.0 - z * z));
    switch (g.kind) {
        case GeometryKind::kBox:
            return box_shadow(g.size, d);
        case GeometryKind::kSphere:
            return disc;
        case GeometryKind::kCylinder:
            return side + disc * z;
        case GeometryKind::kCapsule:
            return side + disc;
        case GeometryKind::kEllipsoid: {
            const Vec3 face{d.x * g.size.y * g.size.z, d.y * g.size.x * g.size.z, d.z * g.size.x * g.size.y};
            return kPi * norm(face);
        }
        case GeometryKind::kMesh:
            return g.mesh ? box_shadow(extent_of(g.mesh->vertices), d) : 0.0;
        case GeometryKind::kPolyline: {
            const Vec3 base = extent_of(g.outline);
            return box_shadow({base.x, base.y, g.length}, d);
        }
        default:
            return 0;  // planes and heightmaps do not move
    }
}

bool is_round(GeometryKind kind) {
    return kind == GeometryKind::kSphere || kind == GeometryKind::kEllipsoid;
}

}  // namespace

Vec3 drag_area(const LinkSpec& link) {
    const DragSpec& drag = link.drag;
    const double coefficient = drag.coefficient >= 0 ? drag.coefficient : kAngular;
    if (drag.area >= 0) return Vec3{1, 1, 1} * (coefficient * drag.area);
    Vec3 sum;
    for (const CollisionSpec& c : link.collisions) {
        const Mat3 R_LS = to_matrix(c.X_LS.q);
        const double factor = drag.coefficient >= 0       ? drag.coefficient
                              : is_round(c.geometry.kind) ? kRound
                                                          : kAngular;
        sum += Vec3{shadow(c.geometry, R_LS.r0), shadow(c.geometry, R_LS.r1), shadow(c.geometry, R_LS.r2)} *
               factor;
    }
    return sum;
}

}  // namespace roboss
