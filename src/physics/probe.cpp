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
    scratch_.keep_contacts(true);
    step_island(model_, tick, ids_, pointers_, {}, bounds_, scratch_);
    const std::span<const ContactReport> found = read_contacts(scratch_);
    contacts_.assign(found.begin(), found.end());
    free_.resize(n);
    for (std::size_t i = 0; i < n; ++i) free_[i] = moved_freely(scratch_, i);
}

std::vector<JointReaction> StepProbe::joint_reactions(RobotId robot) const {
    const ExactFloatScope exact;
    const RobotType& type = model_.type_of(robot);
    std::vector<JointReaction> reactions;
    if (type.has_equalities()) return reactions;
    RobotState state = before_[robot.index()];
    const std::vector<double>& v_after = after_[robot.index()].v;
    std::vector<double> rate(state.v.size());
    for (std::size_t i = 0; i < rate.size(); ++i) {
        rate[i] = (v_after[i] - state.v[i]) / model_.dt_s;
        if (free_[robot.index()]) state.v[i] = 0.5 * (state.v[i] + v_after[i]);
    }
    // The solver takes its forces at the beginning of the tick; of a free motion the middle is the better
    // mean.
    if (free_[robot.index()]) advance_coordinates(type, state.v, 0.5 * model_.dt_s, state.q);
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
    for (std::size_t b = taken.size(); b-- > 0;)
        if (type.bodies[b].parent >= 0) {
            const auto parent = static_cast<std::size_t>(type.bodies[b].parent);
            taken[parent] += taken[b];
        }
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        if (type.joints[j].body < 0) continue;
        const auto b = static_cast<std::size_t>(type.joints[j].body);
        const Vec3 arm = work.bodies[b].X_WB.p - work.origin;
        const Spatial passed = taken[b] - work.bodies[b].impulse;
        const double sign = type.joints[j].reversed ? -1.0 : 1.0;
        reactions.push_back(
            {JointId(j), passed.linear * sign, (passed.angular - cross(arm, passed.linear)) * sign});
    }
    return reactions;
}

}  // namespace roboss
