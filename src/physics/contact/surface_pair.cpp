// See surface_pair.h.
#include "physics/contact/surface_pair.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

bool has_direction(const Material& m) {
    return m.direction_S != Vec3{};
}

}  // namespace

FrictionEllipse friction_of(const Material& a, const Mat3& R_WA, const Material& b, const Mat3& R_WB,
                            const Vec3& normal) {
    const bool in_a = has_direction(a), in_b = has_direction(b);
    const double mu = std::min(a.mu, b.mu), mu2 = std::min(a.mu2, b.mu2);
    if ((!in_a && !in_b) || mu == mu2) return {mu, {}, 1.0};
    const bool takes_a = in_a && (!in_b || a.mu <= b.mu);
    const Vec3 d = takes_a ? R_WA * a.direction_S : R_WB * b.direction_S;
    const Vec3 along = d - normal * dot(normal, d);
    const double length = norm(along);
    if (length < 1e-6) return {mu2, {}, 1.0};
    const Vec3 axis = along / length;
    if (mu > mu2) return {mu, axis, mu2 / mu};
    return {mu2, cross(normal, axis), mu / mu2};
}

Softness softness_of(const Material& a, const Material& b) {
    const double ca = a.stiffness > 0 ? 1.0 / a.stiffness : 0.0,
                 cb = b.stiffness > 0 ? 1.0 / b.stiffness : 0.0;
    const double c = ca + cb;  // m/N
    if (c == 0) return {};
    return {1.0 / c, (ca * ca * a.damping + cb * cb * b.damping) / (c * c)};
}

double torsional_lever(const Material& a, const Material& b, double depth) {
    const double surface = std::max(a.surface_radius, b.surface_radius);
    double radius = std::max(a.patch_radius, b.patch_radius);
    if (surface > 0 && depth > 0) radius = std::max(radius, std::sqrt(surface * depth));
    return 3.0 * kPi / 16.0 * std::min(a.torsional_mu, b.torsional_mu) * radius;
}

SurfacePair surface_pair(const Material& a, const Mat3& R_WA, const Material& b, const Mat3& R_WB,
                         const Vec3& normal, double depth) {
    SurfacePair pair;
    pair.friction = friction_of(a, R_WA, b, R_WB, normal);
    pair.torsional = torsional_lever(a, b, depth), pair.rolling = std::max(a.rolling, b.rolling);
    pair.restitution = std::max(a.restitution, b.restitution);
    pair.bounce_threshold = std::max(a.bounce_threshold, b.bounce_threshold);
    pair.softness = softness_of(a, b);
    pair.slop = std::max(a.slop, b.slop),
    pair.correction_speed = std::min(a.correction_speed, b.correction_speed);
    return pair;
}

}  // namespace roboss
