// All shapes are convex, so a line meets each in one interval [enter, leave]: a box is the intersection of
// three slabs, a cylinder of a tube and a slab, a capsule the hull of a cylinder and two spheres. The tube
// and the sphere take the point of closest approach first, which keeps full precision for a small shape far
// away.
#include "sensors/ray_shape.h"

#include <cmath>
#include <limits>

#include "geometry/convex_hull.h"
#include "geometry/triangle_surface.h"
#include "sensors/infinity.h"

namespace roboss {
namespace {

struct Interval {
    double enter = -kInfinity;
    double leave = kInfinity;
    bool empty() const { return !(enter <= leave); }
};

constexpr Interval kEmpty{kInfinity, -kInfinity};

Interval intersection(const Interval& a, const Interval& b) {
    return {std::fmax(a.enter, b.enter), std::fmin(a.leave, b.leave)};
}

Interval hull(const Interval& a, const Interval& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::fmin(a.enter, b.enter), std::fmax(a.leave, b.leave)};
}

/// |o + t d| <= half, in one dimension.
Interval slab(double o, double d, double half) {
    if (std::fabs(d) < 1e-300) return std::fabs(o) <= half ? Interval{} : kEmpty;
    const double a = (-half - o) / d;
    const double b = (half - o) / d;
    return {std::fmin(a, b), std::fmax(a, b)};
}

Interval ball(const Vec3& o, const Vec3& d, double radius) {
    const double dd = dot(d, d);
    const double closest = -dot(o, d) / dd;
    const double room = radius * radius - norm_squared(o + d * closest);
    if (room < 0.0) return kEmpty;
    const double half = std::sqrt(room / dd);
    return {closest - half, closest + half};
}

/// The tube x^2 + y^2 <= radius^2.
Interval tube(const Vec3& o, const Vec3& d, double radius) {
    const Vec3 o2{o.x, o.y, 0}, d2{d.x, d.y, 0};
    if (norm_squared(d2) < 1e-30) return norm_squared(o2) <= radius * radius ? Interval{} : kEmpty;
    return ball(o2, d2, radius);
}

Interval polytope(const ConvexHull& hull, const Vec3& o, const Vec3& d) {
    Interval inside;
    for (const ConvexHull::Face& face : hull.faces) {
        const double height = dot(face.n, o) - face.offset, rise = dot(face.n, d);
        if (std::fabs(rise) < 1e-300) {
            if (height > 0.0) return kEmpty;
        } else if (rise < 0.0) {
            inside.enter = std::fmax(inside.enter, -height / rise);
        } else {
            inside.leave = std::fmin(inside.leave, -height / rise);
        }
    }
    return inside;
}

Interval cross_shape(const Shape& shape, const Vec3& o, const Vec3& d) {
    switch (shape.kind) {
        case ShapeKind::kPlane: {
            if (std::fabs(d.z) < 1e-300) return kEmpty;
            const double t = -o.z / d.z;
            return {t, t};
        }
        case ShapeKind::kSphere:
            return ball(o, d, shape.radius);
        case ShapeKind::kBox:
            return intersection(intersection(slab(o.x, d.x, shape.half.x), slab(o.y, d.y, shape.half.y)),
                                slab(o.z, d.z, shape.half.z));
        case ShapeKind::kCylinder:
            return intersection(tube(o, d, shape.radius), slab(o.z, d.z, shape.half_length));
        case ShapeKind::kCapsule: {
            const Vec3 end{0, 0, shape.half_length};
            const Interval middle = intersection(tube(o, d, shape.radius), slab(o.z, d.z, shape.half_length));
            return hull(hull(ball(o - end, d, shape.radius), ball(o + end, d, shape.radius)),
                        middle.empty() ? kEmpty : middle);
        }
        case ShapeKind::kEllipsoid: {  // stretched to the unit ball
            const Vec3& r = shape.half;
            return ball({o.x / r.x, o.y / r.y, o.z / r.z}, {d.x / r.x, d.y / r.y, d.z / r.z}, 1.0);
        }
        case ShapeKind::kHull:
            return polytope(*shape.hull, o, d);
        case ShapeKind::kSurface:
            break;
    }
    return kEmpty;
}

}  // namespace

double ray_distance(const Shape& shape, const Transform& X_WS, const Vec3& origin_W,
                    const Vec3& direction_W) {
    const Vec3 o = transpose_times(X_WS.R, origin_W - X_WS.p);
    const Vec3 d = transpose_times(X_WS.R, direction_W);
    if (shape.kind == ShapeKind::kSurface) return shape.surface->ray(o, d, kInfinity);
    const Interval inside = cross_shape(shape, o, d);
    if (inside.empty() || inside.leave < 0.0) return kInfinity;
    return inside.enter >= 0.0 ? inside.enter : inside.leave;
}

}  // namespace roboss
