// A window: plan, send; then results, validation, repetition of islands that touched, commit.
#include <algorithm>
#include <tuple>
#include <utility>

#include "roles/controller/controller.h"
#include "roles/controller/order_feed.h"
#include "roles/controller/work_stealing.h"

namespace roboss {

void Controller::at_boundary(Bus& bus) {
    if (phase_ == Phase::kWaiting) {
        if (roster_.workers().size() < options_.simulators || !clients_.all_joined()) return;
        enter(Phase::kIdle);
    }
    if (checkpoints_.fetched()) finish_checkpoint();
    if (failure()) {
        if (phase_ == Phase::kReleasing) enter(Phase::kIdle);
        if (phase_ != Phase::kFailed) enter(Phase::kFailed);
        if (checkpoints_.requested()) checkpoints_.begin(directory_, roster_);
        return;
    }
    if (directory_.anything_lost(roster_)) return begin_recovery();
    if (release_leaving_members(bus)) return;
    begin_log_checkpoint();
    if (checkpoints_.requested() || checkpoint_due()) checkpoints_.begin(directory_, roster_);
    if (may_start_window()) start_window();
}

bool Controller::may_start_window() const {
    return tick() < target_ && !roster_.workers().empty() && clients_.limit(tick()) > tick();
}

WindowLimits Controller::limits_of_window(Tick from, bool all_answered) const {
    return {std::min({target_, clients_.limit(from, all_answered), recorder_.next_checkpoint(from)}),
            views_.window_max()};
}

void Controller::start_window() {
    round_ = planner_.plan(epoch_, ++window_, limits_of_window(tick(), false), directory_);
    round_->measured = measures_;
    enter(Phase::kStepping);
    const std::span<const SeatId> holders = directory_.holders();
    for (std::size_t r = 0; r < holders.size(); ++r)
        if (holders[r] != kAtController && holders[r] != round_->seat_of(RobotId(r))) ++counters_.migrations;
    recorder_.planned(round_->span().until);
}

/// While Simulators step there is time to prepare the next window.
void Controller::send_assignments(Bus& bus) {
    round_->send(bus, roster_, options_.resend_ms, [this](Assignment& assignment) {
        if (assignment.ahead != 0) give_all(order_log_, assignment);
    });
    if (phase_ == Phase::kRecovering || planner_.looked_ahead(*round_)) return;
    counters_.orders_ahead += planner_.look_ahead(bus, *round_, limits_of_window(round_->span().until, true));
}

void Controller::take_result(SeatId seat_id, const WindowResult& result) {
    if (!round_) return;
    bool fits = true;
    const std::optional<Round::Answered> answered = round_->answered_by(seat_id, result, fits);
    if (!fits)
        notices_.dropped(
            "WindowResult", tick(),
            "what simulator " + std::to_string(seat_id) + " answered does not match its assignment");
    if (!answered) return;
    const Assignment& assignment = answered->assignment;
    add_costs(*answered, result);
    if (result.profile) profile_ += *result.profile;
    if (result.left > 0) {  // a Cut ended the assignment early; the rest of it is divided
        const Tick at = assignment.until - static_cast<Tick>(result.left);
        share_out_rest(*round_, *answered, result.islands, at, roster_, order_log_);
        ++counters_.cuts;
        return;
    }
    for (const RobotResult& f : result.robots) next_hashes_[f.robot.index()] = f.hash;
    round_->earlier.insert(round_->earlier.end(), result.earlier.begin(), result.earlier.end());
    if (phase_ == Phase::kStepping) planner_.take_result(*round_, assignment, result);
}

/// Adds costs and outcomes of islands; those of the rest of a window to those before the Cut.
void Controller::add_costs(const Round::Answered& answered, const WindowResult& result) {
    const Assignment& assignment = answered.assignment;
    std::uint64_t cost_ns = 0;
    for (std::size_t i = 0; i < result.islands.size(); ++i) {
        const IslandResult& part = result.islands[i];
        IslandResult& outcome = round_->outcome[assignment.robots[assignment.island_offsets[i]].index()];
        const IslandResult before = assignment.mid_window() != 0 ? outcome : IslandResult{};
        outcome = part;
        outcome.cost_ns += before.cost_ns;
        outcome.contacts += before.contacts;
        outcome.static_contacts += before.static_contacts;
        cost_ns += part.cost_ns;
    }
    round_->spend(answered.seat_id, cost_ns);
    counters_.step_cpu_s += 1e-9 * static_cast<double>(cost_ns);
}

void Controller::finish_round() {
    if (waits_for_log()) return recorder_.hurry();
    counters_.critical_cpu_s += 1e-9 * round_->busiest_ns();
    if (phase_ == Phase::kRecovering) return finish_leg();
    if (repeat_touched()) return;
    if (const IslandResult* failure = first_failure()) return end_before(*failure);
    commit();
}

bool Controller::repeat_touched() {
    if (!planner_.some_touched(*round_)) return false;
    if (roster_.workers().empty()) return discard_window(), true;  // all want to leave
    counters_.robots_repeated += planner_.repeat(*round_);
    return true;
}

/// Of all robots whose states became non-finite in the window, the one that every other grouping would
/// report, too.
const IslandResult* Controller::first_failure() const {
    const auto key = [](const IslandResult& f) {
        return std::tuple(f.failed_at, !f.beyond_numbers, f.failed);
    };
    const IslandResult* first = nullptr;
    for (std::size_t i = 0; i < round_->islands.count(); ++i) {
        const IslandResult& outcome = round_->outcome[round_->islands.of(i).front().index()];
        if (outcome.failed.valid() && (first == nullptr || key(outcome) < key(*first))) first = &outcome;
    }
    return first;
}

/// "joint 'wheel_0' of robot 'car_7'"
std::string Controller::part_of(RobotId robot, JointId joint) const {
    const RobotType& type = model_->type_of(robot);
    const std::string part =
        joint.index() < type.joints.size() ? "joint '" + type.joints[joint.index()].name + "'" : "the base";
    return part + " of robot '" + model_->robots[robot.index()].name + "'";
}

/// The ticks before the one in which a state becomes non-finite are committed first, in a window that ends
/// there. So the run ends with the same tick and state whatever windows it had.
void Controller::end_before(const IslandResult& failure) {
    const Tick tick = failure.failed_at;
    if (tick > round_->span().from) {
        planner_.end_at(tick);
        return discard_window();
    }
    Error error{
        "the state is not finite after tick " + std::to_string(tick) + " (" +
            std::to_string(static_cast<double>(tick) * model_->dt_s) +
            " s): " + part_of(failure.failed, failure.failed_joint) +
            (failure.beyond_numbers ? " moves faster than can be computed" : " is infinite or no number"),
        "look for extreme orders or masses, or take a shorter step; the world up to tick " +
            std::to_string(this->tick()) + " is intact and can be saved",
        failure.beyond_numbers ? "too-fast" : "not-finite"};
    discard_window();
    notices_.fail(std::move(error));
}

/// The window is stepped again from its start, if at all.
void Controller::discard_window() {
    planner_.discard();
    round_.reset();
    enter(Phase::kIdle);
}

void Controller::abandon_window() {
    target_ = tick();
    if (phase_ == Phase::kStepping) discard_window();
}

void Controller::commit() {
    const Round& round = *round_;
    costs_.learn(round, roster_);
    checkpoints_.committed(round.islands, 1e-9 * round.window_busiest_ns());
    planner_.committed(round);
    count_window();
    directory_.commit(round.span().until, round.last_seats(), roster_);
    hashes_ = next_hashes_;
    islands_ = std::move(round_->islands);
    round_.reset();
    enter(Phase::kIdle);
    recorder_.committed(tick(), model_->hash, hashes_);
    clients_.queue_observations();
}

void Controller::count_window() {
    const Round& round = *round_;
    const auto ticks = static_cast<std::uint64_t>(round.span().until - round.span().from);
    for (std::size_t i = 0; i < round.islands.count(); ++i) {
        const IslandResult& outcome = round.outcome[round.islands.of(i).front().index()];
        counters_.contacts += outcome.contacts;
        counters_.static_contacts += outcome.static_contacts;
    }
    ++counters_.windows;
    counters_.windows_repeated += round.repeats() > 0 ? 1 : 0;
    counters_.islands += round.islands.count();
    counters_.ticks += ticks;
    counters_.island_ticks += ticks * round.islands.count();
    counters_.islands_now = round.islands.count();
}

}  // namespace roboss
