// See flow_laws.h.
#include "physics/dynamics/flow_laws.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr double kStill = 0.01;  // m/s: slower flow does nothing to a wing

Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? v * (1 / length) : Vec3{};
}

/// A coefficient that is linear up to stall and linear with another slope beyond, where it keeps its sign.
double with_stall(double alpha, double stall, double slope, double slope_beyond, double cos2_sweep) {
    if (alpha > stall) return std::max(0.0, (slope * stall + slope_beyond * (alpha - stall)) * cos2_sweep);
    if (alpha < -stall) return std::min(0.0, (-slope * stall + slope_beyond * (alpha + stall)) * cos2_sweep);
    return slope * alpha * cos2_sweep;
}

/// The angle of attack in -pi/2 .. pi/2: a wing has two edges.
double folded(double alpha) {
    for (int i = 0; i < 4 && std::fabs(alpha) > 0.5 * kPi; ++i) alpha += alpha > 0 ? -kPi : kPi;
    return alpha;
}

/// Axes of a wing in the flow.
struct WingFlow {
    Vec3 span, drag, lift;  // unit
    double speed = 0,       // m/s, across the span
        cos2_sweep = 1, alpha = 0;
    bool acts = false;
};

WingFlow wing_flow(const LiftDragSpec& spec, const Vec3& velocity) {
    WingFlow wing;
    const double speed = norm(velocity);
    const Vec3 forward = unit(spec.forward);
    if (speed <= kStill || (!spec.reversible && dot(forward, velocity) <= 0)) return wing;
    const Vec3 upward = spec.radial_symmetry ? unit(cross(forward, cross(forward, velocity * (1 / speed))))
                                             : unit(spec.upward);
    wing.span = unit(cross(forward, upward));
    const double sweep = std::clamp(dot(wing.span, velocity) / speed, -1.0, 1.0);
    wing.cos2_sweep = 1 - sweep * sweep;
    const Vec3 across = velocity - wing.span * dot(velocity, wing.span);
    wing.speed = norm(across);
    if (!(wing.speed > 1e-9)) return wing;
    wing.drag = across * (-1 / wing.speed);
    wing.lift = unit(cross(wing.span, across));
    const double turn = fixed_acos(std::clamp(dot(wing.lift, upward), -1.0, 1.0));
    wing.alpha = folded(dot(wing.lift, forward) >= 0 ? spec.a0 + turn : spec.a0 - turn);
    wing.acts = true;
    return wing;
}

}  // namespace

void FlowForce::add_damping(double factor, const Vec3& f, const Vec3& t) {
    const double j[6] = {f.x, f.y, f.z, t.x, t.y, t.z};
    for (std::size_t a = 0; a < 6; ++a)
        for (std::size_t b = 0; b < 6; ++b) damping[6 * a + b] += factor * j[a] * j[b];
}

WingCoefficients wing_coefficients(const LiftDragSpec& spec, double alpha, double cos2_sweep) {
    WingCoefficients c;
    c.lift = with_stall(alpha, spec.alpha_stall, spec.cla, spec.cla_stall, cos2_sweep);
    c.drag = std::fabs(with_stall(alpha, spec.alpha_stall, spec.cda, spec.cda_stall, cos2_sweep));
    c.moment = with_stall(alpha, spec.alpha_stall, spec.cma, spec.cma_stall, cos2_sweep);
    if (std::fabs(alpha) <= spec.alpha_stall) c.lift_slope = std::max(spec.cla * cos2_sweep, 0.0);
    return c;
}

FlowForce lift_drag_force(const LiftDragSpec& spec, const FlowVelocity& flow, double control_angle) {
    FlowForce sum;
    const WingFlow wing = wing_flow(spec, flow.linear + cross(flow.angular, spec.centre));
    if (!wing.acts) return sum;
    WingCoefficients c = wing_coefficients(spec, wing.alpha, wing.cos2_sweep);
    c.lift += spec.control_lift * control_angle;
    c.moment += spec.cm_delta * control_angle;
    const double mass_flow = 0.5 * spec.density * wing.speed * spec.area;  // kg/s
    const double push = mass_flow * wing.speed;
    sum.push((wing.lift * c.lift + wing.drag * c.drag) * push, spec.centre);
    sum.torque += wing.span * (c.moment * push);
    sum.brake(mass_flow * c.drag, wing.drag, spec.centre);
    sum.brake(mass_flow * (c.drag + c.lift_slope), wing.lift, spec.centre);
    return sum;
}

namespace {

/// Body axes of an aeroplane, x forward, y to the right, z down, and what its wing meets.
struct AeroplaneFlow {
    Vec3 x, y, z, xs, zs;  // unit; s: stability axes
    double speed = 0, alpha = 0, beta = 0, p = 0, q = 0, r = 0;
};

AeroplaneFlow aeroplane_flow(const AdvancedLiftDragSpec& spec, const FlowVelocity& flow) {
    AeroplaneFlow f;
    const Vec3 velocity = flow.linear + cross(flow.angular, spec.centre);
    f.x = unit(spec.forward);
    f.y = unit(cross(-spec.upward, spec.forward));
    f.z = cross(f.x, f.y);
    const Vec3 across = velocity - f.y * dot(velocity, f.y);
    f.speed = norm(across);
    if (!(f.speed > 1e-9)) return f;
    f.xs = across * (1 / f.speed);
    f.zs = cross(f.xs, f.y);
    f.alpha = fixed_atan2(dot(f.xs, f.z), dot(f.xs, f.x));
    f.beta = fixed_atan2(dot(velocity, f.y), dot(velocity, f.x));
    f.p = dot(flow.angular, f.x), f.q = dot(flow.angular, f.y), f.r = dot(flow.angular, f.z);
    return f;
}

/// 0 where the flow is attached, 1 where it is separated (Beard and McLain, Small Unmanned Aircraft, 2012,
/// equation 4.10).
double separation(double alpha, double stall) {
    constexpr double kSharpness = 15;
    const double above = fixed_exp(-kSharpness * (alpha - stall)),
                 below = fixed_exp(kSharpness * (alpha + stall));
    return (1 + above + below) / ((1 + above) * (1 + below));
}

double lift_of_plate(double alpha) {
    const SinCos a = fixed_sincos(alpha);
    return 2 * (alpha < 0 ? -1.0 : 1.0) * a.sin * a.sin * a.cos;
}

/// By angles: lift, drag, side force and moments, all dimensionless.
AeroCoefficients static_coefficients(const AdvancedLiftDragSpec& spec, const AeroplaneFlow& f,
                                     std::span<const double> angles) {
    constexpr double kDegree = kPi / 180;
    const double sigma = separation(f.alpha, spec.alpha_stall);
    const double plate =
        2 / (1 + fixed_exp(-0.224 - 0.115 * std::max(spec.aspect_ratio, 1 / spec.aspect_ratio)));
    AeroCoefficients c;
    c.lift = (1 - sigma) * (spec.lift_0 + spec.by_alpha.lift * f.alpha) + sigma * lift_of_plate(f.alpha) +
             spec.by_beta.lift * f.beta;
    c.side = spec.by_alpha.side * f.alpha + spec.by_beta.side * f.beta;
    c.roll = spec.by_alpha.roll * f.alpha + spec.by_beta.roll * f.beta;
    const double beyond = std::fabs(f.alpha) - spec.alpha_stall;
    const double pitch = beyond <= 0 ? spec.by_alpha.pitch * f.alpha
                                     : (f.alpha < 0 ? -1.0 : 1.0) * (spec.by_alpha.pitch * spec.alpha_stall +
                                                                     spec.pitch_stall * beyond);
    c.pitch = spec.pitch_0 + pitch + spec.by_beta.pitch * f.beta;
    c.yaw = spec.by_alpha.yaw * f.alpha + spec.by_beta.yaw * f.beta;
    double control_drag = 0;
    for (std::size_t i = 0; i < spec.surfaces.size(); ++i) {
        const AeroCoefficients& by = spec.surfaces[i].by_degree;
        const double angle = angles[i] / kDegree * spec.surfaces[i].direction;
        c.lift += by.lift * angle, control_drag += by.drag * angle, c.side += by.side * angle;
        c.roll += by.roll * angle, c.pitch += by.pitch * angle, c.yaw += by.yaw * angle;
    }
    const double induced = c.lift * c.lift / (kPi * spec.aspect_ratio * spec.efficiency);
    c.drag = (1 - sigma) * (spec.drag_0 + induced) +
             sigma * std::fabs(plate * (0.5 - 0.5 * fixed_cos(2 * f.alpha))) + control_drag;
    return c;
}

/// Adds what angular rates do, with `p`, `q`, `r` in m/s: rates times half span or half chord. Divided by
/// the speed they are the usual dimensionless ones.
void add_rates(const AdvancedLiftDragSpec& spec, double p, double q, double r, AeroCoefficients& c) {
    const AeroCoefficients &P = spec.by_p, &Q = spec.by_q, &R = spec.by_r;
    c.lift += P.lift * p + Q.lift * q + R.lift * r;
    c.drag += P.drag * p + Q.drag * q + R.drag * r;
    c.side += P.side * p + Q.side * q + R.side * r;
    c.roll += P.roll * p + Q.roll * q + R.roll * r;
    c.pitch += P.pitch * p + Q.pitch * q + R.pitch * r;
    c.yaw += P.yaw * p + Q.yaw * q + R.yaw * r;
}

}  // namespace

FlowForce aeroplane_force(const AdvancedLiftDragSpec& spec, const FlowVelocity& flow,
                          std::span<const double> angles) {
    FlowForce sum;
    const AeroplaneFlow f = aeroplane_flow(spec, flow);
    if (!(f.speed > 1e-9)) return sum;
    const double span = std::sqrt(spec.area * spec.aspect_ratio);
    const double chord = spec.chord > 0 ? spec.chord : spec.area / span;
    AeroCoefficients c = static_coefficients(spec, f, angles);
    add_rates(spec, f.p * 0.5 * span / f.speed, f.q * 0.5 * chord / f.speed, f.r * 0.5 * span / f.speed, c);
    const double mass_flow = 0.5 * spec.density * f.speed * spec.area, push = mass_flow * f.speed;
    sum.push((f.zs * -c.lift + f.xs * -c.drag + f.y * c.side) * push, spec.centre);
    sum.torque += (f.x * (c.roll * span) + f.y * (c.pitch * chord) + f.z * (c.yaw * span)) * push;
    const double slope = (1 - separation(f.alpha, spec.alpha_stall)) * std::max(spec.by_alpha.lift, 0.0);
    const double drag = std::max(c.drag, 0.0);
    sum.brake(mass_flow * drag, f.xs, spec.centre);
    sum.brake(mass_flow * (drag + slope), f.zs, spec.centre);
    sum.brake(mass_flow * std::max(-spec.by_beta.side, 0.0), f.y, spec.centre);
    const double half = 0.5 * mass_flow;
    sum.brake_rotation(half * span * span * std::max(-spec.by_p.roll, 0.0), f.x);
    sum.brake_rotation(half * chord * chord * std::max(-spec.by_q.pitch, 0.0), f.y);
    sum.brake_rotation(half * span * span * std::max(-spec.by_r.yaw, 0.0), f.z);
    return sum;
}

FlowForce hull_force(const LighterThanAirSpec& spec, const FlowVelocity& flow) {
    FlowForce sum;
    const Vec3 v = flow.linear + cross(flow.angular, Vec3{-spec.eps_v, 0, 0});
    const double across = std::sqrt(v.y * v.y + v.z * v.z);
    if (across > 0) {  // q sin 2a = density v.x across, q sin^2 a = density across^2 / 2, a: to the axis
        const Vec3 n{0, v.y / across, v.z / across};
        const double brake = spec.density * (0.5 * spec.force_viscous * across - spec.force_inviscid * v.x);
        const double moment =
            spec.density * across * (0.5 * spec.moment_viscous * across - spec.moment_inviscid * v.x);
        sum.force += n * (-brake * across);
        sum.torque += Vec3{0, n.z, -n.y} * moment;
        sum.brake(std::max(brake, 0.0), n, {});
    }
    const Vec3& u = flow.linear;
    const double in_plane = u.x * u.x + u.z * u.z;
    if (in_plane > 0) {
        const double brake = 0.5 * spec.density * spec.axial_drag * dot(u, u) * std::fabs(u.x) / in_plane;
        sum.force.x -= brake * u.x;
        sum.brake(brake, {1, 0, 0}, {});
    }
    return sum;
}

FlowForce water_damping(const HydrodynamicsSpec& spec, const FlowVelocity& flow) {
    Matrix6 D;  // force = D velocity
    Vec3 parts[2];
    for (std::size_t i = 0; i < 6; ++i) {
        double force = 0;
        for (std::size_t j = 0; j < 6; ++j) {
            double sum = spec.linear[6 * i + j];
            const std::size_t first = 36 * i + 6 * j;
            for (std::size_t k = 0; k < 6; ++k)
                sum += spec.absolute[first + k] * std::fabs(flow.at(k)) + spec.square[first + k] * flow.at(k);
            D[6 * i + j] = sum;
            force += sum * flow.at(j);
        }
        parts[i / 3][i % 3] = force;
    }
    FlowForce result;
    result.force = parts[0], result.torque = parts[1];
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) result.damping[6 * i + j] = -0.5 * (D[6 * i + j] + D[6 * j + i]);
    if (is_positive_semidefinite(result.damping.data())) return result;
    result.damping = {};
    for (std::size_t i = 0; i < 6; ++i) result.damping[7 * i] = std::max(-D[7 * i], 0.0);
    return result;
}

}  // namespace roboss
