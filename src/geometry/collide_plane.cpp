// Half-space against everything, in closed form. Plane against cylinder is the hot path of wheeled robots.
#include "geometry/clip_feature.h"
#include "geometry/cylinder_rim.h"
#include "geometry/narrow.h"

namespace roboss::narrow {
namespace {

/// Adds a point of the body's surface; `n` is the plane's outward normal.
void add_below(Manifold& out, const Vec3& p_W, double gap, double margin, const Vec3& n,
               std::uint32_t feature) {
    if (gap <= margin) out.add(p_W - n * (0.5 * gap), gap, feature);
}

}  // namespace

void plane_sphere(const Posed& plane, const Posed& sphere, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    const double r = sphere.shape.radius;
    const double gap = dot(n, sphere.X.p - plane.X.p) - r;
    out.n_W = -n;
    add_below(out, sphere.X.p - n * r, gap, margin, n, 0);
}

// The four corners of the face that looks most against the normal; the feature is the corner's number.
void plane_box(const Posed& plane, const Posed& box, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    const Vec3 along = transpose_times(box.X.R, n);  // n in the box's frame
    const Vec3& half = box.shape.half;
    const double height = dot(n, box.X.p - plane.X.p);
    out.n_W = -n;
    const Vec3 reach{std::fabs(along.x) * half.x, std::fabs(along.y) * half.y, std::fabs(along.z) * half.z};
    if (height - (reach.x + reach.y + reach.z) > margin) return;

    const double ax = std::fabs(along.x), ay = std::fabs(along.y), az = std::fabs(along.z);
    const std::size_t k = az >= ax && az >= ay ? 2 : ay >= ax ? 1 : 0;
    const std::size_t i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
    const bool upper = along[k] < 0.0;  // the face at +half looks down
    const Vec3 ei = box.axis(i) * half[i], ej = box.axis(j) * half[j];
    const Vec3 centre = box.X.p + box.axis(k) * (upper ? half[k] : -half[k]);
    const double gi = along[i] * half[i], gj = along[j] * half[j], g0 = height - reach[k];
    const auto face = static_cast<std::uint32_t>(upper) << k;
    for (std::uint32_t c = 0; c < 4; ++c) {
        const double si = (c & 1u) != 0 ? 1.0 : -1.0, sj = (c & 2u) != 0 ? 1.0 : -1.0;
        add_below(out, centre + (ei * si + ej * sj), g0 + (gi * si + gj * sj), margin, n,
                  face | (c & 1u) << i | (c >> 1) << j);
    }
}

// Lying (axis within 45 degrees of the plane): the deepest point of each end, features 0 (at -z) and 1 (at
// +z). Standing: four rim points of the lower end, features 2 .. 5 (at -z) or 6 .. 9 (at +z).
void plane_cylinder(const Posed& plane, const Posed& cylinder, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2), u = cylinder.axis(2);
    const double r = cylinder.shape.radius, l = cylinder.shape.half_length;
    const double height = dot(n, cylinder.X.p - plane.X.p);
    const double rise = dot(n, u);
    const Vec3 down = u * rise - n;
    const double length = norm(down);
    out.n_W = -n;
    if (height - l * std::fabs(rise) - r * length > margin) return;

    if (rise * rise <= 0.5) {
        const Vec3 line = cylinder.X.p + down * (r / length);
        const double g = height - r * length;
        add_below(out, line - u * l, g - l * rise, margin, n, 0);
        add_below(out, line + u * l, g + l * rise, margin, n, 1);
        return;
    }
    const double end = rise > 0.0 ? -l : l;
    const Vec3 centre = cylinder.X.p + u * end;
    std::uint32_t feature = rise > 0.0 ? 2 : 6;
    for (const Vec3& radial : rim_directions(cylinder, n)) {
        add_below(out, centre + radial * r, height + end * rise + r * dot(n, radial), margin, n, feature++);
    }
}

// The lowest points of the two end spheres, features 0 (at -z) and 1 (at +z).
void plane_capsule(const Posed& plane, const Posed& capsule, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2), axis = capsule.axis(2) * capsule.shape.half_length;
    const double r = capsule.shape.radius;
    const double gap = dot(n, capsule.X.p - plane.X.p) - r, rise = dot(n, axis);
    const Vec3 low = capsule.X.p - n * r;
    out.n_W = -n;
    add_below(out, low - axis, gap - rise, margin, n, 0);
    add_below(out, low + axis, gap + rise, margin, n, 1);
}

// The one point whose normal is the plane's.
void plane_ellipsoid(const Posed& plane, const Posed& ellipsoid, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    const Vec3 low = ConvexBody(ellipsoid).support(-n);
    out.n_W = -n;
    const double gap = dot(n, ellipsoid.X.p - plane.X.p) + dot(n, low);
    add_below(out, ellipsoid.X.p + low, gap, margin, n, 0);
}

// The corners of the face that looks most against the normal, of those at the lowest corner; features are the
// corners' numbers.
void plane_hull(const Posed& plane, const Posed& hull, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    const Feature face = ConvexBody(hull).feature(-n);
    out.n_W = -n;
    std::array<Vec3, Feature::kMaxPoints> points;
    std::array<double, Feature::kMaxPoints> gaps{};
    std::array<std::uint32_t, Feature::kMaxPoints> parts{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < face.count; ++i) {
        const double gap = dot(n, face.points[i] - plane.X.p);
        if (gap > margin) continue;
        points[count] = face.points[i], gaps[count] = gap, parts[count++] = face.part[i];
    }
    if (count <= static_cast<std::size_t>(Manifold::kMaxPoints)) {
        for (std::size_t i = 0; i < count; ++i) add_below(out, points[i], gaps[i], margin, n, parts[i]);
        return;
    }
    const Chosen chosen = choose_points(std::span(points).first(count), std::span(gaps).first(count), n);
    for (std::size_t k = 0; k < chosen.count; ++k) {
        const std::size_t i = chosen.number[k];
        add_below(out, points[i], gaps[i], margin, n, parts[i]);
    }
}

}  // namespace roboss::narrow
