// step_island: the first three stages of a tick for all robots, then the others batch by batch (tick.h).
#include "physics/step.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/float_env.h"
#include "core/make_room.h"
#include "onboard/onboard.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/dynamics/pull.h"
#include "physics/lanes/lane_stepper.h"
#include "physics/near_sets.h"
#include "physics/robot_group.h"
#include "physics/tick.h"

namespace roboss {

struct StepScratch::Impl {
    GroupScratch group;
    std::vector<RobotWork> works;     // of some robots that may meet; only the first are in use
    std::vector<RobotWork> alone{1};  // the others, one after the other
    NearSets sets;
    std::vector<std::uint32_t> batch;
    std::vector<char> ordered, moved_freely;
    std::vector<float> efforts;
    StageNow now = nullptr;  // nullptr: stages are not measured
    StageClock clock;
    std::unique_ptr<LaneStepper> lanes = make_lane_stepper(Precision::kDouble, kMostLanes);
    std::unique_ptr<LaneStepper> float_lanes = make_lane_stepper(Precision::kFloat, kMostLanes);
    std::unique_ptr<LaneStepper> single = make_single_stepper();
    LaneQueue queue;
    OnboardScratch onboard;
    RobotWork pulled;  // for those that are pulled

    /// Forgets the last call.
    void start(const Model& model, std::size_t robots) {
        group.contact_reports.clear(), group.island[0].reactions.clear();
        group.lanes = steppers(model);
        moved_freely.assign(robots, 0);
        efforts.assign(robots, 0);
    }

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

/// What callers owe: broken by none but our own code, for states and assignments of others are checked where
/// they come in.
void check_input(const Model& model, Tick tick, std::span<const RobotId> robots,
                 std::span<RobotState* const> states, std::span<const Order> orders,
                 std::span<const Aabb> bounds) {
    ROBOSS_CHECK(model.dt_s > 0, std::to_string(model.dt_s));
    ROBOSS_CHECK(states.size() == robots.size() && bounds.size() == robots.size(),
                 std::to_string(robots.size()) + " robots, " + std::to_string(states.size()) + " states");
    for (std::size_t i = 0; i < robots.size(); ++i) {
        ROBOSS_CHECK(i == 0 || robots[i - 1] < robots[i], "robot " + std::to_string(robots[i].value));
        const RobotType& type = model.type_of(robots[i]);
        ROBOSS_CHECK(states[i]->q.size() == static_cast<std::size_t>(type.nq) &&
                         states[i]->v.size() == static_cast<std::size_t>(type.nv) &&
                         states[i]->motors.size() == type.motor_count() &&
                         states[i]->onboard.size() == static_cast<std::size_t>(type.onboard_size),
                     "the state of robot " + std::to_string(robots[i].value));
    }
    for (const Order& order : orders)
        ROBOSS_CHECK(order.apply_at == tick, "an order for tick " + std::to_string(order.apply_at) +
                                                 " at tick " + std::to_string(tick));
}

/// Marks the robots that have an order at this tick which may move them.
void apply_orders(const Model& model, std::span<const RobotId> robots, std::span<RobotState* const> states,
                  std::span<const Order> orders, std::vector<char>& ordered) {
    ordered.assign(robots.size(), 0);
    for (const Order& order : orders) {
        const auto found = std::lower_bound(robots.begin(), robots.end(), order.robot);
        if (found == robots.end() || *found != order.robot) continue;
        const auto i = static_cast<std::size_t>(found - robots.begin());
        apply_order(model, order, *states[i]);
        if (!std::holds_alternative<Transmit>(order.action)) ordered[i] = 1;
    }
}

/// Bonds that bore too much let go.
void let_go(const Model& model, std::span<RobotState* const> states) {
    for (RobotState* state : states)
        if (!state->bonds.empty() && !state->rest.asleep) let_go_of_overloads(model.dt_s, *state);
}

/// Lets the on-board controllers of those that are awake act.
void run_controllers(const Model& model, Tick tick, std::span<const RobotId> robots,
                     std::span<RobotState* const> states, OnboardScratch& scratch) {
    for (std::size_t i = 0; i < robots.size(); ++i)
        if (!model.type_of(robots[i]).onboard.empty() && !states[i]->rest.asleep)
            run_onboard(model, tick, robots[i], *states[i], scratch);
}

/// Pulls become wrenches of this tick.
void pull_robots(const Model& model, Tick tick, std::span<const RobotId> robots,
                 std::span<RobotState* const> states, RobotWork& work) {
    for (std::size_t i = 0; i < robots.size(); ++i)
        if (!states[i]->pulls.empty()) apply_pulls(model, tick, robots[i], *states[i], work);
}

constexpr float kEffort = 2;  // of a step beside its Newton iterations

/// What these robots' step was worth, each the same.
void share_effort(std::span<const std::uint32_t> robots, int iterations, std::vector<float>& efforts) {
    const float each = kEffort + static_cast<float>(iterations) / static_cast<float>(robots.size());
    for (const std::uint32_t i : robots) efforts[i] = each;
}

/// Steps the chosen robots, which may meet each other and no others. `tried`: it is one robot that lanes did
/// not step. One that did not fit for a bond may fit once that is dropped: in floats it must then be stepped
/// so, as it is where others are near.
void step_group(const StepCall& call, std::span<const std::uint32_t> chosen, std::span<RobotWork> works,
                Impl& s, bool tried = false) {
    s.group.tried_alone = tried;
    const int before = call.report.iterations;
    RobotGroup group(call, chosen, works, s.group);
    if (!step_robots(group, call.clock)) return;
    share_effort(chosen, call.report.iterations - before, s.efforts);
    for (std::size_t k = 0; k < chosen.size(); ++k) s.moved_freely[chosen[k]] = !works[k].held;
}

/// What a step leaves of sleepers whom nothing wakes: everything.
void let_sleep(const StepCall& call, Impl& s) {
    for (const std::uint32_t i : s.sets.sleepers()) {
        call.bounds[i] = call.states[i]->rest.bound;
        s.efforts[i] = kEffort;
        s.moved_freely[i] = 1;
    }
    call.report.asleep += static_cast<int>(s.sets.sleepers().size());
}

/// Steps those who may meet, some sets at a time: so few that what is computed of them stays in the cache, so
/// many that lanes are filled.
void step_groups(const StepCall& call, Impl& s) {
    constexpr std::size_t kTogether = 16;
    std::size_t first = 0, last = 0;
    const auto step_some = [&] {
        const std::span<std::uint32_t> some = s.sets.near().subspan(first, last - first);
        std::sort(some.begin(), some.end());
        make_room(s.works, some.size());
        if (s.works.size() < some.size()) s.works.resize(some.size());
        first = last;
        if (!some.empty()) step_group(call, some, std::span(s.works).first(some.size()), s);
    };
    s.sets.for_each_set([&](std::span<const std::uint32_t> set) {
        call.report.largest_group = std::max(call.report.largest_group, static_cast<int>(set.size()));
        last += set.size();
        if (last - first >= kTogether) step_some();
    });
    step_some();
}

/// Steps robots of one type that meet nobody in lanes, and those that cannot go so each by itself.
void step_in_lanes(const StepCall& call, std::vector<std::uint32_t>& batch, Impl& s) {
    const int before = call.report.iterations;
    s.batch = batch;
    step_batch(
        s.group.lanes, call.model, batch, call.report, call.clock,
        [&](std::uint32_t i) {
            return LaneRobot{call.robots[i], call.states[i], &call.bounds[i], false, {}};
        },
        [&](std::uint32_t i, bool stepped) {
            call.report.placed += stepped ? 1 : 0;
            if (!stepped) step_group(call, {&i, 1}, s.alone, s, true);
        });
    share_effort(s.batch, call.report.iterations - before, s.efforts);
}

/// Steps each robot that meets nobody by itself, or with others of its type in lanes.
void step_lone_robots(const StepCall& call, Impl& s) {
    const Model& model = call.model;
    const auto step_lanes = [&](std::vector<std::uint32_t>& batch) { step_in_lanes(call, batch, s); };
    s.queue.start(model.types.size());
    for (std::uint32_t i = 0; i < call.robots.size(); ++i) {
        if (s.sets.is_near(i)) continue;
        const std::size_t type = model.robots[call.robots[i].index()].type.index();
        if (s.group.lanes && !s.group.keep_reactions && fits_lanes(model.types[type], *call.states[i]))
            s.queue.add(type, i, s.group.lanes.width(), step_lanes);
        else
            step_group(call, {&i, 1}, s.alone, s);
    }
    s.queue.finish(step_lanes);
}

/// By robot; groups come in another order.
void sort_contact_reports(std::vector<ContactReport>& reports) {
    std::ranges::stable_sort(reports, {}, &ContactReport::robot_a);
}

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
    check_input(model, tick, robots, states, orders, bounds);
    const ExactFloatScope exact;
    Impl& s = scratch.impl();
    StepReport report;
    s.clock.start(s.now, report.profile.stages);
    s.start(model, robots.size());
    s.clock.enter(Stage::kOrders);
    apply_orders(model, robots, states, orders, s.ordered);
    let_go(model, states);
    s.clock.enter(Stage::kOnboard);
    run_controllers(model, tick, robots, states, s.onboard);
    pull_robots(model, tick, robots, states, s.pulled);
    s.clock.enter(Stage::kBroadPhase);
    s.sets.find({model, robots, states, s.ordered}, s.group.lanes);
    const StepCall call{model, tick, robots, states, bounds, s.ordered, report, s.clock};
    let_sleep(call, s);
    step_groups(call, s);       // batches of robots that may meet: step_robots (tick.h)
    step_lone_robots(call, s);  // batches of robots that meet nobody: likewise
    sort_contact_reports(s.group.contact_reports);
    s.clock.stop();
    if (s.group.profiles_solver) report.profile.solver.residual = report.residual;
    return report;
}

void StepScratch::use_lanes(std::size_t most) {
    most = std::min(most, kMostLanes);
    impl_->lanes = make_lane_stepper(Precision::kDouble, most);
    impl_->float_lanes = make_lane_stepper(Precision::kFloat, most);
}

void StepScratch::measure_stages(StageNow now) {
    impl_->now = now;
    impl_->group.profiles_solver = now != nullptr;
}

std::size_t StepScratch::lanes(Precision precision) const {
    if (precision == Precision::kFloat) return impl_->float_lanes->width();
    return impl_->lanes ? impl_->lanes->width() : 1;
}

void StepScratch::use_team(const Team& team) {
    impl_->group.team = team;
}

void StepScratch::keep_reactions(bool keep) {
    impl_->group.keep_reactions = keep;
}

std::span<const ContactReport> read_contacts(StepScratch& scratch) {
    return scratch.impl().group.contact_reports;
}

std::span<const LoopReaction> read_loop_reactions(StepScratch& scratch) {
    return scratch.impl().group.island[0].reactions;
}

std::span<const float> read_efforts(StepScratch& scratch) {
    return scratch.impl().efforts;
}

bool moved_freely(StepScratch& scratch, std::size_t index) {
    return scratch.impl().moved_freely[index] != 0;
}

}  // namespace roboss
