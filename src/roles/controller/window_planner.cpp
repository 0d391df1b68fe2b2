// A window: forecast, assign; then compare the results, and repeat islands that touched.
#include "roles/controller/window_planner.h"

#include <algorithm>

#include "core/check.h"
#include "core/float_env.h"
#include "physics/step.h"
#include "roles/controller/work_stealing.h"

namespace roboss {

WindowPlanner::WindowPlanner(std::shared_ptr<const Model> model, const PlannerOptions& options,
                             std::span<const RobotState> states, const Roster& roster, const CostModel& costs,
                             OrderLog& order_log)
    : model_(std::move(model)),
      options_(options),
      roster_(roster),
      costs_(costs),
      order_log_(order_log),
      forecast_(model_),
      length_(options.window) {
    const ExactFloatScope exact;
    for (std::size_t i = 0; i < states.size(); ++i)
        motions_.push_back(motion_of(*model_, RobotId(i), states[i]));
}

Tick WindowPlanner::end_of(Tick from, Tick length, const WindowLimits& limits) const {
    length = std::min(length, limits.ticks_max.value_or(length));
    if (options_.window_max > 0) length = std::min(length, options_.window_max);
    if (ends_at_ && *ends_at_ > from) length = std::min(length, *ends_at_ - from);
    return std::min(from + length, limits.stop_at);
}

Tick WindowPlanner::longest() const {
    return options_.window_max > 0 ? options_.window_max : longest_window(motions_.size(), roster_.threads());
}

/// Robots of the largest island relative to an even share of those that step it: one thread, or, if it is
/// large, all threads of the smallest Simulator (Team). Then shorter windows, which may separate it, gain
/// nothing, and cost messages and repeats.
double WindowPlanner::largest_share(const Round& round) const {
    const std::size_t largest = round.islands.largest();
    const std::uint32_t team = largest >= kTeamFrom ? roster_.fewest_threads() : 1;
    return static_cast<double>(largest) * roster_.threads() /
           static_cast<double>(team * std::max<std::size_t>(motions_.size(), 1));
}

Round WindowPlanner::plan(std::uint32_t epoch, std::uint64_t window, const WindowLimits& limits,
                          const StateDirectory& directory) {
    const Tick from = directory.tick(), until = end_of(from, length_.ticks(), limits);
    ROBOSS_CHECK(until > from, "a window from tick " + std::to_string(from) + " to " + std::to_string(until));
    Round round({epoch, window, from, until, false}, motions_.size());
    forecast_.islands(motions_, feed_.leaps(order_log_, from, until), until - from, options_.forecast,
                      round.islands);
    const std::vector<SeatId> seat_of_island =
        costs_.assign_islands(round.islands, roster_, directory.holders(), until - from);
    round.assign(round.islands, seat_of_island, directory.holders(), roster_);
    feed_.give_rest(order_log_, round);
    round.send_dearest_first(costs_.costs());
    announce_expected_work(round, costs_, roster_, options_.stealing_least_ns);
    keep_wanted(round, directory);
    return round;
}

/// Simulators keep the states at the window's start that somebody still needs, and drop those of ticks that
/// nobody needs any more.
void WindowPlanner::keep_wanted(Round& round, const StateDirectory& directory) const {
    if (directory.wants_this_tick()) {
        const std::span<const SeatId> holders = directory.holders();
        std::vector<std::vector<RobotId>> robots(roster_.size());
        for (std::size_t r = 0; r < holders.size(); ++r)
            if (holders[r] < roster_.size()) robots[holders[r]].emplace_back(r);
        for (SeatId seat_id = 0; seat_id < robots.size(); ++seat_id)
            if (!robots[seat_id].empty()) round.keep(seat_id, std::move(robots[seat_id]));
    }
    round.release_before(directory.oldest_wanted(round.span().from));
}

/// Each result is compared with the others as it arrives, and the next window is forecast, with the length
/// that it will have if nothing is repeated and Clients have replied.
std::size_t WindowPlanner::look_ahead(Bus& bus, const Round& round, const WindowLimits& limits) {
    const RoundSpan& span = round.span();
    WindowLength next = length_;
    next.committed(span.until - span.from, false, largest_share(round), longest());
    watch_.begin(round.islands);
    const Tick until = end_of(span.until, next.ticks(), limits);
    forecast_.expect(motions_.size(), std::max<Tick>(until - span.until, 0), options_.forecast);
    return feed_.send_ahead(bus, order_log_, round, roster_, span.until + length_.ticks(),
                            options_.ahead_least);
}

void WindowPlanner::take_result(const Round& round, const Assignment& assignment,
                                const WindowResult& result) {
    const bool first = round.repeats() == 0;
    for (const RobotResult& f : result.robots) {
        const auto span_s =
            static_cast<float>(static_cast<double>(assignment.until - round.since(f.robot)) * model_->dt_s);
        RobotMotion& motion = motions_[f.robot.index()];
        motion = {f.swept, unpack_position(f.position, f.swept), unpack_velocity(f.velocity), span_s};
        if (!first) continue;
        watch_.add({f.swept, f.robot.value}, true);
        forecast_.add(f.robot, motion);
    }
    if (first)
        for (const EarlierBox& e : result.earlier) watch_.add({e.swept, e.robot.value}, false);
}

bool WindowPlanner::some_touched(const Round& round) {
    if (watch_.all_apart()) return false;
    watch_.stop();
    const auto n = static_cast<std::uint32_t>(motions_.size());
    sets_.reset(n);
    for (std::size_t i = 0; i < round.islands.count(); ++i)
        for (const RobotId robot : round.islands.of(i))
            sets_.unite(round.islands.of(i).front().value, robot.value);
    boxes_.clear();
    for (std::uint32_t r = 0; r < n; ++r) boxes_.push_back({motions_[r].swept, r});
    for (const EarlierBox& e : round.earlier) boxes_.push_back({e.swept, e.robot.value});
    return sweep_.unite_overlapping(boxes_, sets_) > 0;
}

std::size_t WindowPlanner::repeat(Round& round) {
    forecast_.forget();
    std::vector<std::size_t> size_before(motions_.size(), 0);  // by root
    for (std::size_t i = 0; i < round.islands.count(); ++i)
        size_before[round.islands.of(i).front().index()] = round.islands.size_of(i);
    Islands all, again;
    collect_islands(sets_, all);
    std::vector<bool> stepped_again(motions_.size(), false);
    for (std::size_t i = 0; i < all.count(); ++i) {
        const auto robots = all.of(i);
        if (robots.size() == size_before[robots.front().index()]) continue;
        again.robots.insert(again.robots.end(), robots.begin(), robots.end());
        again.offsets.push_back(static_cast<std::uint32_t>(again.robots.size()));
        for (const RobotId robot : robots) stepped_again[robot.index()] = true;
    }
    ROBOSS_CHECK(!again.robots.empty(), "a window is repeated though no robots touched");
    std::erase_if(round.earlier, [&](const EarlierBox& e) { return stepped_again[e.robot.index()]; });
    round.islands = std::move(all);
    const std::vector<SeatId> seat_of_island =
        costs_.assign_islands(again, roster_, round.seats(), round.span().until - round.span().from);
    round.assign(again, seat_of_island, round.seats(), roster_);
    give_all(order_log_, round);
    return again.robots.size();
}

void WindowPlanner::committed(const Round& round) {
    length_.committed(round.span().until - round.span().from, round.repeats() > 0, largest_share(round),
                      longest());
}

void WindowPlanner::discard() {
    watch_.stop();
    forecast_.forget();
}

}  // namespace roboss
