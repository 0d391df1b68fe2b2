// Momenta and forces of a robot's bodies by themselves: Newton's and Euler's laws at their centres of mass,
// taken to the robot's reference point O. Over T: one robot, or a few in lanes. Of one robot, two bodies are
// computed side by side, with the bits that each has alone.
#pragma once

#include <type_traits>

#include "core/lanes.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {

/// True if the axes of the body are its principal axes, as most files have it.
inline bool has_principal_axes(const Body& body) {
    return body.inertia_C.r0.y == 0 && body.inertia_C.r0.z == 0 && body.inertia_C.r1.z == 0;
}

/// Inertia about the centre of mass, world axes.
template <class T>
[[gnu::always_inline]] inline Sym3T<T> rotated_inertia(const Body& body, const BodyWorkT<T>& w) {
    const Mat3& I = body.inertia_C;
    return has_principal_axes(body) ? rotated_diagonal(w.X_WB.R, broadcast<T>(Vec3{I.r0.x, I.r1.y, I.r2.z}))
                                    : rotated(w.X_WB.R, broadcast<T>(I));
}

/// Sets the body's inertia about O; returns that about its centre of mass.
template <class T>
[[gnu::always_inline]] inline Sym3T<T> set_inertia(const Body& body, BodyWorkT<T>& w) {
    const Sym3T<T> inertia_C = rotated_inertia(body, w);
    w.inertia = spatial_inertia(T(body.mass), w.centre, inertia_C);
    return inertia_C;
}

namespace body_impulse {

/// What the laws need besides poses and velocities; `torque`: of the weight, about the centre.
template <class T>
struct Cause {
    T mass, momentum;  // momentum: kg of it that count
    Sym3T<T> inertia_C;
    Vec3T<T> weight, torque;
};

/// momentum * momentum_weight + dt * (weight - bias force), about O
template <class T>
[[gnu::always_inline]] inline SpatialT<T> of(const Cause<T>& c, const Vec3T<T>& centre,
                                             const SpatialT<T>& velocity, const SpatialT<T>& bias, double dt,
                                             double momentum_weight) {
    const Vec3T<T>& turning = velocity.angular;
    const Vec3T<T> spin = c.inertia_C * turning;  // angular momentum about the centre
    const Vec3T<T> torque = c.torque - (c.inertia_C * bias.angular + cross(turning, spin));
    const Vec3T<T> twist = spin * T(momentum_weight) + torque * T(dt);
    const Vec3T<T> moving = velocity.linear + cross(turning, centre);
    const Vec3T<T> acceleration = bias.linear + cross(bias.angular, centre) + cross(turning, moving);
    const Vec3T<T> push = moving * c.momentum + (c.weight - acceleration * c.mass) * T(dt);
    return {twist + cross(centre, push), push};
}

using TwoBodies = Lanes<double, 2, struct AnyProcessor>;

inline TwoBodies both(double a, double b) {
    return TwoBodies(TwoBodies::Vector{a, b});
}
inline Vec3T<TwoBodies> both(const Vec3& a, const Vec3& b) {
    return {both(a.x, b.x), both(a.y, b.y), both(a.z, b.z)};
}
inline SpatialT<TwoBodies> both(const Spatial& a, const Spatial& b) {
    return {both(a.angular, b.angular), both(a.linear, b.linear)};
}
inline void put(const TwoBodies& x, double& a, double& b) {
    a = x[0], b = x[1];
}
inline void put(const Vec3T<TwoBodies>& v, Vec3& a, Vec3& b) {
    put(v.x, a.x, b.x), put(v.y, a.y, b.y), put(v.z, a.z, b.z);
}
inline void put(const SpatialInertiaT<TwoBodies>& I, SpatialInertia& a, SpatialInertia& b) {
    put(I.mass, a.mass, b.mass), put(I.moment, a.moment, b.moment);
    put(I.inertia.xx, a.inertia.xx, b.inertia.xx), put(I.inertia.yy, a.inertia.yy, b.inertia.yy);
    put(I.inertia.zz, a.inertia.zz, b.inertia.zz), put(I.inertia.xy, a.inertia.xy, b.inertia.xy);
    put(I.inertia.xz, a.inertia.xz, b.inertia.xz), put(I.inertia.yz, a.inertia.yz, b.inertia.yz);
}

/// True if set_two serves: gravity acts on all of it.
inline bool is_plain(const Body& body) {
    return has_principal_axes(body) && body.gravity_mass == body.mass;
}

[[gnu::always_inline]] inline void set_two(const Vec3& gravity, const Body& a, const Body& b, double dt,
                                           double momentum_weight, BodyWork& wa, BodyWork& wb) {
    const Mat3 &Ra = wa.X_WB.R, &Rb = wb.X_WB.R, &Ia = a.inertia_C, &Ib = b.inertia_C;
    const Mat3T<TwoBodies> R{both(Ra.r0, Rb.r0), both(Ra.r1, Rb.r1), both(Ra.r2, Rb.r2)};
    const Vec3T<TwoBodies> inertia{both(Ia.r0.x, Ib.r0.x), both(Ia.r1.y, Ib.r1.y), both(Ia.r2.z, Ib.r2.z)};
    const Vec3T<TwoBodies> centre = both(wa.centre, wb.centre);
    const TwoBodies mass = both(a.mass, b.mass);
    const Sym3T<TwoBodies> inertia_C = rotated_diagonal(R, inertia);
    put(spatial_inertia(mass, centre, inertia_C), wa.inertia, wb.inertia);
    const Cause<TwoBodies> cause{
        mass, mass * TwoBodies(momentum_weight), inertia_C, broadcast<TwoBodies>(gravity) * mass, {}};
    const SpatialT<TwoBodies> impulse =
        of(cause, centre, both(wa.velocity, wb.velocity), both(wa.bias, wb.bias), dt, momentum_weight);
    put(impulse.angular, wa.impulse.angular, wb.impulse.angular);
    put(impulse.linear, wa.impulse.linear, wb.impulse.linear);
}

}  // namespace body_impulse

/// Inertias and impulses of bodies `first` .. `last` - 1: momentum * momentum_weight + dt * (weight - bias
/// force), about O. `gravity`: m/s^2, world axes.
template <class T>
void set_body_impulses(const Vec3& gravity, double dt, double momentum_weight, std::size_t first,
                       std::size_t last, Mechanics<T>& work) {
    const std::vector<Body>& bodies = work.type->bodies;
    for (std::size_t b = first; b < last; ++b) {
        const Body& body = bodies[b];
        BodyWorkT<T>& w = work.bodies[b];
        if constexpr (std::is_same_v<T, double>) {
            if (b + 1 < last && body_impulse::is_plain(body) && body_impulse::is_plain(bodies[b + 1])) {
                ++b;
                body_impulse::set_two(gravity, body, bodies[b], dt, momentum_weight, w, work.bodies[b]);
                continue;
            }
        }
        const Vec3T<T> weight = broadcast<T>(gravity) * T(body.gravity_mass);
        body_impulse::Cause<T> cause{
            T(body.mass), T(body.mass * momentum_weight), set_inertia(body, w), weight, {}};
        if (body.gravity_mass != body.mass)
            cause.torque = cross(w.X_WB * broadcast<T>(body.p_BG) - work.origin - w.centre, weight);
        w.impulse = body_impulse::of(cause, w.centre, w.velocity, w.bias, dt, momentum_weight);
    }
}

/// Of all bodies.
template <class T>
void set_body_impulses(const Vec3& gravity, double dt, double momentum_weight, Mechanics<T>& work) {
    set_body_impulses(gravity, dt, momentum_weight, 0, work.type->bodies.size(), work);
}

}  // namespace roboss
