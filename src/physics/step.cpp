// step_island: orders, then the robots that may meet others, some groups at a time, then each of the rest by
// itself, or a few of one type in lanes; so that a robot needs no memory between ticks but its state.
#include "physics/step.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/float_env.h"
#include "core/make_room.h"
#include "core/union_find.h"
#include "physics/coarse_bound.h"
#include "physics/group_step.h"
#include "physics/lane_stepper.h"
#include "physics/meetings.h"
#include "physics/sleep.h"

namespace roboss {

struct StepScratch::Impl {
    GroupScratch group;
    std::vector<RobotWork> works;     // of some robots that may meet; only the first are in use
    std::vector<RobotWork> alone{1};  // the others, one after the other
    std::vector<Aabb> coarse;
    Meetings meetings;
    UnionFind joined;                        // of robots: who may meet, directly or by way of others
    std::vector<std::uint32_t> active;       // awake, or about to wake
    std::vector<std::uint32_t> near, batch;  // `near`: who may meet others, or sleeps, set by set
    std::vector<char> is_near, ordered, moved_freely;
    std::vector<float> efforts;
    std::vector<ContactReport> contacts;
    std::unique_ptr<LaneStepper> lanes = make_lane_stepper(Precision::kDouble, kMostLanes);
    std::unique_ptr<LaneStepper> float_lanes = make_lane_stepper(Precision::kFloat, kMostLanes);
    std::unique_ptr<LaneStepper> single = make_single_stepper();
    LaneQueue queue;

    /// The steppers for a model.
    LaneSteppers steppers(const Model& model) const {
        if (model.precision == Precision::kFloat) return {float_lanes.get(), single.get()};
        return {lanes.get(), nullptr};
    }
};

StepScratch::StepScratch() : impl_(std::make_unique<Impl>()) {}
StepScratch::~StepScratch() = default;
StepScratch::StepScratch(StepScratch&&) noexcept = default;
StepScratch& StepScratch::operator=(StepScratch&&) noexcept = default;

namespace {

using Impl = StepScratch::Impl;

/// A sleeper's box is in its state; the rest of it is computed only if something comes near.
void place(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    if (!state.rest.asleep) return place_robot(model, id, state, work);
    work.id = id;
    work.type = &model.type_of(id);
    work.state = &state;
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.placed = false;
    work.asleep = true;
    work.box = state.rest.bound;
}

/// Marks the robots that have an order at this tick.
void apply_orders(const Model& model, std::span<const RobotId> robots, std::span<RobotState* const> states,
                  std::span<const Order> orders, std::vector<char>& ordered) {
    ordered.assign(robots.size(), 0);
    for (const Order& order : orders) {
        const auto found = std::lower_bound(robots.begin(), robots.end(), order.robot);
        if (found == robots.end() || *found != order.robot) continue;
        const auto i = static_cast<std::size_t>(found - robots.begin());
        apply_order(model, order, *states[i]);
        ordered[i] = 1;
    }
}

bool is_finite(const RobotState& state) {
    double sum = 0;
    for (double x : state.q) sum += x - x;
    for (double x : state.v) sum += x - x;
    return sum == 0;
}

void expire_wrenches(Tick tick, RobotState& state) {
    std::erase_if(state.wrenches, [&](const TimedWrench& w) { return w.until <= tick + 1; });
}

/// The joint of the tree that moves a body; none: the base.
JointId joint_of_body(const RobotType& type, int body) {
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (type.joints[j].body == body && type.joints[j].loop < 0) return JointId(j);
    return JointId();
}

/// Of the first body whose coordinates or velocities are not finite.
JointId broken_joint(const RobotType& type, const RobotState& state) {
    const auto broken = [](const std::vector<double>& values, int first, std::size_t count) {
        const auto begin = values.begin() + first;
        return !std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                            [](double x) { return std::isfinite(x); });
    };
    if (broken(state.q, 0, 7) || broken(state.v, 0, static_cast<std::size_t>(type.base_nv())))
        return JointId();
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        if (body.joint == JointKind::kFree) continue;
        const auto width = static_cast<std::size_t>(joint_traits(body.joint).nq);
        if (broken(state.q, body.q_index, width) ||
            broken(state.v, body.v_index, static_cast<std::size_t>(body.nv)))
            return joint_of_body(type, static_cast<int>(b));
    }
    return JointId();
}

/// See StepReport::not_finite.
void note_failure(const RobotWork& work, bool beyond_numbers, JointId joint, StepReport& report) {
    const bool is_first =
        !report.not_finite.valid() ||
        std::pair(!beyond_numbers, work.id) < std::pair(!report.beyond_numbers, report.not_finite);
    if (!is_first) return;
    report.not_finite = work.id;
    report.not_finite_joint = joint;
    report.beyond_numbers = beyond_numbers;
}

/// A robot so fast that its displacement in one tick is not finite: it would meet everybody, and spoil them.
/// The body of its first such part, -1: the base; none: it is not so fast.
std::optional<int> body_beyond_numbers(const RobotWork& work) {
    if (!is_finite(work.origin)) return -1;
    for (std::size_t i = 0; i < work.shapes.size(); ++i)
        if (!std::isfinite(work.shapes[i].margin)) return work.type->shapes[i].body;
    return std::nullopt;
}

constexpr float kEffort = 2;  // of a step beside its Newton iterations

/// What these robots' step was worth, each the same.
void share_effort(std::span<const std::uint32_t> robots, int iterations, std::vector<float>& efforts) {
    const float each = kEffort + static_cast<float>(iterations) / static_cast<float>(robots.size());
    for (const std::uint32_t i : robots) efforts[i] = each;
}

constexpr double kFar = 1e300;
constexpr Aabb kEverywhere{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

/// Joins the sleeper with those on whom its sleep hangs. Whether it will wake: one of them is gone or awake.
bool join_neighbours(const Model& model, std::span<const RobotId> robots, std::span<RobotState* const> states,
                     std::uint32_t sleeper, Impl& s) {
    bool wakes = false;
    for (const std::uint32_t id : states[sleeper]->rest.neighbours) {
        const auto found = std::lower_bound(robots.begin(), robots.end(), RobotId(id));
        if (found == robots.end() || found->value != id) {
            wakes = true;
            continue;
        }
        const auto i = static_cast<std::uint32_t>(found - robots.begin());
        s.joined.unite(sleeper, i);
        wakes |= wakes_neighbours(model.type_of(*found), states[i]->rest.asleep, s.ordered[i] != 0);
    }
    return wakes;
}

/// Parts the robots into sets that may meet, or sleep, and those alone. The exact boxes lie inside the coarse
/// ones, so that the parting changes no bit.
void find_near(const Model& model, std::span<const RobotId> robots, std::span<RobotState* const> states,
               Impl& s) {
    const std::size_t count = robots.size();
    s.is_near.assign(count, 0), s.near.clear(), s.active.clear();
    s.joined.reset(count), s.coarse.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const RobotState& state = *states[i];
        if (state.rest.asleep) {
            s.is_near[i] = 1;
            s.coarse[i] = state.rest.bound;
            if (join_neighbours(model, robots, states, i, s)) s.active.push_back(i);
        } else if (count > 1) {
            s.coarse[i] = coarse_bound(model.type_of(robots[i]), state, model.dt_s);
            s.active.push_back(i);
        }
        if (count > 1 && !is_finite(s.coarse[i].max - s.coarse[i].min)) {
            s.is_near[i] = 1;
            s.coarse[i] = kEverywhere;
        }
    }
    if (count > 1) s.meetings.join(s.coarse, s.active, s.joined);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t root = s.joined.find(i); root != i) s.is_near[i] = s.is_near[root] = 1;
    for (std::uint32_t i = 0; i < count; ++i)
        if (s.is_near[i]) s.near.push_back(i);
    s.joined.sort_by_set(s.near);
}

/// Who touched whom, for read_contacts.
void keep_contacts(std::span<const RobotWork> robots, std::span<const Contact> contacts,
                   std::vector<ContactReport>& reports) {
    for (const Contact& c : contacts) {
        if (c.impulse <= 0) continue;
        const RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
        ContactReport report;
        report.robot_a = a.id;
        report.link_a = a.type->shapes[c.shape_a].link;
        if (c.robot_b >= 0) {
            const RobotWork& b = robots[static_cast<std::size_t>(c.robot_b)];
            report.robot_b = b.id;
            report.link_b = b.type->shapes[c.shape_b].link;
        } else {
            report.scenery = c.shape_b;
        }
        report.p_W = c.p_W, report.shift_b = c.shift_b, report.normal = c.normal, report.gap = c.gap;
        report.impulse = c.impulse, report.friction = c.friction, report.moment = c.moment;
        reports.push_back(report);
    }
}

/// One call of step_island.
struct Call {
    const Model& model;
    Tick tick;
    std::span<const RobotId> robots;
    std::span<RobotState* const> states;
    std::span<Aabb> bounds;

    /// False if a robot cannot be stepped.
    bool place_all(std::span<const std::uint32_t> chosen, std::span<RobotWork> works, Impl& s,
                   StepReport& report) const {
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            const std::uint32_t i = chosen[k];
            place(model, robots[i], *states[i], works[k]);
            works[k].ordered = s.ordered[i] != 0;
            bounds[i] = works[k].box;
        }
        bool fine = true;
        for (const RobotWork& work : works) {
            if (work.asleep) continue;
            const std::optional<int> body = body_beyond_numbers(work);
            if (!body) continue;
            note_failure(work, true, joint_of_body(*work.type, *body), report);
            fine = false;
        }
        return fine;
    }

    /// Steps the chosen robots, which may meet each other and nobody else; not if one of them is beyond
    /// numbers.
    void step(std::span<const std::uint32_t> chosen, std::span<RobotWork> works, Impl& s,
              StepReport& report) const {
        if (!place_all(chosen, works, s, report)) return;
        const int before = report.iterations;
        s.group.tried_alone = works.data() == s.alone.data();
        step_group(model, works, s.group, report);
        share_effort(chosen, report.iterations - before, s.efforts);
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            s.moved_freely[chosen[k]] = !works[k].held;
            report.placed += works[k].placed ? 1 : 0;
            if (works[k].asleep) continue;
            RobotState& state = *states[chosen[k]];
            expire_wrenches(tick, state);
            if (!is_finite(state)) note_failure(works[k], false, broken_joint(*works[k].type, state), report);
        }
        if (s.group.keep_reactions) keep_contacts(works, s.group.contacts, s.contacts);
    }

    /// Steps a robot that meets nobody, or lets it wait until there are enough of its type.
    void step_alone(std::uint32_t i, Impl& s, StepReport& report) const {
        const std::size_t type = model.robots[robots[i].index()].type.index();
        if (!s.group.lanes || s.group.keep_reactions || !fits_lanes(model.types[type], *states[i]))
            return step({&i, 1}, s.alone, s, report);
        s.queue.add(type, i, s.group.lanes.width(),
                    [&](auto& batch) { return step_in_lanes(batch, s, report); });
    }

    /// True: the batch that comes next is to be stepped too.
    bool step_in_lanes(std::vector<std::uint32_t>& batch, Impl& s, StepReport& report) const {
        const int before = report.iterations;
        s.batch = batch;
        step_batch(
            s.group.lanes, model, batch, report,
            [&](std::uint32_t i) {
                return LaneRobot{robots[i], states[i], &bounds[i], false, {}};
            },
            [&](std::uint32_t i, bool stepped) {
                report.placed += stepped ? 1 : 0;
                if (!stepped) step({&i, 1}, s.alone, s, report);
                return true;
            });
        share_effort(s.batch, report.iterations - before, s.efforts);
        return true;
    }

    /// Steps those who may meet, some sets at a time: so few that what is computed of them stays in the
    /// cache, so many that lanes are filled.
    void step_near(Impl& s, StepReport& report) const {
        constexpr std::size_t kTogether = 16;
        std::size_t first = 0, last = 0;
        const auto step_some = [&] {
            const std::span<std::uint32_t> some = std::span(s.near).subspan(first, last - first);
            std::sort(some.begin(), some.end());
            make_room(s.works, some.size());
            if (s.works.size() < some.size()) s.works.resize(some.size());
            first = last;
            if (!some.empty()) step(some, std::span(s.works).first(some.size()), s, report);
        };
        s.joined.for_each_set(s.near, [&](std::span<const std::uint32_t> set) {
            last += set.size();
            if (last - first >= kTogether) step_some();
        });
        step_some();
    }

    void step_all_alone(Impl& s, StepReport& report) const {
        s.queue.start(model.types.size());
        for (std::uint32_t i = 0; i < robots.size(); ++i)
            if (!s.is_near[i]) step_alone(i, s, report);
        s.queue.finish([&](auto& batch) { return step_in_lanes(batch, s, report); });
    }
};

}  // namespace

Aabb interaction_bound(const Model& model, RobotId robot, const RobotState& state) {
    const ExactFloatScope exact;
    RobotWork work;
    RobotState copy = state;
    place_robot(model, robot, copy, work);
    return work.box;
}

StepReport step_island(const Model& model, Tick tick, std::span<const RobotId> robots,
                       std::span<RobotState* const> states, std::span<const Order> orders,
                       std::span<Aabb> bounds, StepScratch& scratch) {
    const ExactFloatScope exact;
    Impl& s = scratch.impl();
    StepReport report;
    s.contacts.clear(), s.group.reactions.clear();
    s.group.lanes = s.steppers(model);
    s.moved_freely.assign(robots.size(), 0);
    s.efforts.assign(robots.size(), 0);
    apply_orders(model, robots, states, orders, s.ordered);
    find_near(model, robots, states, s);
    const Call call{model, tick, robots, states, bounds};
    call.step_near(s, report);
    call.step_all_alone(s, report);
    if (s.group.keep_reactions)
        std::stable_sort(
            s.contacts.begin(), s.contacts.end(),
            [](const ContactReport& a, const ContactReport& b) { return a.robot_a < b.robot_a; });
    return report;
}

void StepScratch::use_lanes(std::size_t most) {
    most = std::min(most, kMostLanes);
    impl_->lanes = make_lane_stepper(Precision::kDouble, most);
    impl_->float_lanes = make_lane_stepper(Precision::kFloat, most);
}

std::size_t StepScratch::lanes(Precision precision) const {
    if (precision == Precision::kFloat) return impl_->float_lanes->width();
    return impl_->lanes ? impl_->lanes->width() : 1;
}

void StepScratch::keep_reactions(bool keep) {
    impl_->group.keep_reactions = keep;
}

std::span<const ContactReport> read_contacts(StepScratch& scratch) {
    return scratch.impl().contacts;
}

std::span<const LoopReaction> read_loop_reactions(StepScratch& scratch) {
    return scratch.impl().group.reactions;
}

std::span<const float> read_efforts(StepScratch& scratch) {
    return scratch.impl().efforts;
}

bool moved_freely(StepScratch& scratch, std::size_t index) {
    return scratch.impl().moved_freely[index] != 0;
}

}  // namespace roboss
