// Capsule against capsule: the closest points of the two cores, or both ends of their common part when
// parallel.
#include <algorithm>

#include "geometry/support_line.h"

namespace roboss::narrow {
namespace {

SupportLine core(const Posed& capsule) {
    return {capsule.X.p, capsule.axis(2) * capsule.shape.half_length, 0, 1, kLine};
}

/// A normal for cores that cross: perpendicular to both, towards the first centre.
Vec3 crossing_normal(const Posed& a, const Posed& b) {
    const Vec3 across = cross(a.axis(2), b.axis(2));
    const double length = norm(across);
    const Vec3 n = length > 1e-6 ? across / length : a.axis(0);
    return dot(n, a.X.p - b.X.p) < 0.0 ? -n : n;
}

}  // namespace

void capsule_capsule(const Posed& a, const Posed& b, double margin, Manifold& out) {
    SupportLine line_a = core(a), line_b = core(b);
    const LineParameters p = closest_parameters(line_a, line_b);
    const Vec3 d = (line_a.middle + line_a.half * p.s) - (line_b.middle + line_b.half * p.t);
    const double distance = norm(d), ra = a.shape.radius, rb = b.shape.radius;
    if (distance - ra - rb > margin) return;
    out.n_W = distance > 1e-12 * (ra + rb) ? d / distance : crossing_normal(a, b);
    line_a.middle += out.n_W * -ra;
    line_b.middle += out.n_W * rb;
    add_lines(line_a, line_b, 0.01 * std::min(ra, rb), margin, out);
}

}  // namespace roboss::narrow
