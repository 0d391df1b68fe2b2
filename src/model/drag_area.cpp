// How much of the air a link meets: the areas that its shapes throw as shadows along the link's axes, times
// drag coefficients by kind of shape (Hoerner, Fluid-Dynamic Drag, 1965, chapter 3: sphere .47, cube 1.05).
// Shapes that overlap count twice.
#include <cmath>

#include "core/fixed_math.h"
#include "model/compile_type.h"

namespace roboss {
namespace {

constexpr double kRound = 0.47, kAngular = 1.05;

/// Half of all faces' shadows: exact where the body is convex.
double mesh_shadow(const MeshSpec& mesh, const Vec3& d) {
    double twice = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        twice += 0.5 * std::fabs(dot(d, cross(b - a, c - a)));
    }
    return 0.5 * twice;
}

double prism_shadow(const GeometrySpec& g, const Vec3& d) {
    double area = 0, sides = 0;
    for (std::size_t i = 0; i < g.outline.size(); ++i) {
        const Vec3 &a = g.outline[i], &b = g.outline[(i + 1) % g.outline.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
        sides += 0.5 * g.length * std::fabs(d.x * (b.y - a.y) - d.y * (b.x - a.x));
    }
    return std::fabs(d.z * area) + sides;
}

/// The hull of an ellipse (the base) and a point (the tip), stretched to a circle. `z`: cosine of the angle
/// to the axis.
double cone_shadow(const GeometrySpec& g, double z) {
    const double r = g.radius, tip = g.length * std::sqrt(fixed_max(0.0, 1.0 - z * z));
    if (tip <= r * z) return kPi * r * r * z;
    const double share = r * z / tip;  // r / (distance of the tip), stretched
    return r * r * z * (kPi - fixed_acos(share)) + r * tip * std::sqrt(1.0 - share * share);
}

/// Shadow of the shape along the unit vector d of its own frame, m^2.
double shadow(const GeometrySpec& g, const Vec3& d) {
    const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
    const double disc = kPi * g.radius * g.radius;
    const double side = 2.0 * g.radius * g.length * std::sqrt(fixed_max(0.0, 1.0 - z * z));
    switch (g.kind) {
        case GeometryKind::kBox:
            return x * g.size.y * g.size.z + y * g.size.x * g.size.z + z * g.size.x * g.size.y;
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
            return g.mesh ? mesh_shadow(*g.mesh, d) : 0.0;
        case GeometryKind::kCone:
            return cone_shadow(g, z);
        case GeometryKind::kPolyline:
            return prism_shadow(g, d);
        default:
            return 0;
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
