// Where a line is inside a shape, in closed form, over a number T: double, or Lanes of doubles with the same
// bits. All shapes but surfaces are convex, so a line meets each in one interval [enter, leave]: a box is the
// intersection of three slabs, a cylinder of a tube and a slab, a capsule the hull of a cylinder and two
// spheres. The tube and the sphere take the point of closest approach first, which keeps full precision for a
// small shape far away.
#pragma once

#include "core/lanes.h"
#include "geometry/convex_hull.h"
#include "geometry/shape.h"
#include "sensors/infinity.h"

namespace roboss::ray_shapes {

template <class T>
T root(const T& x) {
    using std::sqrt;
    return sqrt(x);
}

template <class T>
struct Interval {
    T enter{-kInfinity}, leave{kInfinity};

    static Interval none() { return {T(kInfinity), T(-kInfinity)}; }
    MaskOf<T> empty() const { return !(enter <= leave); }
};

template <class T>
Interval<T> choose(const MaskOf<T>& m, const Interval<T>& a, const Interval<T>& b) {
    return {select(m, a.enter, b.enter), select(m, a.leave, b.leave)};
}

template <class T>
Interval<T> intersection(const Interval<T>& a, const Interval<T>& b) {
    return {larger(a.enter, b.enter), smaller(a.leave, b.leave)};
}

template <class T>
Interval<T> hull(const Interval<T>& a, const Interval<T>& b) {
    const Interval<T> both{smaller(a.enter, b.enter), larger(a.leave, b.leave)};
    return choose(a.empty(), b, choose(b.empty(), a, both));
}

/// |o + t d| <= half, in one dimension.
template <class T>
Interval<T> slab(const T& o, const T& d, const T& half) {
    const auto flat = magnitude(d) < T(1e-300);
    const T safe = select(flat, T(1), d);
    const T a = (-half - o) / safe, b = (half - o) / safe;
    const Interval<T> crossed{smaller(a, b), larger(a, b)};
    if (!any(flat)) return crossed;
    return choose(flat, choose(magnitude(o) <= half, Interval<T>{}, Interval<T>::none()), crossed);
}

template <class T>
Interval<T> ball(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius) {
    const T dd = dot(d, d);
    const T closest = -dot(o, d) / dd;
    const T room = radius * radius - norm_squared(o + d * closest);
    const auto missed = room < T(0);
    const T half = root(select(missed, T(0), room) / dd);
    return choose(missed, Interval<T>::none(), Interval<T>{closest - half, closest + half});
}

/// The tube x^2 + y^2 <= radius^2.
template <class T>
Interval<T> tube(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius) {
    const Vec3T<T> o2{o.x, o.y, T(0)}, d2{d.x, d.y, T(0)};
    const auto along = norm_squared(d2) < T(1e-30);
    const Vec3T<T> safe{select(along, T(1), d2.x), d2.y, T(0)};
    const Interval<T> crossed = ball(o2, safe, radius);
    if (!any(along)) return crossed;
    const auto in = norm_squared(o2) <= radius * radius;
    return choose(along, choose(in, Interval<T>{}, Interval<T>::none()), crossed);
}

template <class T>
Interval<T> polytope(const ConvexHull::Face* faces, std::size_t count, const Vec3T<T>& o, const Vec3T<T>& d) {
    constexpr double kFlat = 1e-300;
    Interval<T> inside;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3T<T> n = broadcast<T>(faces[i].n);
        const T height = dot(n, o) - T(faces[i].offset), rise = dot(n, d);
        const auto flat = magnitude(rise) < T(kFlat);
        const T at = -height / select(flat, T(1), rise);
        const auto enters = rise <= T(-kFlat), leaves = rise >= T(kFlat);
        inside.enter = select(enters, larger(inside.enter, at), inside.enter);
        inside.leave = select(leaves, smaller(inside.leave, at), inside.leave);
        inside = choose(flat & (height > T(0)), Interval<T>::none(), inside);
    }
    return inside;
}

template <class T>
Interval<T> capsule(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius, const T& half_length) {
    const Vec3T<T> end{T(0), T(0), half_length};
    const Interval<T> middle = intersection(tube(o, d, radius), slab(o.z, d.z, half_length));
    return hull(hull(ball(o - end, d, radius), ball(o + end, d, radius)),
                choose(middle.empty(), Interval<T>::none(), middle));
}

/// o + t d in the frame of the shape, which is no surface. `faces`: of a hull.
template <class T>
Interval<T> cross_shape(const Shape& shape, const ConvexHull::Face* faces, std::size_t face_count,
                        const Vec3T<T>& o, const Vec3T<T>& d) {
    const T radius(shape.radius), half_length(shape.half_length);
    const Vec3T<T> half = broadcast<T>(shape.half);
    switch (shape.kind) {
        case ShapeKind::kPlane: {
            const auto flat = magnitude(d.z) < T(1e-300);
            const T t = -o.z / select(flat, T(1), d.z);
            return choose(flat, Interval<T>::none(), Interval<T>{t, t});
        }
        case ShapeKind::kSphere:
            return ball(o, d, radius);
        case ShapeKind::kBox:
            return intersection(intersection(slab(o.x, d.x, half.x), slab(o.y, d.y, half.y)),
                                slab(o.z, d.z, half.z));
        case ShapeKind::kCylinder:
            return intersection(tube(o, d, radius), slab(o.z, d.z, half_length));
        case ShapeKind::kCapsule:
            return capsule(o, d, radius, half_length);
        case ShapeKind::kEllipsoid:  // stretched to the unit ball
            return ball(Vec3T<T>{o.x / half.x, o.y / half.y, o.z / half.z},
                        Vec3T<T>{d.x / half.x, d.y / half.y, d.z / half.z}, T(1));
        case ShapeKind::kHull:
            return polytope(faces, face_count, o, d);
        case ShapeKind::kSurface:
            break;
    }
    return Interval<T>::none();
}

/// The first crossing of the surface, from outside or from inside; +infinity: none.
template <class T>
T first_crossing(const Interval<T>& inside) {
    const T at = select(inside.enter >= T(0), inside.enter, inside.leave);
    return select(inside.empty() | (inside.leave < T(0)), T(kInfinity), at);
}

}  // namespace roboss::ray_shapes
