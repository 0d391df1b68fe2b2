// GJK on the sum minus its centre: the simplex keeps its closest feature to the origin. Closest points as in
// Ericson, "Real-Time Collision Detection", 2005, section 5.1.
#include <algorithm>

#include "geometry/closest_direction.h"

namespace roboss::narrow {
namespace {

constexpr int kStepsMax = 96;

/// A point w of the sum minus its centre, and the share `first` of it that belongs to the first shape.
struct Vertex {
    Vec3 w, first;
};

Vertex mix(const Vertex& a, const Vertex& b, double t) {
    return {a.w + (b.w - a.w) * t, a.first + (b.first - a.first) * t};
}

struct Simplex {
    std::size_t count = 0;
    std::array<Vertex, 4> v;
    Vertex closest;
    bool inside = false;

    void set(std::initializer_list<Vertex> vertices, const Vertex& point) {
        count = 0;
        for (const Vertex& vertex : vertices) v[count++] = vertex;
        closest = point;
    }
    bool has(const Vec3& w) const {
        for (std::size_t i = 0; i < count; ++i) {
            if (v[i].w == w) return true;
        }
        return false;
    }
};

void reduce_segment(Simplex& s, const Vertex& a, const Vertex& b) {
    const Vec3 ab = b.w - a.w;
    const double length_squared = norm_squared(ab), along = -dot(a.w, ab);
    if (along <= 0.0 || length_squared == 0.0) return s.set({a}, a);
    if (along >= length_squared) return s.set({b}, b);
    s.set({a, b}, mix(a, b, along / length_squared));
}

void reduce_triangle(Simplex& s, const Vertex& a, const Vertex& b, const Vertex& c) {
    const Vec3 ab = b.w - a.w, ac = c.w - a.w;
    const double d1 = -dot(ab, a.w), d2 = -dot(ac, a.w), d3 = -dot(ab, b.w), d4 = -dot(ac, b.w),
                 d5 = -dot(ab, c.w), d6 = -dot(ac, c.w);
    if (d1 <= 0.0 && d2 <= 0.0) return s.set({a}, a);
    if (d3 >= 0.0 && d4 <= d3) return s.set({b}, b);
    if (d6 >= 0.0 && d5 <= d6) return s.set({c}, c);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return reduce_segment(s, a, b);
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return reduce_segment(s, a, c);
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return reduce_segment(s, b, c);
    const Vec3 normal = cross(ab, ac);
    const double area_squared = norm_squared(normal), volume = va + vb + vc;
    if (!(area_squared > 0.0 && volume > 0.0)) return reduce_segment(s, a, b);
    const Vec3 first = a.first + (b.first - a.first) * (vb / volume) + (c.first - a.first) * (vc / volume);
    s.set({a, b, c}, {normal * (dot(normal, a.w) / area_squared), first});
}

/// True when the origin lies on the side of plane abc away from d, or the tetrahedron is flat.
bool outside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 normal = cross(b - a, c - a);
    const double of_origin = -dot(normal, a), of_d = dot(normal, d - a);
    return !(of_origin * of_d > 0.0);
}

void reduce_tetrahedron(Simplex& s) {
    const std::array<Vertex, 4> v = s.v;
    constexpr std::size_t kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Simplex best;
    double best_squared = 1e300;
    for (const auto& f : kFaces) {
        if (!outside(v[f[0]].w, v[f[1]].w, v[f[2]].w, v[f[3]].w)) continue;
        Simplex face;
        reduce_triangle(face, v[f[0]], v[f[1]], v[f[2]]);
        const double squared = norm_squared(face.closest.w);
        if (squared < best_squared) best_squared = squared, best = face;
    }
    if (best.count == 0) {
        s.inside = true;
    } else {
        s = best;
    }
}

void reduce(Simplex& s) {
    const std::array<Vertex, 4> v = s.v;
    switch (s.count) {
        case 1:
            return s.set({v[0]}, v[0]);
        case 2:
            return reduce_segment(s, v[0], v[1]);
        case 3:
            return reduce_triangle(s, v[0], v[1], v[2]);
        default:
            return reduce_tetrahedron(s);
    }
}

template <class Sum>
Vertex support(const Sum& sum, const Vec3& n) {
    Vec3 first;
    const Vec3 x = sum.support(n, first);
    return {x - sum.centre(), first};
}

}  // namespace

template <class Sum>
ClosestApart closest_apart(const Sum& sum, const Separation& start, double enough) {
    ClosestApart result{start, false, {}};
    Separation& best = result.best;
    Simplex simplex;
    simplex.v[0] = support(sum, start.n);
    simplex.count = 1;
    reduce(simplex);
    const double touching = 1e-7 * sum.scale();
    for (int step = 0; step < kStepsMax; ++step) {
        result.first = simplex.closest.first;
        const double squared = norm_squared(simplex.closest.w);
        if (squared <= touching * touching) {
            result.overlap = true;
            break;
        }
        const double distance = std::sqrt(squared);
        const Separation found = sum.separation(simplex.closest.w / -distance);
        if (found.s > best.s) best = found;
        if (best.s > enough || distance - best.s <= sum.apart_gap() * (distance + sum.scale())) break;
        const Vertex vertex = support(sum, found.n);
        if (simplex.has(vertex.w)) break;
        simplex.v[simplex.count++] = vertex;
        reduce(simplex);
        result.overlap = simplex.inside;
        if (simplex.inside || !(norm_squared(simplex.closest.w) < squared)) break;
    }
    return result;
}

template ClosestApart closest_apart(const ConvexSum&, const Separation&, double);
template ClosestApart closest_apart(const GeneralSum&, const Separation&, double);

}  // namespace roboss::narrow
