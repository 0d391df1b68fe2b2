// The life of a window: forecast, assign, publish; then frames, validation, repeats where islands touched,
// commit.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "plan/assign.h"
#include "roles/controller.h"

namespace roboss {

namespace {

constexpr double kCostTicks = 64;  // in which a robot's running mean cost forgets half
constexpr double kNewRateShare = 0.03;
constexpr double kNewSpentShare = 0.1;
// What it costs a Simulator to have an island's states sent, and the ticks within which that has to be
// regained.
constexpr double kMove_ns = 100'000;
constexpr Tick kMovePays = 64;
constexpr double kTell_ns = 30'000;  // what it takes the Controller to send one plan

std::vector<double> speeds_of(const Roster& roster, std::span<const std::uint32_t> workers) {
    std::vector<double> speeds;
    for (const std::uint32_t place : workers) speeds.push_back(roster.seat(place).speed());
    return speeds;
}

/// assign() for seats: places in and out are seats, of which only `workers` may get islands.
std::vector<std::uint32_t> assign_to_seats(const Islands& islands, std::span<const float> cost,
                                           const Roster& roster, std::span<const std::uint32_t> holder,
                                           Tick ticks) {
    const std::vector<std::uint32_t> workers = roster.workers();
    std::vector<std::uint32_t> index_of(roster.size(), kNowhere), place(holder.size(), kNowhere);
    for (std::uint32_t i = 0; i < workers.size(); ++i) index_of[workers[i]] = i;
    for (std::size_t r = 0; r < holder.size(); ++r)
        if (holder[r] < roster.size()) place[r] = index_of[holder[r]];
    const std::vector<double> speeds = speeds_of(roster, workers);
    std::vector<std::uint32_t> result =
        assign({islands, cost, place, speeds, kMove_ns / static_cast<double>(std::max(ticks, kMovePays)),
                kTell_ns / static_cast<double>(ticks)});
    for (std::uint32_t& seat : result) seat = workers[seat];
    return result;
}

}  // namespace

void Controller::at_boundary(Bus& bus) {
    if (!started_) {
        started_ = roster_.workers().size() >= options_.simulators && desk_.all_joined();
        if (!started_) return;
    }
    if (pull_.complete()) finish_checkpoint();
    if (failure_) {
        if (states_wanted_) begin_checkpoint();
        return;
    }
    if (anything_lost()) return begin_recovery();
    if (let_leavers_go(bus)) return;
    begin_log_checkpoint();
    if (states_wanted_ || checkpoint_due()) begin_checkpoint();
    if (may_plan()) plan_window();
}

bool Controller::may_plan() const {
    return tick_ < target_ && !roster_.workers().empty() && desk_.limit(tick_) > tick_;
}

Tick Controller::window_end(Tick from, Tick length, bool all_answered) const {
    length = std::min(length, views_.window_max().value_or(length));
    if (options_.window_max > 0) length = std::min(length, options_.window_max);
    if (ends_at_ && *ends_at_ > from) length = std::min(length, *ends_at_ - from);
    return std::min({from + length, target_, desk_.limit(from, all_answered), next_log_tick(from)});
}

Tick Controller::window_max() const {
    return options_.window_max > 0 ? options_.window_max
                                   : longest_window(model_->robots.size(), roster_.threads());
}

void Controller::plan_window() {
    const Tick until = window_end(tick_, length_.ticks());
    round_.emplace(RoundSpan{epoch_, ++window_, tick_, until, false}, model_->robots.size());
    forecast_.islands(motions_, feed_.leaps(book_, tick_, until), until - tick_, options_.forecast,
                      round_->islands);
    const std::vector<std::uint32_t> place =
        assign_to_seats(round_->islands, cost_, roster_, holder_, until - tick_);
    round_->plan(round_->islands, place, holder_, roster_);
    feed_.give_rest(book_, *round_);
    round_->send_dearest_first(cost_);
    expect_work();
    for (std::size_t r = 0; r < holder_.size(); ++r)
        if (holder_[r] != kAtController && holder_[r] != round_->seat_of(RobotId(r))) ++counters_.migrations;
    keep_wanted(*round_);
    log_window(until);
}

void Controller::keep_wanted(Round& round) const {
    if (!wants_.empty() && wants_.back().tick == round.span().from) {
        std::vector<std::vector<RobotId>> robots(roster_.size());
        for (std::size_t r = 0; r < holder_.size(); ++r)
            if (holder_[r] < roster_.size()) robots[holder_[r]].emplace_back(r);
        for (std::uint32_t place = 0; place < robots.size(); ++place)
            if (!robots[place].empty()) round.keep(place, std::move(robots[place]));
    }
    round.release_before(wants_.empty() ? round.span().from : wants_.front().tick);
}

/// While they are worked on there is time to tell the orders of the next window.
void Controller::send_plans(Bus& bus) {
    round_->send(bus, roster_, options_.resend_ms, [this](Plan& plan) {
        if (plan.ahead != 0) give_all(book_, plan);
    });
    const RoundSpan& span = round_->span();
    if (span.recovery || feed_.sent_in(span.window)) return;
    look_ahead();
    counters_.orders_ahead +=
        feed_.send_ahead(bus, book_, *round_, roster_, span.until + length_.ticks(), options_.ahead_least);
}

/// Where frames come from now on, they are compared with each other, and the window after theirs is forecast,
/// for the length that it will have if nothing is to be repeated and Clients have answered.
void Controller::look_ahead() {
    const RoundSpan& span = round_->span();
    WindowLength next = length_;
    next.committed(span.until - span.from, false, largest_share(), window_max());
    watch_.begin(round_->islands);
    const Tick until = window_end(span.until, next.ticks(), true);
    forecast_.expect(model_->robots.size(), std::max<Tick>(until - span.until, 0), options_.forecast);
}

/// Of the world, as a share of what one worker should have.
double Controller::largest_share() const {
    return static_cast<double>(round_->islands.largest()) * roster_.threads() /
           static_cast<double>(std::max<std::size_t>(model_->robots.size(), 1));
}

void Controller::take_frame(std::uint32_t place, const Frame& frame) {
    if (!round_) return;
    bool fits = true;
    const std::optional<Round::Answered> answered = round_->answered_by(place, frame, fits);
    if (!fits)
        note_dropped("Frame", "what simulator " + std::to_string(place) + " answers does not fit its plan");
    if (!answered) return;
    const Plan& plan = answered->plan;
    take_costs(*answered, frame);
    if (frame.left > 0)
        return share_out_rest(*answered, frame.islands, plan.until - static_cast<Tick>(frame.left));
    const bool plan_is_recovery = round_->span().recovery,
               first = !plan_is_recovery && round_->repeats() == 0;
    for (const RobotFrame& f : frame.robots) {
        next_hashes_[f.robot.index()] = f.hash;
        if (plan_is_recovery) continue;
        const auto span_s =
            static_cast<float>(static_cast<double>(plan.until - round_->since(f.robot)) * model_->dt_s);
        RobotMotion& motion = motions_[f.robot.index()];
        motion = {f.swept, unpack_place(f.place, f.swept), unpack_velocity(f.velocity), span_s};
        if (!first) continue;
        watch_.add({f.swept, f.robot.value}, true);
        forecast_.add(f.robot, motion);
    }
    if (first)
        for (const EarlierBox& e : frame.earlier) watch_.add({e.swept, e.robot.value}, false);
    round_->earlier.insert(round_->earlier.end(), frame.earlier.begin(), frame.earlier.end());
}

/// What islands cost, and how they fared; where a part of the window was stepped, besides what the parts
/// before it say.
void Controller::take_costs(const Round::Answered& answered, const Frame& frame) {
    const Plan& plan = answered.plan;
    std::uint64_t cost_ns = 0;
    for (std::size_t i = 0; i < frame.islands.size(); ++i) {
        const IslandFrame& part = frame.islands[i];
        IslandFrame& outcome = round_->outcome[plan.robots[plan.island_offsets[i]].index()];
        const IslandFrame before = plan.midst() != 0 ? outcome : IslandFrame{};
        outcome = part;
        outcome.cost_ns += before.cost_ns;
        outcome.contacts += before.contacts;
        outcome.static_contacts += before.static_contacts;
        cost_ns += part.cost_ns;
    }
    round_->spend(answered.place, cost_ns);
    counters_.step_cpu_s += 1e-9 * static_cast<double>(cost_ns);
}

void Controller::finish_round() {
    if (waits_for_log()) return options_.log->hurry();
    counters_.critical_cpu_s += 1e-9 * round_->busiest_ns();
    if (round_->span().recovery) return finish_leg();
    if (merge_touching()) return;
    if (const IslandFrame* failure = first_failure()) return end_before(*failure);
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
    const std::vector<std::uint32_t> place =
        assign_to_seats(again, cost_, roster_, round_->seats(), round_->span().until - round_->span().from);
    round_->plan(again, place, round_->seats(), roster_);
    give_all(book_, *round_);
    return true;
}

/// Of all robots whose states ceased to be finite in the window, the one that every other grouping would
/// tell, too.
const IslandFrame* Controller::first_failure() const {
    const auto key = [](const IslandFrame& f) {
        return std::tuple(f.failed_at, !f.beyond_numbers, f.failed);
    };
    const IslandFrame* first = nullptr;
    for (std::size_t i = 0; i < round_->islands.count(); ++i) {
        const IslandFrame& outcome = round_->outcome[round_->islands.of(i).front().index()];
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

/// What comes before the tick in which a state ceases to be finite is committed first, in a window that ends
/// there. So the run ends with the same tick and state whatever windows it had.
void Controller::end_before(const IslandFrame& failure) {
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
            std::to_string(tick_) + " is intact and can be saved"};
    drop_round();
    fail(std::move(error));
}

/// Nothing of it is committed; the window is stepped again from its start, if at all.
void Controller::drop_round() {
    watch_.stop();
    forecast_.forget();
    round_.reset();
}

void Controller::commit() {
    const Round& round = *round_;
    const Tick ticks = round.span().until - round.span().from;
    learn_costs();
    for (std::size_t i = 0; i < round.islands.count(); ++i) {
        const auto robots = round.islands.of(i);
        for (const RobotId robot : robots) {
            base_.touched.unite(robots.front().value, robot.value);
            if (next_base_) next_base_->touched.unite(robots.front().value, robot.value);
        }
        counters_.contacts += round.outcome[robots.front().index()].contacts;
        counters_.static_contacts += round.outcome[robots.front().index()].static_contacts;
    }
    length_.committed(ticks, round.repeats() > 0, largest_share(), window_max());
    ++counters_.windows;
    counters_.windows_repeated += round.repeats() > 0 ? 1 : 0;
    counters_.islands += round.islands.count();
    counters_.ticks += static_cast<std::uint64_t>(ticks);
    counters_.island_ticks += static_cast<std::uint64_t>(ticks) * round.islands.count();
    counters_.islands_now = round.islands.count();

    holder_.assign(round.last_seats().begin(), round.last_seats().end());
    hashes_ = next_hashes_;
    tick_ = round.span().until;
    islands_ = std::move(round_->islands);
    round_.reset();
    log_commit();
    tell_observers();
}

/// A robot's cost is in ns a tick on the mean Simulator; a Simulator's rate is how much faster than the mean
/// it is: it grows where its islands, taken together, cost less than what their robots lately did, wherever
/// that was.
void Controller::learn_costs() {
    const Round& round = *round_;
    const auto ticks = static_cast<double>(round.span().until - round.span().from);
    const auto share = static_cast<float>(costs_known_ ? 1 - std::exp2(-ticks / kCostTicks) : 1.0);
    std::vector<double> expected_ns(roster_.size(), 0.0), spent_ns(roster_.size(), 0.0);
    for (std::size_t i = 0; i < round.islands.count(); ++i) {
        const auto robots = round.islands.of(i);
        const std::uint32_t place = round.seat_of(robots.front()),
                            last = round.last_seats()[robots.front().index()];
        const auto cost_ns = static_cast<double>(round.outcome[robots.front().index()].cost_ns);
        double expected = 0;
        for (const RobotId robot : robots) expected += static_cast<double>(cost_[robot.index()]);
        const double rate = 0.5 * (roster_.seat(place).rate + roster_.seat(last).rate);
        if (round.since(robots.front()) ==
            round.span().from) {  // what two have stepped says nothing of either
            expected_ns[place] += ticks * expected / rate;
            spent_ns[place] += cost_ns;
        }
        const double each = rate * cost_ns / (ticks * static_cast<double>(robots.size()));
        for (const RobotId robot : robots) {
            float& cost = cost_[robot.index()];
            cost += share * (static_cast<float>(std::max(each, 1e-3)) - cost);
        }
    }
    if (std::exchange(costs_known_, true)) learn_rates(expected_ns, spent_ns);
    double busiest_ns = 0;
    for (std::uint32_t place = 0; place < roster_.size(); ++place) {
        SimulatorSeat& seat = roster_.seat(place);
        const double spent = round.spent_ns(place);
        seat.spent_ns += kNewSpentShare * (spent / (ticks * seat.threads) - seat.spent_ns);
        busiest_ns = std::max(busiest_ns, spent);
    }
    work_since_s_ += 1e-9 * busiest_ns;
}

/// Only what sets Simulators apart is learnt of them; what became dearer everywhere is the robots' own.
void Controller::learn_rates(std::span<const double> expected_ns, std::span<const double> spent_ns) {
    double expected = 0, spent = 0;
    for (std::size_t place = 0; place < spent_ns.size(); ++place)
        if (spent_ns[place] > 0) expected += expected_ns[place], spent += spent_ns[place];
    if (expected <= 0 || spent <= 0) return;
    for (std::uint32_t place = 0; place < roster_.size(); ++place) {
        if (spent_ns[place] <= 0 || expected_ns[place] <= 0) continue;
        const double faster = expected_ns[place] / spent_ns[place] * spent / expected;
        double& rate = roster_.seat(place).rate;
        rate = std::clamp(rate * (1 + kNewRateShare * (std::clamp(faster, 0.5, 2.0) - 1)), 0.01, 100.0);
    }
    double sum = 0;
    const std::vector<std::uint32_t> workers = roster_.workers();
    for (const std::uint32_t place : workers) sum += roster_.seat(place).rate;
    for (const std::uint32_t place : workers)
        roster_.seat(place).rate *= static_cast<double>(workers.size()) / sum;
}

}  // namespace roboss
