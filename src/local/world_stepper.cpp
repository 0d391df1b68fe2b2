// Single calls, and the way back when a state is not finite.
#include "local/world_stepper.h"

#include <algorithm>

namespace roboss {

namespace {

// A single thread copies the states so rarely that it costs nothing beside the steps.
constexpr Tick kBackupTicks = 64;

/// Those with a tick in [from, until), of orders sorted by ticks.
std::span<const Order> orders_within(std::span<const Order> orders, Tick from, Tick until) {
    const auto before = [](const Order& order, Tick tick) { return order.apply_at < tick; };
    const auto first = std::lower_bound(orders.begin(), orders.end(), from, before);
    const auto last = std::lower_bound(first, orders.end(), until, before);
    return {first, last};
}

}  // namespace

WorldStepper::WorldStepper(std::shared_ptr<const Model> model, unsigned threads, std::size_t lanes)
    : model_(std::move(model)), pool_(threads), scratch_(pool_.threads()), forecast_(model_) {
    for (StepScratch& scratch : scratch_) scratch.use_lanes(lanes);
    const std::size_t n = model_->robots.size();
    in_windows_ = pool_.threads() > 1 && n > 1;
    swept_.resize(n), bounds_.resize(n), efforts_.assign(n, 1.0F), batch_of_.resize(n);
}

void WorldStepper::forget() {
    backup_.tick = -1;
    motions_.clear();
}

void WorldStepper::back_up(Tick tick, const std::vector<RobotState>& states) {
    backup_.tick = tick;
    backup_.states = states;
    backup_.orders.clear();
}

StepOutcome WorldStepper::step(Tick from, Tick until, std::span<const Order> orders,
                               std::vector<RobotState>& states) {
    ROBOSS_CHECK(states.size() == model_->robots.size(), std::to_string(states.size()) + " states");
    StepOutcome outcome{.tick = from, .not_finite = {}, .not_finite_joint = {}};
    while (outcome.tick < until && !outcome.not_finite.valid()) {
        const Tick start = outcome.tick,
                   end = std::min(until, start + (in_windows_ ? window_ : kBackupTicks));
        const std::span<const Order> due = orders_within(orders, start, end);
        const bool fresh = in_windows_ || backup_.tick < 0 || end - backup_.tick > kBackupTicks;
        if (fresh) back_up(start, states);
        backup_.orders.insert(backup_.orders.end(), due.begin(), due.end());
        outcome = in_windows_ ? step_window(start, end, due, states) : step_all(start, end, due, states);
    }
    return outcome;
}

void WorldStepper::fill_all(std::vector<RobotState>& states) {
    all_.robots.clear();
    for (std::size_t r = 0; r < states.size(); ++r) all_.robots.emplace_back(r);
    finish(all_, states);
}

/// All robots in one call. If a state is not finite, the world goes back to the beginning of that tick.
StepOutcome WorldStepper::step_all(Tick from, Tick until, std::span<const Order> orders,
                                   std::vector<RobotState>& states) {
    fill_all(states);
    scratch_[0].use_team(Team(pool_));
    step_batch(all_, from, until, orders, scratch_[0]);
    scratch_[0].use_team({});
    const StepOutcome outcome = all_.outcome;
    if (!outcome.not_finite.valid()) return outcome;
    states = backup_.states;
    fill_all(states);
    step_batch(all_, backup_.tick, outcome.tick, backup_.orders, scratch_[0]);
    forget();  // orders of the failed tick are given again
    return outcome;
}

/// Bounds and efforts of the tick that was stepped last.
void WorldStepper::note_tick(const Batch& batch, StepScratch& scratch) {
    const std::span<const float> efforts = read_efforts(scratch);
    for (std::size_t i = 0; i < batch.robots.size(); ++i) {
        const std::size_t r = batch.robots[i].index();
        bounds_[r] = valid_or_everywhere(batch.bounds[i]);
        swept_[r].include(bounds_[r]);
        efforts_[r] += efforts[i];
    }
}

void WorldStepper::step_batch(Batch& batch, Tick from, Tick until, std::span<const Order> orders,
                              StepScratch& scratch) {
    if (in_windows_)
        for (const RobotId robot : batch.robots) swept_[robot.index()] = {}, efforts_[robot.index()] = 0;
    batch.outcome = {.tick = until, .not_finite = {}, .not_finite_joint = {}};
    for (Tick tick = from; tick < until; ++tick) {
        const StepReport report = step_island(*model_, tick, batch.robots, batch.states,
                                              orders_within(orders, tick, tick + 1), batch.bounds, scratch);
        if (in_windows_) note_tick(batch, scratch);
        if (!report.not_finite.valid()) continue;
        batch.outcome = {tick, report.not_finite, report.not_finite_joint, report.beyond_numbers};
        return;
    }
}

}  // namespace roboss
