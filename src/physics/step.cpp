// step_island: the first three stages of a tick for all robots, then the others batch by batch (tick.h).
#include "physics/step.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "core/check.h"
#include "core/float_env.h"
#include "core/make_room.h"
#include "onboard/onboard.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/dynamics/pull.h"
#include "physics/lanes/lane_stepper.h"
#include "physics/near_sets.h"
#include "physics/robot_group.h"
#include "physics/step_failure.h"
#include "physics/tick.h"

namespace roboss {

namespace {

/// What a thread of a team steps small groups with, beside the others.
struct Helper {
    explicit Helper(std::size_t lanes_most) : lanes(make_lane_stepper(Precision::kDouble, lanes_most)) {}

    GroupScratch group;
    std::vector<RobotWork> works;
    std::vector<RobotWork> alone{1};
    std::unique_ptr<LaneStepper> lanes;
    std::vector<std::uint32_t> batch, kept;
    StepReport report;
    StageClock clock;
};

/// The work that helpers step, one after the other: robots, numbers of the call, that may meet, or in lanes,
/// or a group of those on rough ground, or each alone.
struct Unit {
    enum class Kind : std::uint8_t { kGroup, kLanes, kRough, kAlone } kind = Kind::kGroup;
    std::size_t first = 0, last = 0;  // of NearSets::near() or Impl::lone
    std::size_t weight = 0;           // of its robots
};

}  // namespace

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
    std::size_t lanes_most = kMostLanes;
    std::vector<Helper> helpers;       // one a thread of the team
    std::vector<Unit> units;           // that they step side by side
    std::vector<std::uint32_t> lone;   // robots of these that meet no other
    std::vector<std::uint32_t> rough;  // some that meet no other, on rough ground
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
                         states[i]->own.empty() == (states[i]->own_type.get() == nullptr) &&
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
                GroupScratch& group_scratch, Impl& s, bool tried = false) {
    group_scratch.tried_alone = tried;
    const int before = call.report.iterations;
    RobotGroup group(call, chosen, works, group_scratch);
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

/// Steps some robots as one group; `works` grows to hold them.
void step_some(const StepCall& call, std::span<const std::uint32_t> some, std::vector<RobotWork>& works,
               GroupScratch& group, Impl& s) {
    make_room(works, some.size());
    if (works.size() < some.size()) works.resize(some.size());
    step_group(call, some, std::span(works).first(some.size()), group, s);
}

/// Steps robots that meet nobody, on rough ground.
void step_rough(const StepCall& call, std::span<const std::uint32_t> some, std::vector<RobotWork>& works,
                GroupScratch& group, Impl& s) {
    group.rough = true;
    step_some(call, some, works, group, s);
    group.rough = false;
}

/// Steps robots that may meet, some sets of them.
void step_sets(const StepCall& call, const Unit& unit, std::vector<RobotWork>& works, GroupScratch& group,
               Impl& s) {
    const std::span<std::uint32_t> some = s.sets.near().subspan(unit.first, unit.last - unit.first);
    std::sort(some.begin(), some.end());
    step_some(call, some, works, group, s);
}

/// Lists those who may meet, some sets at a time: so few that what is computed of them stays in the cache, so
/// many that lanes are filled.
void list_sets(const StepCall& call, Impl& s) {
    constexpr std::size_t kTogether = 16;
    Unit unit;
    const auto list = [&] {
        if (unit.last > unit.first) s.units.push_back(unit);
        unit.first = unit.last;
    };
    s.sets.for_each_set([&](std::span<const std::uint32_t> set) {
        call.report.largest_group = std::max(call.report.largest_group, static_cast<int>(set.size()));
        unit.last += set.size();
        if (unit.last - unit.first >= kTogether) list();
    });
    list();
}

/// Steps robots of one type that meet no other in lanes, and those that do not fit each by itself. `batch` is
/// empty afterwards; `kept` a buffer.
void step_in_lanes(const StepCall& call, std::vector<std::uint32_t>& batch, std::vector<std::uint32_t>& kept,
                   std::span<RobotWork> alone, GroupScratch& group, Impl& s) {
    const int before = call.report.iterations;
    kept = batch;
    step_batch(
        group.lanes, call.model, batch, call.report, call.clock,
        [&](std::uint32_t i) {
            return LaneRobot{call.robots[i], call.states[i], &call.bounds[i], false, {}};
        },
        [&](std::uint32_t i, bool stepped) {
            call.report.placed += stepped ? 1 : 0;
            if (!stepped) step_group(call, {&i, 1}, alone, group, s, true);
        });
    share_effort(kept, call.report.iterations - before, s.efforts);
}

/// A robot that leaned on something beside the ground in the last tick mostly still does, and then no
/// register has its contacts. In floats it tries all the same: how a robot is stepped must hang on it alone.
bool suits_lanes(const GroupScratch& group, const Model& model, const RobotType& type,
                 const RobotState& state) {
    const auto is_elsewhere = [&](const ContactMemory& contact) {
        return contact.other_shape != state.contacts[0].other_shape;
    };
    return !group.keep_reactions && group.lanes.take(model, type, state) &&
           (group.lanes.in_floats() || std::ranges::none_of(state.contacts, is_elsewhere));
}

/// On a surface of triangles robots touch the ground in many ways: contacts are found first, then those alike
/// are stepped in lanes (RobotGroup).
bool is_on_rough_ground(const Model& model, const RobotState& state) {
    if (state.contacts.empty() || state.contacts[0].other_robot != RobotId::kNone) return false;
    const std::uint32_t i = state.contacts[0].other_shape;
    return i < model.statics.size() && model.statics[i].shape.kind == ShapeKind::kSurface;
}

/// How many of them are one group: so many that registers are filled, so few that each thread has some.
std::size_t rough_group(const StepCall& call, const Impl& s) {
    constexpr std::size_t kLeast = 16, kMost = 128;
    return std::clamp(call.robots.size() / (2 * std::max<std::size_t>(s.group.team.size(), 1)), kLeast,
                      kMost);
}

/// Each robot that meets nobody: in_lanes(batch) with others of its type, rough(some) on rough ground, or
/// alone(i).
template <class InLanes, class Rough, class Alone>
void for_each_lone(const StepCall& call, Impl& s, const InLanes& in_lanes, const Rough& rough,
                   const Alone& alone) {
    const Model& model = call.model;
    const std::size_t most = rough_group(call, s);
    s.queue.start(model.types.size()), s.rough.clear();
    for (std::uint32_t i = 0; i < call.robots.size(); ++i) {
        if (s.sets.is_near(i)) continue;
        const std::size_t type = model.like(call.robots[i]).index();
        if (!suits_lanes(s.group, model, model.types[type], *call.states[i])) {
            alone(i);
        } else if (is_on_rough_ground(model, *call.states[i])) {
            s.rough.push_back(i);
            if (s.rough.size() == most) rough(s.rough), s.rough.clear();
        } else {
            s.queue.add(type, i, s.group.lanes.width(), in_lanes);
        }
    }
    s.queue.finish(in_lanes);
    if (!s.rough.empty()) rough(s.rough);
}

void step_lone_robots(const StepCall& call, Impl& s) {
    for_each_lone(
        call, s,
        [&](std::vector<std::uint32_t>& batch) { step_in_lanes(call, batch, s.batch, s.alone, s.group, s); },
        [&](std::span<const std::uint32_t> some) { step_rough(call, some, s.works, s.group, s); },
        [&](std::uint32_t i) {
            step_group(call, {&i, 1}, s.alone, s.group, s);
        });
}

/// Notes the weight of each unit; returns that of all.
std::size_t weigh_units(const StepCall& call, Impl& s) {
    std::size_t all = 0;
    for (Unit& unit : s.units) {
        const std::span<const std::uint32_t> robots =
            unit.kind == Unit::Kind::kGroup ? std::span<const std::uint32_t>(s.sets.near()) : s.lone;
        unit.weight = 0;
        for (const std::uint32_t i : robots.subspan(unit.first, unit.last - unit.first))
            unit.weight += weight_of(call.model.type_of(call.robots[i]));
        all += unit.weight;
    }
    return all;
}

/// Adjacent robots that are stepped alone become one unit.
void join_lone_units(Impl& s) {
    constexpr std::size_t kBlock = 16;
    std::size_t kept = 0;
    for (const Unit& unit : s.units) {
        Unit* last = kept > 0 ? &s.units[kept - 1] : nullptr;
        if (last != nullptr && unit.kind == Unit::Kind::kAlone && last->kind == Unit::Kind::kAlone &&
            last->last == unit.first && last->last - last->first < kBlock && unit.weight < kTeamFrom &&
            last->weight < kTeamFrom)
            last->last = unit.last, last->weight += unit.weight;
        else
            s.units[kept++] = unit;
    }
    s.units.resize(kept);
}

/// Adds them to the units instead of stepping them.
void list_lone_robots(const StepCall& call, Impl& s) {
    s.lone.clear();
    const auto list = [&](Unit::Kind kind, std::size_t first) {
        if (s.lone.size() > first) s.units.push_back({kind, first, s.lone.size(), 0});
    };
    for_each_lone(
        call, s,
        [&](std::vector<std::uint32_t>& batch) {
            const std::size_t first = s.lone.size();
            s.lone.insert(s.lone.end(), batch.begin(), batch.end());
            list(Unit::Kind::kLanes, first);
            batch.clear();
        },
        [&](std::span<const std::uint32_t> some) {
            const std::size_t first = s.lone.size();
            s.lone.insert(s.lone.end(), some.begin(), some.end());
            list(Unit::Kind::kRough, first);
        },
        [&](std::uint32_t i) {
            s.lone.push_back(i);
            list(Unit::Kind::kAlone, s.lone.size() - 1);
        });
}

void step_unit(const StepCall& call, const Unit& unit, Helper& helper, Impl& s) {
    if (unit.kind == Unit::Kind::kGroup) return step_sets(call, unit, helper.works, helper.group, s);
    const std::span robots = std::span(s.lone).subspan(unit.first, unit.last - unit.first);
    if (unit.kind == Unit::Kind::kRough) return step_rough(call, robots, helper.works, helper.group, s);
    if (unit.kind == Unit::Kind::kAlone) {
        for (const std::uint32_t i : robots) step_group(call, {&i, 1}, helper.alone, helper.group, s);
        return;
    }
    helper.batch.assign(robots.begin(), robots.end());
    step_in_lanes(call, helper.batch, helper.kept, helper.alone, helper.group, s);
}

void prepare_helpers(Impl& s) {
    while (s.helpers.size() < s.group.team.size()) s.helpers.emplace_back(s.lanes_most);
    for (Helper& helper : s.helpers) {
        helper.report = {};
        helper.group.lanes = {helper.lanes.get(), nullptr};
        helper.group.profiles_solver = s.group.profiles_solver;
        // lanes tell what their solver did where the clock is on; the times are not wanted
        helper.clock = {};
        if (s.group.profiles_solver)
            helper.clock.start([] { return std::uint64_t{0}; }, helper.report.profile.stages);
    }
}

void add_report(const StepReport& from, StepReport& to) {
    to.contacts += from.contacts, to.static_contacts += from.static_contacts;
    to.asleep += from.asleep, to.placed += from.placed;
    to.add_solves(from);
    note_failure_of(from, to);
}

/// Puts first the units that all threads step together, which are more than a thread's share; the others as
/// they come, of the share of each thread the largest first. Returns how many are first.
std::size_t sort_units(std::size_t all, Impl& s) {
    const Team& team = s.group.team;
    const auto is_large = [&](const Unit& unit) {
        const bool one = unit.kind == Unit::Kind::kGroup || unit.last - unit.first == 1;
        return unit.kind != Unit::Kind::kLanes && unit.kind != Unit::Kind::kRough && one &&
               unit.weight >= kTeamFrom && unit.weight * team.size() > all;
    };
    const auto first_other = std::partition(s.units.begin(), s.units.end(), is_large);
    const std::span<Unit> others(first_other, s.units.end());
    team.sort_shares(
        others, [](const Unit& unit) { return unit.weight; },
        [](const Unit& unit) { return std::tuple(unit.kind, unit.first); });
    return s.units.size() - others.size();
}

/// Groups of more than a thread's share by all threads of the team, one after the other; then the others,
/// side by side. No bit depends on it.
void step_side_by_side(const StepCall& call, Impl& s) {
    list_lone_robots(call, s);
    const std::size_t all = weigh_units(call, s);
    join_lone_units(s);
    const std::size_t large = sort_units(all, s);
    for (const Unit& unit : std::span(s.units).first(large)) {
        if (unit.kind == Unit::Kind::kGroup)
            step_sets(call, unit, s.works, s.group, s);
        else
            step_group(call, {&s.lone[unit.first], 1}, s.alone, s.group, s);
    }
    call.clock.enter(Stage::kVelocities);  // of all that follows; it is most of it
    prepare_helpers(s);
    s.group.team.run(s.units.size() - large, [&](std::size_t k, std::size_t worker) {
        Helper& helper = s.helpers[worker];
        step_unit({call.model, call.tick, call.robots, call.states, call.bounds, call.ordered, helper.report,
                   helper.clock},
                  s.units[large + k], helper, s);
    });
    for (const Helper& helper : s.helpers) add_report(helper.report, call.report);
}

/// Batches of robots that may meet, and of those that meet nobody: step_robots (tick.h).
void step_batches(const StepCall& call, Impl& s) {
    s.units.clear();
    list_sets(call, s);
    if (s.group.team.size() > 1 && call.robots.size() - s.sets.sleepers().size() >= kTeamFrom &&
        !s.group.keep_reactions && call.model.precision == Precision::kDouble)
        return step_side_by_side(call, s);
    for (const Unit& unit : s.units) step_sets(call, unit, s.works, s.group, s);
    step_lone_robots(call, s);
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
    step_batches(call, s);
    sort_contact_reports(s.group.contact_reports);
    s.clock.stop();
    if (s.group.profiles_solver) report.profile.solver.residual = report.residual;
    return report;
}

void StepScratch::use_lanes(std::size_t most) {
    most = impl_->lanes_most = std::min(most, kMostLanes);
    impl_->helpers.clear();
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
