// Whether a robot turns so fast that velocity-dependent forces must not be taken at the beginning of the
// tick.
#pragma once

#include <algorithm>

#include "physics/dynamics/axis_rows.h"
#include "physics/dynamics/body_impulses.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {

/// Share of the kinetic energy that explicit velocity-dependent forces may add in one tick; a robot beyond it
/// takes the kick-drift step (kick_drift.h). It is reached at about 0.05 rad a tick.
inline constexpr double kFastTurnShare = 0.0025;

/// m, from the arc of the outermost point in a tick to its tangent. A free body that turns further takes the
/// motion that the second look (second_look.h) sweeps, and is swept along the motion that it takes. Below,
/// the two differ by less than half of a wall of 1 cm; a body that reaches 10 cm far stays below up to 0.28
/// rad.
inline constexpr double kLargeArc = 4e-3;

inline bool is_large_turn(const RobotType& type, const Vec3& angular, double dt) {
    return 0.5 * dt * dt * norm_squared(angular) * type.reach > kLargeArc;
}

/// True where centrifugal, Coriolis and gyroscopic forces, taken at the beginning of the tick (explicit
/// Euler), could add more than kFastTurnShare to the kinetic energy. By Gauss' principle they add at most
/// what they would add to the bodies if no joint held them,
///     dt^2 / 2 * sum over bodies (m |a|^2 + tau^T I^-1 tau),
/// with a and tau the bias acceleration and torque of a body. A wheel that spins about its axis of symmetry
/// has neither. It depends on the state alone. Over T: one robot, or a few in lanes. `work` holds the placed
/// and moved bodies.
template <class T>
MaskOf<T> turns_fast(const Mechanics<T>& work, double dt) {
    constexpr double kNoTurn = 0.02;  // rad in a tick: below, no body bends its path enough
    T fastest = 0;
    for (const BodyWorkT<T>& body : work.bodies)
        fastest = larger(fastest, norm_squared(body.velocity.angular));
    const MaskOf<T> turns = fastest > T(kNoTurn * kNoTurn / (dt * dt));
    if (!any(turns)) return turns;
    T energy = 0, added = 0;
    Vec3T<T> momentum;
    double mass = 0;
    for (std::size_t b = 0; b < work.bodies.size(); ++b) {
        const Body& body = work.type->bodies[b];
        if (!(body.mass > 0)) continue;
        const BodyWorkT<T>& w = work.bodies[b];
        const Vec3T<T>& turning = w.velocity.angular;
        const Sym3T<T> inertia = rotated_inertia(body, w);
        const Vec3T<T> spin = inertia * turning;
        const Vec3T<T> torque = inertia * w.bias.angular + cross(turning, spin);
        const Vec3T<T> moving = w.velocity.linear + cross(turning, w.centre);
        const Vec3T<T> acceleration =
            w.bias.linear + cross(w.bias.angular, w.centre) + cross(turning, moving);
        energy += norm_squared(moving) * T(body.mass) + dot(turning, spin);
        momentum += moving * T(body.mass), mass += body.mass;
        added += norm_squared(acceleration) * T(body.mass);
        const Mat3& I = body.inertia_C;
        const double least = std::min(I.r0.x, std::min(I.r1.y, I.r2.z));
        if (least > 0) added += norm_squared(torque) * T(1.0 / least);
    }
    // What a free robot moves as a whole does not count: the laws are the same in every inertial frame.
    if (work.type->free_base && mass > 0) energy -= norm_squared(momentum) * T(1.0 / mass);
    return turns & (added * T(dt * dt) > energy * T(kFastTurnShare));
}

/// True where a motor can do work.
template <class T>
MaskOf<T> is_driven(std::span<const MotorSetpointT<T>> motors) {
    MaskOf<T> driven = false;
    for (const MotorSetpointT<T>& motor : motors)
        driven = driven | ((!is_switched_off(motor)) & (motor.max_effort > T(0)));
    return driven;
}

}  // namespace roboss
