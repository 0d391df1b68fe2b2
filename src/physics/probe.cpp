// See probe.h. Joint reactions by recursive Newton-Euler (Featherstone 2008, chapter 5) from the velocities
// at both ends of the tick: a joint passes on what its subtree's motion takes and no outer force gives.
#include "physics/probe.h"

#include "core/float_env.h"
#include "physics/integrate.h"
#include "physics/robot_work.h"

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

/// Adds `scale` times a contact's impulses on the link.
void take_contact(const ContactReport& c, LinkId link, double scale, const RobotWork& work,
                  std::span<Spatial> taken) {
    const int body = work.type->links[link.index()].body;
    if (body < 0) return;
    const Vec3 impulse = c.normal * c.impulse + c.friction;
    taken[static_cast<std::size_t>(body)] +=
        Spatial{c.moment + cross(c.p_W - work.origin, impulse), impulse} * scale;
}

void take_loop(const LoopJoint& loop, const Spatial& force, std::span<Spatial> taken) {
    if (loop.body_b >= 0) taken[static_cast<std::size_t>(loop.body_b)] += force * -1.0;
    if (loop.body_a >= 0) taken[static_cast<std::size_t>(loop.body_a)] += force;
}

/// Where the joint is, in its child, from the robot's origin.
Vec3 origin_of(const LoopJoint& loop, const RobotWork& work) {
    if (loop.body_b >= 0)
        return work.bodies[static_cast<std::size_t>(loop.body_b)].X_WB * loop.X_BJ.p - work.origin;
    const std::vector<double>& q = work.state->q;
    return rotate(Quat{q[3], q[4], q[5], q[6]}, loop.X_BJ.p);
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
    scratch_.keep_loads(true);
    step_island(model_, tick, ids_, pointers_, {}, bounds_, scratch_);
    const std::span<const ContactReport> found = read_contacts(scratch_);
    contacts_.assign(found.begin(), found.end());
    const std::span<const LoopLoad> loads = read_loop_loads(scratch_);
    loads_.assign(loads.begin(), loads.end());
    free_.resize(n);
    for (std::size_t i = 0; i < n; ++i) free_[i] = moved_freely(scratch_, i);
}

std::vector<JointReaction> StepProbe::joint_reactions(RobotId robot) const {
    const ExactFloatScope exact;
    const RobotType& type = model_.type_of(robot);
    std::vector<JointReaction> reactions;
    RobotState state = before_[robot.index()];
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
    const std::vector<Spatial> acceleration = accelerations(work, rate);
    compute_impulse(model_, 1.0, 0.0, state.q, state.v,
                    work);  // outer and centrifugal forces of the subtrees
    std::vector<Spatial> taken(type.bodies.size());
    for (std::size_t b = 0; b < taken.size(); ++b) taken[b] = work.bodies[b].inertia * acceleration[b];
    for (const ContactReport& c : contacts_) {
        const double per_s = 1.0 / model_.dt_s;
        if (c.robot_a == robot) take_contact(c, c.link_a, -per_s, work, taken);
        if (c.robot_b == robot) take_contact(c, c.link_b, per_s, work, taken);
    }
    const std::vector<Spatial> loops = forces_of_loops(robot, type);
    for (std::size_t l = 0; l < loops.size(); ++l) take_loop(type.loops[l], loops[l], taken);
    for (std::size_t b = taken.size(); b-- > 0;)
        if (type.bodies[b].parent >= 0) {
            const auto parent = static_cast<std::size_t>(type.bodies[b].parent);
            taken[parent] += taken[b];
        }
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        const Joint& joint = type.joints[j];
        Spatial passed;
        Vec3 arm;  // of the joint's origin
        if (joint.body >= 0) {
            const auto b = static_cast<std::size_t>(joint.body);
            passed = (taken[b] - work.bodies[b].impulse) * (joint.reversed ? -1.0 : 1.0);
            arm = work.bodies[b].X_WB.p - work.origin;
        } else if (joint.loop >= 0) {
            const auto l = static_cast<std::size_t>(joint.loop);
            passed = loops[l];
            arm = origin_of(type.loops[l], work);
        } else {
            continue;
        }
        reactions.push_back({JointId(j), passed.linear, passed.angular - cross(arm, passed.linear)});
    }
    return reactions;
}

/// On their bodies B, about the robot's origin.
std::vector<Spatial> StepProbe::forces_of_loops(RobotId robot, const RobotType& type) const {
    std::vector<Spatial> forces(type.loops.size());
    for (const LoopLoad& load : loads_)
        if (load.robot == robot)
            forces[static_cast<std::size_t>(load.loop)] += load.impulse * (1.0 / model_.dt_s);
    return forces;
}

}  // namespace roboss
