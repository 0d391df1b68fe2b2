// What is only done for one robot at a time: wrenches, drag and water; see dynamics.h.
#include "physics/dynamics/dynamics.h"

#include "physics/bonds/bond_cover.h"
#include "physics/dynamics/body_walk.h"
#include "physics/dynamics/drag.h"
#include "physics/dynamics/fluid_forces.h"

namespace roboss {
namespace {

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

/// Makes room for the motion of a kinematic robot in the tick.
void widen_shapes(double dt, RobotWork& work) {
    const RobotType& type = *work.type;
    work.box = {};
    for (const std::uint32_t s : type.shape_groups.loose) {
        work.speed = std::max(work.speed, widen_shape(dt, work, s, work.shapes[s]));
        work.box.include(work.shapes[s].box);
    }
    for (std::size_t k = 0; k < work.crowds.size(); ++k) {
        const ShapeCrowd& crowd = type.shape_groups.crowds[k];
        const Transform& X_WB = body_frame(work, crowd.body);
        const double speed = speed_within(work, work.base, X_WB.p, crowd.radius);
        work.crowds[k].margin = kBaseMargin + dt * speed;
        work.crowds[k].box = crowd_box(crowd, X_WB, work.crowds[k].margin);
        work.speed = std::max(work.speed, speed);
        work.box.include(work.crowds[k].box);
    }
    if (work.shapes.empty()) work.box.include(work.origin);
}

/// What the robot's scenery reaches; it stands where the base does.
Aabb scenery_bound(const RobotType& type, const RobotState& state) {
    const Transform X_W0 = to_transform(base_pose(state));
    const Aabb& box = type.scenery;
    Aabb bound;
    for (int corner = 0; corner < 8; ++corner)
        bound.include(X_W0 * Vec3{(corner & 1) != 0 ? box.max.x : box.min.x,
                                  (corner & 2) != 0 ? box.max.y : box.min.y,
                                  (corner & 4) != 0 ? box.max.z : box.min.z});
    return bound.inflated(kBaseMargin);
}

}  // namespace

template void forward_kinematics<double>(const RobotType&, std::span<const double>, Mechanics<double>&);
template void forward_velocities<double>(const RobotType&, std::span<const double>, Mechanics<double>&);
template void place_shapes<double>(const RobotType&, double, Mechanics<double>&);
template void compute_mass_matrix<double>(const RobotType&, double, Mechanics<double>&);

Spatial base_velocity(const RobotType& type, const RobotState& state) {
    if (!type.kinematic || state.surfaces.empty()) return {};
    const SurfaceMotion& motion = state.surfaces.front();
    const Transform X_W0 = to_transform(base_pose(state));
    const Transform X_WL = X_W0 * type.links[motion.link.index()].X_BL;
    const Vec3 w = X_WL.R * motion.angular_L;
    return {w, X_WL.R * motion.linear_L + cross(w, X_W0.p - X_WL.p)};
}

void place_robot(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    const RobotType& type = type_of(model.type_of(id), state);
    work.id = id;
    work.take(type, state);
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.bonded = work.asleep = false;
    work.placed = true;
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    place_shapes<double>(type, model.dt_s, work);
    work.base = base_velocity(type, state);
    if (!is_zero(work.base)) widen_shapes(model.dt_s, work);
    if (!type.scenery.empty()) work.box.include(scenery_bound(type, state));
    cover_bonds(model, work);
}

void compute_impulse(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                     std::span<const double> v, RobotWork& work, BodyWalk* walk) {
    const RobotType& type = *work.type;
    const Vec3 gravity = gravity_of(model, type);
    const bool shared = walk != nullptr && walk->shares(type);
    if (shared)
        walk->each_block(type, [&](std::size_t first, std::size_t last) {
            set_body_impulses(gravity, dt, momentum_weight, first, last, work);
        });
    else
        set_body_impulses(gravity, dt, momentum_weight, work);
    add_wrenches(*work.type, *work.state, dt, work);
    if (!work.type->drags.empty()) add_drag(model, dt, momentum_weight != 0, work);
    work.flows.clear();
    if (work.type->feels_flow) add_fluid_forces(model, dt, momentum_weight, q, work);
    if (!shared) return sum_impulses(dt, momentum_weight, q, v, work);
    work.impulse.resize(static_cast<std::size_t>(type.nv));
    walk->branches().walk_to_root(
        walk->team(), [&](std::size_t b) { project_impulse(type, b, work); },
        [&](std::size_t b) { pass_impulse(type, b, work); });
    add_joint_impulses(type, dt, momentum_weight, q, v, work);
}

void keep_inertias(double dt, Mechanics<double>& work) {
    work.own_inertias.clear(), work.joint_inertias.clear();
    for (const BodyWork& body : work.bodies) work.own_inertias.push_back(body.inertia);
    for (const Dof& dof : work.type->dofs) work.joint_inertias.push_back(joint_inertia(dof, dt));
}

void compute_inertias(const RobotType& type, RobotWork& work) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) set_inertia(type.bodies[b], work.bodies[b]);
    work.flows.clear();
    if (type.feels_flow) set_added_masses(type, work);
}

}  // namespace roboss
