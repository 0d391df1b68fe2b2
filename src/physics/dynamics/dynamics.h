// Articulated dynamics in world axes about the base origin: recursive Newton-Euler for the bias, composite
// rigid bodies for the mass matrix (Featherstone 2008, chapters 5 and 6), with springs and damping taken
// implicitly. Written over T: one robot, or a few in lanes.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/joint_motion.h"
#include "physics/dynamics/body_impulses.h"
#include "physics/dynamics/fluid_forces.h"
#include "physics/dynamics/robot_work.h"
#include "physics/dynamics/shape_places.h"

namespace roboss {

template <class T>
TransformT<T> base_transform(std::span<const T> q) {
    return {to_matrix(QuatT<T>{q[3], q[4], q[5], q[6]}), {q[0], q[1], q[2]}};
}

/// The part of a row that the free base's axes give: unit vectors, so the components themselves. Returns how
/// many of the row's `length` entries these are.
template <class T>
std::size_t put_base_part(const SpatialT<T>& force, std::size_t length, T* row) {
    const T parts[6] = {force.angular.x, force.angular.y, force.angular.z,
                        force.linear.x,  force.linear.y,  force.linear.z};
    const std::size_t count = std::min<std::size_t>(length, 6);
    std::copy_n(parts, count, row);
    return count;
}

/// Places one body; its parent is placed.
template <class T>
[[gnu::always_inline]] inline void place_body(const RobotType& type, const TransformT<T>& X_WR,
                                              std::span<const T> q, std::size_t b, Mechanics<T>& work) {
    const Body& body = type.bodies[b];
    BodyWorkT<T>& w = work.bodies[b];
    TransformT<T> X_WJ = X_WR;
    if (body.joint != JointKind::kFree)
        X_WJ = (body.parent < 0 ? X_WR : work.bodies[static_cast<std::size_t>(body.parent)].X_WB) *
               broadcast<T>(body.X_PJ);
    w.X_WB = joint_motion(body, X_WJ, q);
    w.centre = w.X_WB * broadcast<T>(body.p_BC) - work.origin;
    joint_axes(body, X_WJ.R, {w.X_WB.R, w.X_WB.p - work.origin},
               &work.axes[static_cast<std::size_t>(body.v_index)]);
}

/// What placing begins with.
template <class T>
TransformT<T> start_placing(const RobotType& type, std::span<const T> q, Mechanics<T>& work) {
    const TransformT<T> X_WR = base_transform(q);
    work.origin = X_WR.p, work.X_W0 = X_WR;
    work.bodies.resize(type.bodies.size());
    work.axes.resize(static_cast<std::size_t>(type.nv));
    return X_WR;
}

template <class T>
void forward_kinematics(const RobotType& type, std::span<const T> q, Mechanics<T>& work) {
    const TransformT<T> X_WR = start_placing(type, q, work);
    for (std::size_t b = 0; b < type.bodies.size(); ++b) place_body(type, X_WR, q, b, work);
}

/// Velocity and bias of one body; those of its parent are known.
template <class T>
[[gnu::always_inline]] inline void move_body(const RobotType& type, std::span<const T> v, std::size_t b,
                                             Mechanics<T>& work) {
    const Body& body = type.bodies[b];
    BodyWorkT<T>& w = work.bodies[b];
    const auto first = static_cast<std::size_t>(body.v_index);
    if (body.joint == JointKind::kFree) {
        w.velocity = {{v[first], v[first + 1], v[first + 2]}, {v[first + 3], v[first + 4], v[first + 5]}};
        // A base whose origin does not accelerate: its spatial acceleration about the fixed point O is -w
        // x v.
        w.bias = {{}, -cross(w.velocity.angular, w.velocity.linear)};
        return;
    }
    SpatialT<T> joint = work.axes[first] * v[first];
    for (std::size_t k = 1; k < static_cast<std::size_t>(body.nv); ++k)
        joint += work.axes[first + k] * v[first + k];
    if (body.parent < 0) {
        w.velocity = joint;
        w.bias = {};
    } else {
        const BodyWorkT<T>& parent = work.bodies[static_cast<std::size_t>(body.parent)];
        w.velocity = parent.velocity + joint;
        w.bias = parent.bias + cross_motion(parent.velocity, joint);
    }
}

template <class T>
void forward_velocities(const RobotType& type, std::span<const T> v, Mechanics<T>& work) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) move_body(type, v, b, work);
}

/// Springs and rotor inertias: they act along one degree of freedom, outside the tree of bodies.
template <class T>
void add_joint_impulses(const RobotType& type, double dt, double momentum_weight, std::span<const T> q,
                        std::span<const T> v, Mechanics<T>& work) {
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Dof& dof = dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        if (dof.armature != 0) work.impulse[i] += momentum_weight * dof.armature * v[i];
        if (dof.spring_stiffness != 0) {
            const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
            work.impulse[i] -= dt * dof.spring_stiffness *
                               (q[static_cast<std::size_t>(body.q_index)] - dof.spring_reference);
        }
    }
}

/// The impulse of one body and its subtree along its degrees of freedom.
template <class T>
[[gnu::always_inline]] inline void project_impulse(const RobotType& type, std::size_t b, Mechanics<T>& work) {
    const Body& body = type.bodies[b];
    const BodyWorkT<T>& w = work.bodies[b];
    if (body.joint == JointKind::kFree) {
        put_base_part(w.impulse, 6, work.impulse.data());
        return;
    }
    for (int k = 0; k < body.nv; ++k) {
        const auto i = static_cast<std::size_t>(body.v_index + k);
        work.impulse[i] = dot(work.axes[i], w.impulse);
    }
}

/// Adds the impulse of a body and its subtree to that of its parent, if it has one.
template <class T>
[[gnu::always_inline]] inline void pass_impulse(const RobotType& type, std::size_t b, Mechanics<T>& work) {
    const int parent = type.bodies[b].parent;
    if (parent >= 0) work.bodies[static_cast<std::size_t>(parent)].impulse += work.bodies[b].impulse;
}

/// Sums the bodies' impulses from the tips to the root, along each degree of freedom.
template <class T>
void sum_impulses(double dt, double momentum_weight, std::span<const T> q, std::span<const T> v,
                  Mechanics<T>& work) {
    const RobotType& type = *work.type;
    work.impulse.resize(static_cast<std::size_t>(type.nv));
    for (std::size_t b = type.bodies.size(); b-- > 0;) {
        project_impulse(type, b, work);
        pass_impulse(type, b, work);
    }
    add_joint_impulses(type, dt, momentum_weight, q, v, work);
}

/// What implicit damping and springs in the mass matrix make of the velocities before, off the impulse:
/// where only what the tick changes is solved for.
template <class T>
void take_off_damping(double dt, std::span<const T> v, Mechanics<T>& work) {
    const RobotType& type = *work.type;
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Dof& dof = dofs[d];
        const double damping = dt * dof.damping + dt * dt * dof.spring_stiffness;
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        if (damping != 0) work.impulse[i] -= damping * v[i];
    }
}

/// Rows of the free base: its axes are unit vectors, so these are the entries of the whole robot's inertia.
template <class T>
void put_base_rows(const SpatialInertiaT<T>& whole, T* row) {
    const Sym3T<T>& I = whole.inertia;
    const Vec3T<T>& m = whole.moment;
    const T zero = 0;
    const T entries[21] = {I.xx,                                      //
                           I.xy, I.yy,                                //
                           I.xz, I.yz, I.zz,                          //
                           zero, m.z,  -m.y, whole.mass,              //
                           -m.z, zero, m.x,  zero,       whole.mass,  //
                           m.y,  -m.x, zero, zero,       zero,       whole.mass};
    std::copy_n(entries, 21, row);
}

/// What stands on a degree of freedom beside the inertias: rotor, damping and spring.
inline double joint_inertia(const Dof& dof, double dt) {
    return dof.armature + dt * dof.damping + dt * dt * dof.spring_stiffness;
}

void keep_inertias(double dt, Mechanics<double>& work);

template <class T>
void compute_mass_matrix(const RobotType& type, double dt, Mechanics<T>& work) {
    work.mass_matrix.resize(type.paths.entries());
    if constexpr (std::is_same_v<T, double>)
        if (!type.elimination.empty()) keep_inertias(dt, work);
    for (std::size_t b = type.bodies.size(); b-- > 0;) {
        const Body& body = type.bodies[b];
        const SpatialInertiaT<T>& subtree = work.bodies[b].inertia;
        if (body.joint == JointKind::kFree) {
            put_base_rows(subtree, work.mass_matrix.data());
            continue;
        }
        for (int axis = body.nv - 1; axis >= 0; --axis) {
            const auto i = static_cast<std::size_t>(body.v_index + axis);
            const SpatialT<T> momentum = subtree * work.axes[i];
            T* row = work.mass_matrix.data() + type.paths.row(i);
            const int* path = type.paths.path(i);
            const std::size_t length = type.paths.length(i);
            const std::size_t base = type.free_base ? put_base_part(momentum, length, row) : 0;
            for (std::size_t k = base; k < length; ++k)
                row[k] = dot(work.axes[static_cast<std::size_t>(path[k])], momentum);
        }
        if (body.parent >= 0) work.bodies[static_cast<std::size_t>(body.parent)].inertia += subtree;
    }
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Dof& dof = dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        work.mass_matrix[type.paths.diagonal(i)] += T(joint_inertia(dof, dt));
    }
    if constexpr (std::is_same_v<T, double>)
        if (!work.flows.empty()) add_flow_inertia(type, work);
}

}  // namespace roboss
