// Bounds of the collision shapes in closed form. The radial extent of a disc along a world axis is taken from
// the other two entries of the rotation's row, which keeps all digits when the disc's axis is nearly that
// world axis.
#pragma once

#include "geometry/convex_hull.h"
#include "geometry/shape.h"

namespace roboss {
namespace extent {

template <class T>
T of_box(const Vec3T<T>& row, const Vec3& half) {
    return magnitude(row.x) * T(half.x) + magnitude(row.y) * T(half.y) + magnitude(row.z) * T(half.z);
}

template <class T>
T of_cylinder(const Vec3T<T>& row, const Shape& s) {
    using std::sqrt;
    return magnitude(row.z) * T(s.half_length) + sqrt(row.x * row.x + row.y * row.y) * T(s.radius);
}

template <class T>
T of_capsule(const Vec3T<T>& row, const Shape& s) {
    return magnitude(row.z) * T(s.half_length) + T(s.radius);
}

template <class T>
T of_ellipsoid(const Vec3T<T>& row, const Vec3& radii) {
    return norm(Vec3T<T>{row.x * T(radii.x), row.y * T(radii.y), row.z * T(radii.z)});
}

template <class T>
Vec3T<T> of(const Shape& s, const Mat3T<T>& R) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto along = [&](auto of_row, const auto& size) {
        return Vec3T<T>{of_row(R.r0, size), of_row(R.r1, size), of_row(R.r2, size)};
    };
    switch (s.kind) {
        case ShapeKind::kSphere:
            return {s.radius, s.radius, s.radius};
        case ShapeKind::kBox:
            return along(of_box<T>, s.half);
        case ShapeKind::kCylinder:
            return along(of_cylinder<T>, s);
        case ShapeKind::kCapsule:
            return along(of_capsule<T>, s);
        case ShapeKind::kEllipsoid:
            return along(of_ellipsoid<T>, s.half);
        case ShapeKind::kPlane:
        case ShapeKind::kHull:
        case ShapeKind::kSurface:
            break;
    }
    return {kInfinity, kInfinity, kInfinity};
}

/// By how far a hull reaches along d; in each lane by itself.
template <class T>
T of_hull(const Vec3T<T>& d, const ConvexHull& hull) {
    if constexpr (std::is_same_v<T, double>) {
        return hull.reach(d);
    } else {
        T result{};
        for (std::size_t i = 0; i < kLanesOf<T>; ++i)
            set_lane(result, i, hull.reach({lane(d.x, i), lane(d.y, i), lane(d.z, i)}));
        return result;
    }
}

}  // namespace extent

/// Box in W of a shape at X_WS, of any kind but a surface; see bounds().
template <class T>
AabbT<T> solid_bounds(const Shape& shape, const TransformT<T>& X_WS) {
    if (shape.kind == ShapeKind::kHull) {
        // Where there are no cells, one look at each vertex serves all six directions.
        if (shape.hull->cells.empty()) {
            AabbT<T> box;
            for (const Vec3& v : shape.hull->vertices) box.include(X_WS * broadcast<T>(v));
            return box;
        }
        const Mat3T<T>& R = X_WS.R;
        const auto reach = [&](const Vec3T<T>& d) { return extent::of_hull(d, *shape.hull); };
        return {X_WS.p - Vec3T<T>{reach(-R.r0), reach(-R.r1), reach(-R.r2)},
                X_WS.p + Vec3T<T>{reach(R.r0), reach(R.r1), reach(R.r2)}};
    }
    const Vec3T<T> h = extent::of(shape, X_WS.R);
    return {X_WS.p - h, X_WS.p + h};
}

}  // namespace roboss
