// Where a ray meets a shape, in closed form, over a number T: Lanes choose which shape is nearest, double
// measures the one that was chosen. All shapes but the triangle are convex, so a line meets each in one
// interval. Lines are o + t d; shapes are centred at the origin, with their axis along z.
#pragma once

#include "core/lanes.h"
#include "math/vec3.h"

namespace roboss::render {

/// Where a line is inside a convex shape; empty where enter > leave.
template <class T>
struct Inside {
    T enter, leave;
};

inline constexpr double kNever = 1e30;  // beyond all rays; its square is no float, so it is never squared

template <class T>
Inside<T> both(const Inside<T>& a, const Inside<T>& b) {
    return {larger(a.enter, b.enter), smaller(a.leave, b.leave)};
}

/// The hull of two, where at least one may be empty.
template <class T>
Inside<T> either_of(const Inside<T>& a, const Inside<T>& b) {
    const auto no_a = a.enter > a.leave, no_b = b.enter > b.leave;
    return {select(no_a, b.enter, select(no_b, a.enter, smaller(a.enter, b.enter))),
            select(no_a, b.leave, select(no_b, a.leave, larger(a.leave, b.leave)))};
}

/// low <= o + t d <= high in one dimension.
template <class T>
Inside<T> between(const T& o, const T& d, const T& low, const T& high) {
    const auto flat = magnitude(d) < T(1e-20);
    const T safe = select(flat, T(1), d);
    const T a = (low - o) / safe, b = (high - o) / safe;
    const auto in = (low <= o) & (o <= high);
    return {select(flat, select(in, T(-kNever), T(kNever)), smaller(a, b)),
            select(flat, select(in, T(kNever), T(-kNever)), larger(a, b))};
}

template <class T>
Inside<T> cross_box(const Vec3T<T>& o, const Vec3T<T>& d, const Vec3T<T>& half) {
    return both(both(between(o.x, d.x, -half.x, half.x), between(o.y, d.y, -half.y, half.y)),
                between(o.z, d.z, -half.z, half.z));
}

/// The point of closest approach comes first: full precision for a small ball far away.
template <class T>
Inside<T> cross_ball(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius) {
    using std::sqrt;
    const T dd = larger(dot(d, d), T(1e-30));
    const T closest = -dot(o, d) / dd;
    const Vec3T<T> p = o + d * closest;
    const T room = radius * radius - dot(p, p);
    const auto misses = room < T(0);
    const T half = sqrt(select(misses, T(0), room) / dd);
    return {select(misses, T(kNever), closest - half), select(misses, T(-kNever), closest + half)};
}

/// x^2 + y^2 <= radius^2.
template <class T>
Inside<T> cross_tube(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius) {
    const Vec3T<T> o2{o.x, o.y, T(0)}, d2{d.x, d.y, T(0)};
    const auto along = dot(d2, d2) < T(1e-20);
    const auto in = dot(o2, o2) <= radius * radius;
    const Inside<T> ball = cross_ball(o2, d2, radius);
    return {select(along, select(in, T(-kNever), T(kNever)), ball.enter),
            select(along, select(in, T(kNever), T(-kNever)), ball.leave)};
}

template <class T>
Inside<T> cross_cylinder(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius, const T& half) {
    return both(cross_tube(o, d, radius), between(o.z, d.z, -half, half));
}

template <class T>
Inside<T> cross_capsule(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius, const T& half) {
    const Vec3T<T> end{T(0), T(0), half};
    const Inside<T> ends = either_of(cross_ball(o - end, d, radius), cross_ball(o + end, d, radius));
    return either_of(ends, cross_cylinder(o, d, radius, half));
}

/// Stretched to the unit ball.
template <class T>
Inside<T> cross_ellipsoid(const Vec3T<T>& o, const Vec3T<T>& d, const Vec3T<T>& radii) {
    return cross_ball<T>({o.x / radii.x, o.y / radii.y, o.z / radii.z},
                         {d.x / radii.x, d.y / radii.y, d.z / radii.z}, T(1));
}

/// The tip at z = half, the base with its radius at z = -half: of the double cone
/// x^2 + y^2 <= k^2 (half - z)^2, the part below the tip. Along the line that is a parabola a t^2 + 2 b t + c
/// <= 0; if it opens downwards the line is inside beyond its roots, on the side where it descends.
template <class T>
Inside<T> cross_cone(const Vec3T<T>& o, const Vec3T<T>& d, const T& radius, const T& half) {
    using std::sqrt;
    const T k = radius / (half + half), kk = k * k, h = half - o.z;
    const T a0 = d.x * d.x + d.y * d.y - kk * d.z * d.z;
    const T a = select(magnitude(a0) < T(1e-12), T(1e-12), a0);
    const T b = o.x * d.x + o.y * d.y + kk * h * d.z;
    const T c = o.x * o.x + o.y * o.y - kk * h * h;
    const T disc = b * b - a * c;
    const auto misses = disc < T(0);
    const T root = sqrt(select(misses, T(0), disc));
    const T t1 = (-b - root) / a, t2 = (-b + root) / a;
    const T first = smaller(t1, t2), last = larger(t1, t2);
    const auto opens = a > T(0), sinks = d.z < T(0);
    Inside<T> in{select(opens, first, select(sinks, last, T(-kNever))),
                 select(opens, last, select(sinks, T(kNever), first))};
    in.enter = select(misses, T(kNever), in.enter);
    in.leave = select(misses, T(-kNever), in.leave);
    return both(in, between(o.z, d.z, -half, half));
}

/// The rectangle of the plane z = 0; seen from both sides.
template <class T>
Inside<T> cross_rectangle(const Vec3T<T>& o, const Vec3T<T>& d, const T& half_x, const T& half_y) {
    const auto flat = magnitude(d.z) < T(1e-20);
    const T t = -o.z / select(flat, T(1), d.z);
    const auto in = (magnitude(o.x + t * d.x) <= half_x) & (magnitude(o.y + t * d.y) <= half_y);
    const auto hits = in & !flat;
    return {select(hits, t, T(kNever)), select(hits, t, T(-kNever))};
}

/// Distance to the triangle (Moeller and Trumbore, 1997), or kNever. Its edges are a little wider than they
/// are, so that no ray slips between two triangles.
template <class T>
T cross_triangle(const Vec3T<T>& o, const Vec3T<T>& d, const Vec3T<T>& corner, const Vec3T<T>& e1,
                 const Vec3T<T>& e2) {
    const T kRim(1e-5);
    const Vec3T<T> p = cross(d, e2);
    const T det = dot(e1, p);
    const auto flat = magnitude(det) < T(1e-30);
    const T inverse = T(1) / select(flat, T(1), det);
    const Vec3T<T> s = o - corner;
    const T u = dot(s, p) * inverse;
    const Vec3T<T> q = cross(s, e1);
    const T v = dot(d, q) * inverse;
    const T t = dot(e2, q) * inverse;
    const auto in = (u >= -kRim) & (v >= -kRim) & (u + v <= T(1) + kRim);
    return select(in & !flat, t, T(kNever));
}

}  // namespace roboss::render
