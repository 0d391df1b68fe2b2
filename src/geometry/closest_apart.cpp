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

/// The feature of a simplex that is closest to the origin: a point, segment or triangle of its vertices.
struct Closest {
    std::size_t count = 0;
    std::array<std::size_t, 3> v{};
    Vec3 w;                        // its point closest to the origin
    double second = 0, third = 0;  // that point's weights at v[1] and v[2]
};

struct Simplex {
    std::size_t count = 0;
    std::array<Vertex, 4> v;
    Vec3 closest, first;  // closest to the origin; the first shape's share of it
    bool inside = false;

    bool has(const Vec3& w) const {
        for (std::size_t i = 0; i < count; ++i) {
            if (v[i].w == w) return true;
        }
        return false;
    }
    void keep(const Closest& feature) {
        const Vertex a = v[feature.v[0]], b = v[feature.v[1]], c = v[feature.v[2]];
        count = feature.count;
        closest = feature.w;
        first = a.first;
        if (count > 1) first += (b.first - a.first) * feature.second;
        if (count > 2) first += (c.first - a.first) * feature.third;
        v[0] = a, v[1] = b, v[2] = c;
    }
};

Closest closest_on_segment(const Simplex& s, std::size_t a, std::size_t b) {
    const Vec3 &wa = s.v[a].w, &wb = s.v[b].w;
    const Vec3 ab = wb - wa;
    const double length_squared = norm_squared(ab), along = -dot(wa, ab);
    if (along <= 0.0 || length_squared == 0.0) return {1, {a}, wa};
    if (along >= length_squared) return {1, {b}, wb};
    const double t = along / length_squared;
    return {2, {a, b}, wa + ab * t, t};
}

Closest closest_on_triangle(const Simplex& s, std::size_t a, std::size_t b, std::size_t c) {
    const Vec3 &wa = s.v[a].w, &wb = s.v[b].w, &wc = s.v[c].w;
    const Vec3 ab = wb - wa, ac = wc - wa;
    const double d1 = -dot(ab, wa), d2 = -dot(ac, wa), d3 = -dot(ab, wb), d4 = -dot(ac, wb),
                 d5 = -dot(ab, wc), d6 = -dot(ac, wc);
    if (d1 <= 0.0 && d2 <= 0.0) return {1, {a}, wa};
    if (d3 >= 0.0 && d4 <= d3) return {1, {b}, wb};
    if (d6 >= 0.0 && d5 <= d6) return {1, {c}, wc};
    const double area_c = d1 * d4 - d3 * d2, area_b = d5 * d2 - d1 * d6, area_a = d3 * d6 - d5 * d4;
    if (area_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return closest_on_segment(s, a, b);
    if (area_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return closest_on_segment(s, a, c);
    if (area_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return closest_on_segment(s, b, c);
    const Vec3 normal = cross(ab, ac);
    const double area_squared = norm_squared(normal), volume = area_a + area_b + area_c;
    if (!(area_squared > 0.0 && volume > 0.0)) return closest_on_segment(s, a, b);
    return {3, {a, b, c}, normal * (dot(normal, wa) / area_squared), area_b / volume, area_c / volume};
}

/// True when the origin lies on the side of plane abc away from d, or the tetrahedron is flat.
bool outside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 normal = cross(b - a, c - a);
    const double of_origin = -dot(normal, a), of_d = dot(normal, d - a);
    return !(of_origin * of_d > 0.0);
}

void reduce_tetrahedron(Simplex& s) {
    constexpr std::size_t kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Closest best;
    double best_squared = 1e300;
    for (const auto& f : kFaces) {
        if (!outside(s.v[f[0]].w, s.v[f[1]].w, s.v[f[2]].w, s.v[f[3]].w)) continue;
        const Closest face = closest_on_triangle(s, f[0], f[1], f[2]);
        const double squared = norm_squared(face.w);
        if (squared < best_squared) best_squared = squared, best = face;
    }
    if (best.count == 0) {
        s.inside = true;
    } else {
        s.keep(best);
    }
}

void reduce(Simplex& s) {
    switch (s.count) {
        case 1:
            s.closest = s.v[0].w, s.first = s.v[0].first;
            return;
        case 2:
            return s.keep(closest_on_segment(s, 0, 1));
        case 3:
            return s.keep(closest_on_triangle(s, 0, 1, 2));
        default:
            return reduce_tetrahedron(s);
    }
}

}  // namespace

template <class Sum>
ClosestApart closest_apart(const Sum& sum, const Separation& start, double enough, double too_little) {
    ClosestApart result{start, false, {}};
    Separation& best = result.best;
    Simplex simplex;
    const Touching begin = sum.touching(start.n);
    simplex.v[0] = {begin.support - sum.centre(), begin.first};
    simplex.count = 1;
    reduce(simplex);
    const double touching = 1e-7 * sum.scale();
    for (int step = 0; step < kStepsMax; ++step) {
        result.first = simplex.first;
        const double squared = norm_squared(simplex.closest);
        if (squared <= touching * touching) {
            result.overlap = true;
            break;
        }
        const double distance = std::sqrt(squared);
        if (distance < too_little) break;
        const Touching found = sum.touching(simplex.closest / -distance);
        if (found.s > best.s) best = found;
        if (best.s > enough || distance - best.s <= sum.apart_gap() * (distance + sum.scale())) break;
        const Vertex vertex{found.support - sum.centre(), found.first};
        if (simplex.has(vertex.w)) break;
        simplex.v[simplex.count++] = vertex;
        reduce(simplex);
        result.overlap = simplex.inside;
        if (simplex.inside || !(norm_squared(simplex.closest) < squared)) break;
    }
    return result;
}

template ClosestApart closest_apart(const ConvexSum&, const Separation&, double, double);
template ClosestApart closest_apart(const GeneralSum&, const Separation&, double, double);
template ClosestApart closest_apart(const SweptSum&, const Separation&, double, double);

}  // namespace roboss::narrow
