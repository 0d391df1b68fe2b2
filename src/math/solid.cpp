// See solid.h.
#include "math/solid.h"

#include "core/fixed_math.h"

namespace roboss {
namespace {

Mat3 diagonal(const Vec3& m) {
    return Mat3::diagonal(m.x, m.y, m.z);
}

}  // namespace

Solid solid_box(const Vec3& s) {
    const double v = s.x * s.y * s.z;
    return {v,
            {},
            diagonal(Vec3{s.y * s.y + s.z * s.z, s.x * s.x + s.z * s.z, s.x * s.x + s.y * s.y} * (v / 12.0))};
}

Solid solid_ellipsoid(const Vec3& r) {
    const double v = 4.0 / 3.0 * kPi * r.x * r.y * r.z;
    return {v,
            {},
            diagonal(Vec3{r.y * r.y + r.z * r.z, r.x * r.x + r.z * r.z, r.x * r.x + r.y * r.y} * (v / 5.0))};
}

Solid solid_cylinder(double r, double l) {
    const double v = kPi * r * r * l;
    const double across = v * (3.0 * r * r + l * l) / 12.0;
    return {v, {}, diagonal({across, across, v * r * r / 2.0})};
}

/// SDFormat's cone stands centred on its height, the tip up.
Solid solid_cone(double r, double l) {
    const double v = kPi * r * r * l / 3.0;
    const double across = v * (3.0 * r * r / 20.0 + 3.0 * l * l / 80.0);
    return {v, {0, 0, -l / 4.0}, diagonal({across, across, 0.3 * v * r * r})};
}

Solid solid_capsule(double r, double l) {
    const Solid straight = solid_cylinder(r, l), ball = solid_ellipsoid({r, r, r});
    // Each half ball's centre is 3/8 r beyond the cylinder's end.
    const double off = l / 2.0 + 3.0 / 8.0 * r;
    const double half_ball_across = ball.inertia(0, 0) - ball.volume * (9.0 / 64.0) * r * r;
    const double across = straight.inertia(0, 0) + half_ball_across + ball.volume * off * off;
    return {straight.volume + ball.volume,
            {},
            diagonal({across, across, straight.inertia(2, 2) + ball.inertia(2, 2)})};
}

}  // namespace roboss
