// Half-space against everything, in closed form. Plane against cylinder is the hot path of wheeled robots.
#include "geometry/clip_feature.h"
#include "geometry/cylinder_rim.h"
#include "geometry/narrow.h"
#include "geometry/plane_contacts.h"

namespace roboss::narrow {
namespace {

/// Adds a point of the body's surface; `n` is the plane's outward normal.
void add_below(Manifold& out, const Vec3& p_W, double gap, double margin, const Vec3& n,
               std::uint32_t feature) {
    if (gap <= margin) out.add(p_W - n * (0.5 * gap), gap, feature);
}

}  // namespace

namespace {

/// Sphere, box, capsule, lying cylinder; false if it is none of these.
bool add_common(const Posed& plane, const Posed& body, double margin, Manifold& out) {
    Lockstep<double> alone;
    PlaneContacts<double> contacts(plane.X.p, plane.axis(2), margin, alone);
    const bool known = contacts.add(body.shape, body.X);
    out.n_W = -plane.axis(2);
    for (std::size_t i = 0; i < contacts.count(); ++i)
        out.add(contacts[i].p_W, contacts[i].gap, contacts[i].feature);
    return known;
}

}  // namespace

void plane_sphere(const Posed& plane, const Posed& sphere, double margin, Manifold& out) {
    add_common(plane, sphere, margin, out);
}

void plane_box(const Posed& plane, const Posed& box, double margin, Manifold& out) {
    add_common(plane, box, margin, out);
}

void plane_capsule(const Posed& plane, const Posed& capsule, double margin, Manifold& out) {
    add_common(plane, capsule, margin, out);
}

// Standing: four rim points of the lower end, features 2 .. 5 (at -z) or 6 .. 9 (at +z).
void plane_cylinder(const Posed& plane, const Posed& cylinder, double margin, Manifold& out) {
    if (add_common(plane, cylinder, margin, out)) return;
    const Vec3 n = plane.axis(2), u = cylinder.axis(2);
    const double r = cylinder.shape.radius, l = cylinder.shape.half_length;
    const double height = dot(n, cylinder.X.p - plane.X.p), rise = dot(n, u);
    const double end = rise > 0.0 ? -l : l;
    const Vec3 centre = cylinder.X.p + u * end;
    std::uint32_t feature = rise > 0.0 ? 2 : 6;
    for (const Vec3& radial : rim_directions(cylinder, n)) {
        add_below(out, centre + radial * r, height + end * rise + r * dot(n, radial), margin, n, feature++);
    }
}

// The one point whose normal is the plane's.
void plane_ellipsoid(const Posed& plane, const Posed& ellipsoid, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    const Vec3 low = ConvexBody(ellipsoid).support(-n);
    out.n_W = -n;
    const double gap = dot(n, ellipsoid.X.p - plane.X.p) + dot(n, low);
    add_below(out, ellipsoid.X.p + low, gap, margin, n, 0);
}

/// Quick: whether a hull is surely further off than the margin, whatever rounding does.
bool is_clear(const Posed& plane, const Posed& hull, double margin) {
    const Vec3 n = plane.axis(2);
    const ConvexHull& of = *hull.shape.hull;
    const double height = dot(n, hull.X.p - plane.X.p);
    const double enough = margin + 1e-9 * (std::fabs(height) + of.radius);
    return height - of.radius > enough || height - of.reach(transpose_times(hull.X.R, -n)) > enough;
}

// The corners of the face that looks most against the normal, of those at the lowest corner; features are the
// corners' numbers.
void plane_hull(const Posed& plane, const Posed& hull, double margin, Manifold& out) {
    const Vec3 n = plane.axis(2);
    if (is_clear(plane, hull, margin)) return;
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
