// A window: forecast, assign, send; then results, validation, repetition of islands that touched, commit.
#include <algorithm>
#include <tuple>
#include <utility>

#include "roles/controller.h"
#include "roles/work_stealing.h"

namespace roboss {

void Controller::at_boundary(Bus& bus) {
    if (!started_) {
        started_ = roster_.workers().size() >= options_.simulators && clients_.all_joined();
        if (!started_) return;
    }
    if (checkpoints_.fetched()) finish_checkpoint();
    if (failure()) {
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

Tick Controller::window_end(Tick from, Tick length, bool all_answered) const {
    length = std::min(length, views_.window_max().value_or(length));
    if (options_.window_max > 0) length = std::min(length, options_.window_max);
    if (ends_at_ && *ends_at_ > from) length = std::min(length, *ends_at_ - from);
    return std::min(
        {from + length, target_, clients_.limit(from, all_answered), recorder_.next_checkpoint(from)});
}

Tick Controller::window_max() const {
    return options_.window_max > 0 ? options_.window_max
                                   : longest_window(model_->robots.size(), roster_.threads());
}

void Controller::start_window() {
    const std::span<const SeatId> holders = directory_.holders();
    const Tick until = window_end(tick(), length_.ticks());
    round_.emplace(RoundSpan{epoch_, ++window_, tick(), until, false}, model_->robots.size());
    forecast_.islands(motions_, feed_.leaps(order_log_, tick(), until), until - tick(), options_.forecast,
                      round_->islands);
    const std::vector<SeatId> seat_of_island =
        costs_.assign_islands(round_->islands, roster_, holders, until - tick());
    round_->assign(round_->islands, seat_of_island, holders, roster_);
    feed_.give_rest(order_log_, *round_);
    round_->send_dearest_first(costs_.costs());
    announce_expected_work(*round_, costs_, roster_, options_.stealing_least_ns);
    for (std::size_t r = 0; r < holders.size(); ++r)
        if (holders[r] != kAtController && holders[r] != round_->seat_of(RobotId(r))) ++counters_.migrations;
    keep_wanted(*round_);
    recorder_.planned(until);
}

void Controller::keep_wanted(Round& round) const {
    if (directory_.wants_this_tick()) {
        const std::span<const SeatId> holders = directory_.holders();
        std::vector<std::vector<RobotId>> robots(roster_.size());
        for (std::size_t r = 0; r < holders.size(); ++r)
            if (holders[r] < roster_.size()) robots[holders[r]].emplace_back(r);
        for (SeatId seat_id = 0; seat_id < robots.size(); ++seat_id)
            if (!robots[seat_id].empty()) round.keep(seat_id, std::move(robots[seat_id]));
    }
    round.release_before(directory_.oldest_wanted(round.span().from));
}

/// While Simulators step there is time to send the orders of the next window.
void Controller::send_assignments(Bus& bus) {
    round_->send(bus, roster_, options_.resend_ms, [this](Assignment& assignment) {
        if (assignment.ahead != 0) give_all(order_log_, assignment);
    });
    const RoundSpan& span = round_->span();
    if (span.recovery || feed_.sent_in(span.window)) return;
    look_ahead();
    counters_.orders_ahead += feed_.send_ahead(bus, order_log_, *round_, roster_,
                                               span.until + length_.ticks(), options_.ahead_least);
}

/// Prepares for the results to come: each is compared with the others as it arrives, and the next window is
/// forecast, with the length that it will have if nothing is repeated and Clients have replied.
void Controller::look_ahead() {
    const RoundSpan& span = round_->span();
    WindowLength next = length_;
    next.committed(span.until - span.from, false, largest_share(), window_max());
    watch_.begin(round_->islands);
    const Tick until = window_end(span.until, next.ticks(), true);
    forecast_.expect(model_->robots.size(), std::max<Tick>(until - span.until, 0), options_.forecast);
}

/// Robots of the largest island relative to an even share of one worker.
double Controller::largest_share() const {
    return static_cast<double>(round_->islands.largest()) * roster_.threads() /
           static_cast<double>(std::max<std::size_t>(model_->robots.size(), 1));
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
    take_costs(*answered, result);
    if (result.left > 0) return take_cut(*answered, result);
    const bool is_recovery = round_->span().recovery, first = !is_recovery && round_->repeats() == 0;
    for (const RobotResult& f : result.robots) {
        next_hashes_[f.robot.index()] = f.hash;
        if (is_recovery) continue;
        const auto span_s =
            static_cast<float>(static_cast<double>(assignment.until - round_->since(f.robot)) * model_->dt_s);
        RobotMotion& motion = motions_[f.robot.index()];
        motion = {f.swept, unpack_position(f.position, f.swept), unpack_velocity(f.velocity), span_s};
        if (!first) continue;
        watch_.add({f.swept, f.robot.value}, true);
        forecast_.add(f.robot, motion);
    }
    if (first)
        for (const EarlierBox& e : result.earlier) watch_.add({e.swept, e.robot.value}, false);
    round_->earlier.insert(round_->earlier.end(), result.earlier.begin(), result.earlier.end());
}

/// A Cut ended the assignment early; the rest of it is divided.
void Controller::take_cut(const Round::Answered& answered, const WindowResult& result) {
    const Tick at = answered.assignment.until - static_cast<Tick>(result.left);
    share_out_rest(*round_, answered, result.islands, at, roster_, order_log_);
    ++counters_.cuts;
}

/// Adds costs and outcomes of islands; those of the rest of a window to those before the Cut.
void Controller::take_costs(const Round::Answered& answered, const WindowResult& result) {
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
    if (round_->span().recovery) return finish_leg();
    if (merge_touching()) return;
    if (const IslandResult* failure = first_failure()) return end_before(*failure);
    commit();
}

bool Controller::merge_touching() {
    if (watch_.all_apart()) return false;
    watch_.stop();
    const std::size_t n = model_->robots.size();
    const Islands& before = round_->islands;
    std::vector<std::size_t> size_before(n, 0);  // by root
    sets_.reset(n);
    for (std::size_t i = 0; i < before.count(); ++i) {
        const auto robots = before.of(i);
        size_before[robots.front().index()] = robots.size();
        for (const RobotId robot : robots) sets_.unite(robots.front().value, robot.value);
    }
    boxes_.clear();
    for (std::uint32_t r = 0; r < n; ++r) boxes_.push_back({motions_[r].swept, r});
    for (const EarlierBox& e : round_->earlier) boxes_.push_back({e.swept, e.robot.value});
    if (sweep_.unite_overlapping(boxes_, sets_) == 0) return false;

    if (roster_.workers().empty()) return drop_round(), true;  // all want to leave
    forecast_.forget();
    Islands all, again;
    collect_islands(sets_, all);
    std::vector<bool> stepped_again(n, false);
    for (std::size_t i = 0; i < all.count(); ++i) {
        const auto robots = all.of(i);
        if (robots.size() == size_before[robots.front().index()]) continue;
        again.robots.insert(again.robots.end(), robots.begin(), robots.end());
        again.offsets.push_back(static_cast<std::uint32_t>(again.robots.size()));
        for (const RobotId robot : robots) stepped_again[robot.index()] = true;
    }
    std::erase_if(round_->earlier, [&](const EarlierBox& e) { return stepped_again[e.robot.index()]; });
    round_->islands = std::move(all);
    counters_.robots_repeated += again.robots.size();
    const std::vector<SeatId> seat_of_island =
        costs_.assign_islands(again, roster_, round_->seats(), round_->span().until - round_->span().from);
    round_->assign(again, seat_of_island, round_->seats(), roster_);
    give_all(order_log_, *round_);
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
        ends_at_ = tick;
        return drop_round();
    }
    Error error{
        "the state is not finite after tick " + std::to_string(tick) + " (" +
            std::to_string(static_cast<double>(tick) * model_->dt_s) +
            " s): " + part_of(failure.failed, failure.failed_joint) +
            (failure.beyond_numbers ? " moves faster than can be computed" : " is infinite or no number"),
        "look for extreme orders or masses, or take a shorter step; the world up to tick " +
            std::to_string(this->tick()) + " is intact and can be saved",
        failure.beyond_numbers ? "too-fast" : "not-finite"};
    drop_round();
    notices_.fail(std::move(error));
}

/// Discards the window; it is stepped again from its start, if at all.
void Controller::drop_round() {
    watch_.stop();
    forecast_.forget();
    round_.reset();
}

void Controller::commit() {
    const Round& round = *round_;
    const Tick ticks = round.span().until - round.span().from;
    costs_.learn(round, roster_);
    checkpoints_.committed(round.islands, 1e-9 * round.window_busiest_ns());
    for (std::size_t i = 0; i < round.islands.count(); ++i) {
        const IslandResult& outcome = round.outcome[round.islands.of(i).front().index()];
        counters_.contacts += outcome.contacts;
        counters_.static_contacts += outcome.static_contacts;
    }
    length_.committed(ticks, round.repeats() > 0, largest_share(), window_max());
    ++counters_.windows;
    counters_.windows_repeated += round.repeats() > 0 ? 1 : 0;
    counters_.islands += round.islands.count();
    counters_.ticks += static_cast<std::uint64_t>(ticks);
    counters_.island_ticks += static_cast<std::uint64_t>(ticks) * round.islands.count();
    counters_.islands_now = round.islands.count();

    directory_.commit(round.span().until, round.last_seats(), roster_);
    hashes_ = next_hashes_;
    islands_ = std::move(round_->islands);
    round_.reset();
    recorder_.committed(tick(), model_->hash, hashes_);
    queue_observations();
}

}  // namespace roboss
