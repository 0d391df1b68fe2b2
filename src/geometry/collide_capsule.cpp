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
    LinePair pair{core(a), core(b), {}, 0, 0.01 * std::min(a.shape.radius, b.shape.radius)};
    const LineParameters p = closest_parameters(pair.a, pair.b);
    const Vec3 d = (pair.a.middle + pair.a.half * p.s) - (pair.b.middle + pair.b.half * p.t);
    const double distance = norm(d), ra = a.shape.radius, rb = b.shape.radius;
    pair.gap = distance - ra - rb;
    if (pair.gap > margin) return;
    pair.n = distance > 1e-12 * (ra + rb) ? d / distance : crossing_normal(a, b);
    pair.a.middle += pair.n * -ra;
    pair.b.middle += pair.n * rb;
    if (add_lines(pair, margin, out) <= margin) return;
    out.n_W = pair.n;  // cores so nearly one that the normal is not perpendicular to them
    const Vec3 on_a = pair.a.middle + pair.a.half * p.s;
    out.add(on_a - pair.n * (0.5 * pair.gap), pair.gap, feature_of(kLine, kLine));
}

}  // namespace roboss::narrow
