// Articulated dynamics in world axes about the base origin: recursive Newton-Euler for the bias, composite
// rigid bodies for the mass matrix (Featherstone 2008, chapters 5 and 6), with springs and damping taken
// implicitly.
#include <algorithm>
#include <cmath>

#include "model/joint_motion.h"
#include "physics/drag.h"
#include "physics/robot_work.h"

namespace roboss {
namespace {

Transform base_transform(std::span<const double> q) {
    return {to_matrix(Quat{q[3], q[4], q[5], q[6]}), {q[0], q[1], q[2]}};
}

SpatialInertia inertia_of(const Body& body, const BodyWork& w) {
    return spatial_inertia(body.mass, w.centre, rotated(w.X_WB.R, body.inertia_C));
}

/// Adds what Clients' wrenches do to the bodies' impulses (force at the link's centre of mass).
void add_wrenches(const RobotType& type, const RobotState& state, double dt, RobotWork& work) {
    for (const TimedWrench& w : state.wrenches) {
        const Link& link = type.links[w.link.index()];
        if (link.body < 0) continue;
        BodyWork& body = work.bodies[static_cast<std::size_t>(link.body)];
        const Vec3 arm = body.X_WB * link.p_BC - work.origin;
        body.impulse += Spatial{w.torque + cross(arm, w.force), w.force} * dt;
    }
}

/// Springs and rotor inertias: they act along one degree of freedom, outside the tree of bodies.
void add_joint_impulses(const RobotType& type, double dt, double momentum_weight, std::span<const double> q,
                        std::span<const double> v, RobotWork& work) {
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const Dof& dof = type.dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        if (dof.armature != 0) work.impulse[i] += momentum_weight * dof.armature * v[i];
        if (dof.spring_stiffness != 0) {
            const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
            work.impulse[i] -= dt * dof.spring_stiffness *
                               (q[static_cast<std::size_t>(body.q_index)] - dof.spring_reference);
        }
    }
}

/// The part of a row that the free base's axes give: unit vectors, so the components themselves. Returns how
/// many of the row's `length` entries these are.
std::size_t put_base_part(const Spatial& force, std::size_t length, double* row) {
    const double parts[6] = {force.angular.x, force.angular.y, force.angular.z,
                             force.linear.x,  force.linear.y,  force.linear.z};
    const std::size_t count = std::min<std::size_t>(length, 6);
    std::copy_n(parts, count, row);
    return count;
}

}  // namespace

void place_bodies(const RobotType& type, std::span<const double> q, RobotWork& work) {
    const Transform X_WR = base_transform(q);
    work.origin = X_WR.p;
    work.bodies.resize(type.bodies.size());
    work.axes.resize(static_cast<std::size_t>(type.nv));
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        BodyWork& w = work.bodies[b];
        Transform X_WJ = X_WR;
        if (body.joint != JointKind::kFree)
            X_WJ = (body.parent < 0 ? X_WR : work.bodies[static_cast<std::size_t>(body.parent)].X_WB) *
                   body.X_PJ;
        w.X_WB = joint_motion(body, X_WJ, q);
        w.centre = w.X_WB * body.p_BC - work.origin;
        joint_axes(body, X_WJ.R, {w.X_WB.R, w.X_WB.p - work.origin},
                   &work.axes[static_cast<std::size_t>(body.v_index)]);
    }
}

void move_bodies(const RobotType& type, std::span<const double> v, RobotWork& work) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        BodyWork& w = work.bodies[b];
        const auto first = static_cast<std::size_t>(body.v_index);
        if (body.joint == JointKind::kFree) {
            w.velocity = {{v[first], v[first + 1], v[first + 2]}, {v[first + 3], v[first + 4], v[first + 5]}};
            // A base whose origin does not accelerate: its spatial acceleration about the fixed point O is -w
            // x v.
            w.bias = {{}, -cross(w.velocity.angular, w.velocity.linear)};
            continue;
        }
        Spatial joint{};
        for (std::size_t k = 0; k < static_cast<std::size_t>(body.nv); ++k)
            joint += work.axes[first + k] * v[first + k];
        if (body.parent < 0) {
            w.velocity = joint;
            w.bias = {};
        } else {
            const BodyWork& parent = work.bodies[static_cast<std::size_t>(body.parent)];
            w.velocity = parent.velocity + joint;
            w.bias = parent.bias + cross_motion(parent.velocity, joint);
        }
    }
}

void place_shapes(const RobotType& type, double dt, RobotWork& work) {
    work.shapes.resize(type.shapes.size());
    work.box = {};
    work.speed = 0;
    for (std::size_t s = 0; s < type.shapes.size(); ++s) {
        const BodyShape& shape = type.shapes[s];
        ShapeWork& w = work.shapes[s];
        if (shape.body < 0) {
            w.X_WS = base_transform(work.state->q) * shape.X_BS;
            w.margin = kBaseMargin;
        } else {
            const BodyWork& body = work.bodies[static_cast<std::size_t>(shape.body)];
            w.X_WS = body.X_WB * shape.X_BS;
            const Vec3 at_shape = body.velocity.linear + cross(body.velocity.angular, w.X_WS.p - work.origin);
            const double radius = bounding_radius(shape.shape);
            const double speed =
                norm(at_shape) + (std::isfinite(radius) ? norm(body.velocity.angular) * radius : 0.0);
            w.margin = kBaseMargin + dt * speed;
            work.speed = std::fmax(work.speed, speed);
        }
        w.box = bounds(shape.shape, w.X_WS).inflated(w.margin);
        work.box.include(w.box);
    }
}

void place_robot(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    const RobotType& type = model.type_of(id);
    work.id = id;
    work.type = &type;
    work.state = &state;
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.asleep = false;
    work.placed = true;
    place_bodies(type, state.q, work);
    move_bodies(type, state.v, work);
    place_shapes(type, model.dt_s, work);
    if (type.shapes.empty()) work.box.include(work.origin);
}

void compute_impulse(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                     std::span<const double> v, RobotWork& work) {
    const RobotType& type = *work.type;
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        BodyWork& w = work.bodies[b];
        w.inertia = inertia_of(body, w);
        const Spatial momentum = w.inertia * w.velocity;
        const Vec3 weight = model.gravity * body.gravity_mass;
        const Vec3 feels = body.gravity_mass == body.mass ? w.centre : w.X_WB * body.p_BG - work.origin;
        const Spatial force =
            Spatial{cross(feels, weight), weight} - w.inertia * w.bias - cross_force(w.velocity, momentum);
        w.impulse = momentum * momentum_weight + force * dt;
    }
    add_wrenches(type, *work.state, dt, work);
    if (!type.drags.empty()) add_drag(model, dt, momentum_weight != 0, work);
    work.impulse.resize(static_cast<std::size_t>(type.nv));
    for (std::size_t b = type.bodies.size(); b-- > 0;) {
        const Body& body = type.bodies[b];
        const BodyWork& w = work.bodies[b];
        if (body.joint == JointKind::kFree) {
            put_base_part(w.impulse, 6, work.impulse.data());
            continue;
        }
        for (int k = 0; k < body.nv; ++k) {
            const auto i = static_cast<std::size_t>(body.v_index + k);
            work.impulse[i] = dot(work.axes[i], w.impulse);
        }
        if (body.parent >= 0) work.bodies[static_cast<std::size_t>(body.parent)].impulse += w.impulse;
    }
    add_joint_impulses(type, dt, momentum_weight, q, v, work);
}

void compute_inertias(const RobotType& type, RobotWork& work) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b)
        work.bodies[b].inertia = inertia_of(type.bodies[b], work.bodies[b]);
}

void compute_mass_matrix(const RobotType& type, double dt, RobotWork& work) {
    work.mass_matrix.resize(type.paths.entries());
    for (std::size_t b = type.bodies.size(); b-- > 0;) {
        const Body& body = type.bodies[b];
        const SpatialInertia& subtree = work.bodies[b].inertia;
        for (int axis = body.nv - 1; axis >= 0; --axis) {
            const auto i = static_cast<std::size_t>(body.v_index + axis);
            const Spatial momentum = subtree * work.axes[i];
            double* row = work.mass_matrix.data() + type.paths.row(i);
            const int* path = type.paths.path(i);
            const std::size_t length = type.paths.length(i);
            const std::size_t base = type.free_base ? put_base_part(momentum, length, row) : 0;
            for (std::size_t k = base; k < length; ++k)
                row[k] = dot(work.axes[static_cast<std::size_t>(path[k])], momentum);
        }
        if (body.parent >= 0) work.bodies[static_cast<std::size_t>(body.parent)].inertia += subtree;
    }
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const Dof& dof = type.dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        work.mass_matrix[type.paths.diagonal(i)] +=
            dof.armature + dt * dof.damping + dt * dt * dof.spring_stiffness;
    }
}

}  // namespace roboss
