// See probe.h. Joint reactions by recursive Newton-Euler (Featherstone 2008, chapter 5) from the velocities
// at both ends of the tick: a joint passes on what its subtree's motion takes and no outer force gives.
#include "physics/probe.h"

#include "core/float_env.h"
#include "physics/bonds/bond_cover.h"
#include "physics/dynamics/drag.h"
#include "physics/dynamics/fluid_forces.h"
#include "physics/dynamics/integrate.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {
namespace {

/// Mean change of the bodies' velocities over the tick, from the axes and the joints' accelerations.
std::vector<Spatial> accelerations(const RobotWork& work, std::span<const double> rate) {
    const RobotType& type = *work.type;
    std::vector<Spatial> found(type.bodies.size());
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        Spatial a{};
        if (body.parent >= 0) a = found[static_cast<std::size_t>(body.parent)];
        for (int k = 0; k < body.nv; ++k) {
            const auto i = static_cast<std::size_t>(body.v_index + k);
            a += work.axes[i] * rate[i];
        }
        found[b] = a;
    }
    return found;
}

/// A place in a body, or in the fixed base, from the robot's origin.
Vec3 arm_to(const RobotWork& work, int body, const Vec3& p_BX) {
    if (body >= 0) return work.bodies[static_cast<std::size_t>(body)].X_WB * p_BX - work.origin;
    const std::vector<double>& q = work.state->q;
    return rotate(Quat{q[3], q[4], q[5], q[6]}, p_BX);
}

/// What a link's motion takes beyond what gravity gives it.
Spatial demand_of(const Model& model, const RobotWork& work, const Link& link,
                  std::span<const Spatial> acceleration) {
    const Vec3 centre = arm_to(work, link.body, link.p_BC);
    const Vec3 weight = link.gravity ? gravity_of(model, *work.type) * link.mass : Vec3{};
    Spatial taken = Spatial{cross(centre, weight), weight} * -1.0;
    if (link.body < 0) return taken;
    const BodyWork& body = work.bodies[static_cast<std::size_t>(link.body)];
    const SpatialInertia inertia = spatial_inertia(link.mass, centre, rotated(body.X_WB.R, link.inertia_C));
    taken += inertia * (acceleration[static_cast<std::size_t>(link.body)] + body.bias);
    taken += cross_force(body.velocity, inertia * body.velocity);
    return taken;
}

/// What each link takes from the joints that hold it: its motion's demand less what Clients and the air give.
std::vector<Spatial> demands(const Model& model, const RobotWork& work, std::span<const double> rate) {
    const RobotType& type = *work.type;
    const std::vector<Spatial> acceleration = accelerations(work, rate);
    std::vector<Spatial> taken;
    for (const Link& link : type.links) taken.push_back(demand_of(model, work, link, acceleration));
    for (const TimedWrench& w : work.state->wrenches) {
        const Link& link = type.links[w.link.index()];
        const Vec3 moment = w.torque + cross(arm_to(work, link.body, link.p_BC), w.force);
        taken[w.link.index()] += Spatial{moment, w.force} * -1.0;
    }
    if (type.feels_flow) {
        std::vector<Spatial> forces(type.links.size());
        sum_fluid_forces(model, work, acceleration, forces);
        for (std::size_t l = 0; l < forces.size(); ++l) taken[l] += forces[l] * -1.0;
    }
    for (const LinkDrag& drag : type.drags) taken[drag.link.index()] += drag_force(model, work, drag) * -1.0;
    return taken;
}

/// Adds `scale` times a contact's impulses to what its link takes.
void take_contact(const ContactReport& c, LinkId link, const Vec3& p_W, double scale, const RobotWork& work,
                  std::span<Spatial> taken) {
    const Vec3 impulse = c.normal * c.impulse + c.friction;
    taken[link.index()] += Spatial{c.moment + cross(p_W - work.origin, impulse), impulse} * scale;
}

void take_loop(const LoopJoint& loop, const Spatial& force, std::span<Spatial> taken) {
    if (loop.link_b >= 0) taken[static_cast<std::size_t>(loop.link_b)] += force * -1.0;
    if (loop.link_a >= 0) taken[static_cast<std::size_t>(loop.link_a)] += force;
}

/// What each joint of the tree passes on to the links that hang on it, however far.
std::vector<Spatial> passed_on(const RobotType& type, std::span<const Spatial> taken) {
    std::vector<Spatial> passed(type.joints.size());
    for (std::size_t l = 0; l < type.links.size(); ++l)
        for (int k = static_cast<int>(l); k >= 0; k = type.links[static_cast<std::size_t>(k)].parent) {
            const int carrier = type.links[static_cast<std::size_t>(k)].carrier;
            if (carrier >= 0) passed[static_cast<std::size_t>(carrier)] += taken[l];
        }
    return passed;
}

/// About each joint's own origin, on its child of the file. Welds that only repeat others bear nothing.
std::vector<JointReaction> read_reactions(const RobotWork& work, std::span<const Spatial> passed,
                                          std::span<const Spatial> loops) {
    const RobotType& type = *work.type;
    std::vector<int> carried(type.joints.size(), -1);
    for (std::size_t l = 0; l < type.links.size(); ++l)
        if (type.links[l].carrier >= 0)
            carried[static_cast<std::size_t>(type.links[l].carrier)] = static_cast<int>(l);
    std::vector<JointReaction> reactions;
    const auto add = [&](std::size_t joint, const Spatial& force, const Vec3& arm) {
        reactions.push_back(
            {JointId(joint), force.linear, force.angular - cross(arm, force.linear), work.origin + arm});
    };
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        const Joint& joint = type.joints[j];
        if (joint.loop >= 0) {
            const LoopJoint& loop = type.loops[static_cast<std::size_t>(joint.loop)];
            add(j, loops[static_cast<std::size_t>(joint.loop)], arm_to(work, loop.body_b, loop.X_BJ.p));
        } else if (carried[j] >= 0) {
            const Link& link = type.links[static_cast<std::size_t>(carried[j])];
            const int body = joint.body >= 0 ? joint.body : link.body;
            add(j, passed[j] * (joint.reversed ? -1.0 : 1.0), arm_to(work, body, joint.p_BJ));
        }
    }
    return reactions;
}

}  // namespace

void StepProbe::step(Tick tick, std::span<const RobotState* const> states) {
    const std::size_t n = states.size();
    before_.resize(n), after_.resize(n), pointers_.resize(n), bounds_.resize(n);
    ids_.clear();
    for (std::size_t i = 0; i < n; ++i) {
        ids_.emplace_back(i);
        before_[i] = *states[i];
        before_[i].rest = {};
        after_[i] = before_[i];
        pointers_[i] = &after_[i];
    }
    tick_ = tick;
    scratch_.keep_reactions(true);
    step_island(model_, tick, ids_, pointers_, {}, bounds_, scratch_);
    // What controllers push and drive in this tick is part of what joints bear.
    for (std::size_t i = 0; i < n; ++i) run_onboard(model_, tick, ids_[i], before_[i], onboard_);
    const std::span<const ContactReport> found = read_contacts(scratch_);
    contacts_.assign(found.begin(), found.end());
    const std::span<const LoopReaction> loads = read_loop_reactions(scratch_);
    loads_.assign(loads.begin(), loads.end());
    bond_loads_.clear();
    for (const RobotId id : ids_)
        if (!after_[id.index()].bonds.empty()) note_bonds(id);
    free_.resize(n);
    for (std::size_t i = 0; i < n; ++i) free_[i] = moved_freely(scratch_, i);
}

/// The bonds that held in the tick have its impulses.
void StepProbe::note_bonds(RobotId holder) {
    RobotWork work;
    place_robot(model_, holder, before_[holder.index()], work);
    const double per_s = 1.0 / model_.dt_s;
    for (const Bond& bond : after_[holder.index()].bonds) {
        const Vec3 p_W = pose_of(work, bond.link) * bond.p_L;
        const Vec3 force = bond.force_impulse * per_s, torque = bond.torque_impulse * per_s;
        bond_loads_.push_back({holder, bond.link, p_W, -force, -torque});
        if (bond.other != RobotId::kNone)
            bond_loads_.push_back({RobotId(bond.other), bond.other_link, p_W, force, torque});
    }
}

std::vector<JointReaction> StepProbe::joint_reactions(RobotId robot) const {
    const ExactFloatScope exact;
    RobotState state = before_[robot.index()];
    const RobotType& type = type_of(model_.type_of(robot), state);
    const std::vector<double>& v_after = after_[robot.index()].v;
    std::vector<double> rate(state.v.size());
    for (std::size_t i = 0; i < rate.size(); ++i) {
        rate[i] = (v_after[i] - state.v[i]) / model_.dt_s;
        if (free_[robot.index()]) state.v[i] = 0.5 * (state.v[i] + v_after[i]);
    }
    // The solver takes its forces at the beginning of the tick; of a free motion the middle is the better
    // mean.
    if (free_[robot.index()]) advance_coordinates<double>(type, state.v, 0.5 * model_.dt_s, state.q);
    RobotWork work;
    place_robot(model_, robot, state, work);
    // Velocities' part of the accelerations stands in the bodies' bias.
    std::vector<Spatial> taken = demands(model_, work, rate);
    for (const ContactReport& c : contacts_) {
        const double per_s = 1.0 / model_.dt_s;
        if (c.robot_a == robot) take_contact(c, c.link_a, c.p_W, -per_s, work, taken);
        if (c.robot_b == robot) take_contact(c, c.link_b, c.p_W + c.shift_b, per_s, work, taken);
    }
    for (const BondLoad& load : bond_loads_) {
        if (load.robot != robot) continue;
        const Vec3 moment = load.torque + cross(load.p_W - work.origin, load.force);
        taken[load.link.index()] += Spatial{moment, load.force} * -1.0;
    }
    const std::vector<Spatial> loops = forces_of_loops(robot, type);
    for (std::size_t l = 0; l < loops.size(); ++l) take_loop(type.loops[l], loops[l], taken);
    return read_reactions(work, passed_on(type, taken), loops);
}

/// On their bodies B, about the robot's origin.
std::vector<Spatial> StepProbe::forces_of_loops(RobotId robot, const RobotType& type) const {
    std::vector<Spatial> forces(type.loops.size());
    for (const LoopReaction& load : loads_)
        if (load.robot == robot)
            forces[static_cast<std::size_t>(load.loop)] += load.impulse * (1.0 / model_.dt_s);
    return forces;
}

}  // namespace roboss
