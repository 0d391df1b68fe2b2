// GJK on the sum minus its centre: the simplex keeps its closest feature to the origin. Closest points as in
// Ericson, "Real-Time Collision Detection", 2005, section 5.1.
#include <algorithm>

#include "geometry/closest_direction.h"

namespace roboss::narrow {
namespace {

constexpr int kStepsMax = 48;
constexpr double kGap = 1e-10;  // relative gap between the bounds; polishing does the rest

struct Simplex {
    std::size_t count = 0;
    std::array<Vec3, 4> v;
    Vec3 closest;
    bool inside = false;

    void set(std::initializer_list<Vec3> vertices, const Vec3& point) {
        count = 0;
        for (const Vec3& vertex : vertices) v[count++] = vertex;
        closest = point;
    }
    bool has(const Vec3& w) const {
        return std::find(v.begin(), v.begin() + static_cast<long>(count), w) !=
               v.begin() + static_cast<long>(count);
    }
};

void reduce_segment(Simplex& s, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double length_squared = norm_squared(ab), along = -dot(a, ab);
    if (along <= 0.0 || length_squared == 0.0) return s.set({a}, a);
    if (along >= length_squared) return s.set({b}, b);
    s.set({a, b}, a + ab * (along / length_squared));
}

void reduce_triangle(Simplex& s, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c),
                 d6 = -dot(ac, c);
    if (d1 <= 0.0 && d2 <= 0.0) return s.set({a}, a);
    if (d3 >= 0.0 && d4 <= d3) return s.set({b}, b);
    if (d6 >= 0.0 && d5 <= d6) return s.set({c}, c);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const Vec3 normal = cross(ab, ac);
    const double area_squared = norm_squared(normal);
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return reduce_segment(s, a, b);
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return reduce_segment(s, a, c);
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return reduce_segment(s, b, c);
    s.set({a, b, c}, area_squared > 0.0 ? normal * (dot(normal, a) / area_squared) : a);
}

/// True when the origin lies on the side of plane abc away from d, or the tetrahedron is flat.
bool outside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 normal = cross(b - a, c - a);
    const double of_origin = -dot(normal, a), of_d = dot(normal, d - a);
    return !(of_origin * of_d > 0.0);
}

void reduce_tetrahedron(Simplex& s) {
    const std::array<Vec3, 4> v = s.v;
    constexpr std::size_t kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Simplex best;
    double best_squared = 1e300;
    for (const auto& f : kFaces) {
        if (!outside(v[f[0]], v[f[1]], v[f[2]], v[f[3]])) continue;
        Simplex face;
        reduce_triangle(face, v[f[0]], v[f[1]], v[f[2]]);
        const double squared = norm_squared(face.closest);
        if (squared < best_squared) best_squared = squared, best = face;
    }
    if (best.count == 0) {
        s.inside = true;
    } else {
        s = best;
    }
}

void reduce(Simplex& s) {
    switch (s.count) {
        case 1:
            return s.set({s.v[0]}, Vec3(s.v[0]));
        case 2:
            return reduce_segment(s, Vec3(s.v[0]), Vec3(s.v[1]));
        case 3:
            return reduce_triangle(s, Vec3(s.v[0]), Vec3(s.v[1]), Vec3(s.v[2]));
        default:
            return reduce_tetrahedron(s);
    }
}

}  // namespace

Separation closest_apart(const ConvexSum& sum, const Separation& start, double enough, bool& overlap) {
    Separation best = start;
    overlap = false;
    Simplex simplex;
    simplex.v[0] = sum.support(start.n) - sum.centre();
    simplex.count = 1;
    simplex.closest = simplex.v[0];
    const double touching = 1e-7 * sum.inradius();
    for (int step = 0; step < kStepsMax; ++step) {
        const double squared = norm_squared(simplex.closest);
        if (squared <= touching * touching) {
            overlap = true;
            return best;
        }
        const double distance = std::sqrt(squared);
        const Separation found = sum.separation(simplex.closest / -distance);
        if (found.s > best.s) best = found;
        if (best.s > enough || distance - best.s <= kGap * distance) return best;
        const Vec3 w = sum.support(found.n) - sum.centre();
        if (simplex.has(w)) return best;
        simplex.v[simplex.count++] = w;
        reduce(simplex);
        if (simplex.inside) {
            overlap = true;
            return best;
        }
        if (!(norm_squared(simplex.closest) < squared)) return best;
    }
    return best;
}

}  // namespace roboss::narrow
