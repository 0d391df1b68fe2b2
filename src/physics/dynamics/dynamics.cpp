// What is only done for one robot at a time: wrenches, drag and water; see dynamics.h.
#include "physics/dynamics/dynamics.h"

#include "physics/bonds/bond_cover.h"
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

}  // namespace

template void forward_kinematics<double>(const RobotType&, std::span<const double>, Mechanics<double>&);
template void forward_velocities<double>(const RobotType&, std::span<const double>, Mechanics<double>&);
template void place_shapes<double>(const RobotType&, double, std::span<const double>, Mechanics<double>&);
template void compute_mass_matrix<double>(const RobotType&, double, Mechanics<double>&);

void place_robot(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    const RobotType& type = model.type_of(id);
    work.id = id;
    work.type = &type;
    work.state = &state;
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.bonded = work.asleep = false;
    work.placed = true;
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    place_shapes<double>(type, model.dt_s, state.q, work);
    cover_bonds(model, work);
}

void compute_impulse(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                     std::span<const double> v, RobotWork& work) {
    set_body_impulses(model, dt, momentum_weight, work);
    add_wrenches(*work.type, *work.state, dt, work);
    if (!work.type->drags.empty()) add_drag(model, dt, momentum_weight != 0, work);
    work.flows.clear();
    if (work.type->feels_flow) add_fluid_forces(model, dt, momentum_weight, q, work);
    sum_impulses(dt, momentum_weight, q, v, work);
}

void compute_inertias(const RobotType& type, RobotWork& work) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) set_inertia(type.bodies[b], work.bodies[b]);
    work.flows.clear();
    if (type.feels_flow) set_added_masses(type, work);
}

}  // namespace roboss
