// How fast rotation moves the surface of a shape. Over T: one shape, or those of a few robots in lanes.
#pragma once

#include <cmath>

#include "core/lanes.h"
#include "geometry/convex_hull.h"
#include "geometry/shape.h"

namespace roboss {

/// Speed that a rotation `w` about the centre of a shape at orientation `R` adds to its surface, at most.
/// Rotation of a body of revolution about its axis moves no point of its surface outwards and does not count.
template <class T>
T turning_speed(const Shape& shape, const Mat3T<T>& R, const Vec3T<T>& w) {
    using std::sqrt;
    constexpr std::size_t kVerticesMax = 64;  // a hull of more is taken for a ball
    const Vec3T<T> l = transpose_times(R, w);
    T fastest = 0;
    switch (shape.kind) {
        case ShapeKind::kSphere:
        case ShapeKind::kPlane:
        case ShapeKind::kSurface:
            return T(0);
        case ShapeKind::kBox:
            for (const double x : {-1.0, 1.0})
                for (const double y : {-1.0, 1.0}) {
                    const Vec3 corner{x * shape.half.x, y * shape.half.y, shape.half.z};
                    fastest = larger(fastest, norm_squared(cross(l, broadcast<T>(corner))));
                }
            return sqrt(fastest);
        case ShapeKind::kCapsule:
            return sqrt(l.x * l.x + l.y * l.y) * T(shape.half_length);
        case ShapeKind::kCylinder:
            return sqrt(l.x * l.x + l.y * l.y) * T(bounding_radius(shape));
        case ShapeKind::kHull:
            if (shape.hull->vertices.size() > kVerticesMax) break;
            for (const Vec3& vertex : shape.hull->vertices)
                fastest = larger(fastest, norm_squared(cross(l, broadcast<T>(vertex))));
            return sqrt(fastest);
        case ShapeKind::kEllipsoid: {
            // A point of an ellipse of radii a and b has (d x p) = (a^2 - b^2) d1 d2 / h, at most |a - b|.
            const Vec3& r = shape.half;
            const T most = magnitude(l.x) * T(std::fabs(r.y - r.z)) +
                           magnitude(l.y) * T(std::fabs(r.x - r.z)) +
                           magnitude(l.z) * T(std::fabs(r.x - r.y));
            return smaller(most, norm(l) * T(bounding_radius(shape)));
        }
    }
    return norm(l) * T(bounding_radius(shape));
}

}  // namespace roboss
