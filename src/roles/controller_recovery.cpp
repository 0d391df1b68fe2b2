// Checkpoints, leaving, and losses. A lost robot's state is recomputed: the robot and all that it may have
// touched since the last checkpoint are stepped from there with the logged orders, and must reach the
// committed hashes.
#include <algorithm>

#include "roles/controller.h"

namespace roboss {

namespace {

std::vector<Holding> holdings_of(std::span<const SeatId> holder, const Roster& roster) {
    std::vector<Holding> holdings;
    std::vector<SeatId> seats;
    for (std::size_t r = 0; r < holder.size(); ++r) {
        auto seat_id = std::find(seats.begin(), seats.end(), holder[r]);
        if (seat_id == seats.end()) {
            seat_id = seats.insert(seats.end(), holder[r]);
            holdings.push_back({roster.address_of(holder[r]), {}});
        }
        holdings[static_cast<std::size_t>(seat_id - seats.begin())].robots.emplace_back(r);
    }
    return holdings;
}

}  // namespace

bool Controller::checkpoint_due() const {
    if (next_base_ || base_.tick == tick()) return false;
    const bool by_ticks = options_.checkpoint_ticks > 0 && tick() - base_.tick >= options_.checkpoint_ticks;
    return by_ticks || (options_.checkpoint_work_s > 0 && work_since_s_ >= options_.checkpoint_work_s);
}

/// Only notes which states are needed, since assignments wait for it; advance_checkpoint() fetches them.
void Controller::begin_checkpoint() {
    if (next_base_) return;
    states_wanted_ = false;
    if (base_.tick == tick() || directory_.anything_lost(roster_)) return;
    next_base_.emplace();
    next_base_->tick = tick();
    directory_.want_checkpoint();
    work_since_s_ = 0;
}

/// A checkpoint for the log, if one is due at this tick.
void Controller::begin_log_checkpoint() {
    if (!recorder_.take_checkpoint_due(tick())) return;
    begin_checkpoint();
    const bool here = base_.tick == tick();
    if (!here && !(next_base_ && next_base_->tick == tick())) return;
    recorder_.checkpoint_begun(tick());
    if (here) recorder_.checkpoint_complete(tick(), base_.states);
}

/// Fetches states while Simulators step, so that nobody waits for it. A recovery keeps the checkpoint that it
/// began with.
void Controller::advance_checkpoint(Bus& bus) {
    if (next_base_ &&
        !next_base_->states) {  // begun in this call: directory_.holders() is still that of its tick
        next_base_->states = std::make_shared<std::vector<RobotState>>(model_->robots.size());
        next_base_->touched.reset(model_->robots.size());
        pull_.begin(*model_, next_base_->tick, holdings_of(directory_.holders(), roster_));
    }
    pull_.advance(bus, kControllerAddress, options_.resend_ms);
    if (pull_.complete() && round_ && !round_->span().recovery) finish_checkpoint();
}

void Controller::finish_checkpoint() {
    directory_.forget_checkpoint();
    // A needed earlier tick could not be recomputed from the new checkpoint.
    if (directory_.oldest_wanted(next_base_->tick) < next_base_->tick) return;
    base_ = std::move(*next_base_);
    next_base_.reset();
    pull_.cancel();
    order_log_.trim(base_.tick);
    ++counters_.checkpoints;
    recorder_.checkpoint_complete(base_.tick, base_.states);
}

/// No window starts while a member leaves, so the checkpoint taken for it has all states that it held.
bool Controller::release_leaving_members(Bus& bus) {
    bool leaving = false;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id)
        leaving = leaving || (roster_.alive(seat_id) && roster_.seat(seat_id).leaving);
    if (!leaving) return false;
    if (base_.tick != tick()) {
        begin_checkpoint();
        return true;
    }
    if (directory_.oldest_wanted(tick()) < tick()) return true;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id) {
        SimulatorSeat& seat = roster_.seat(seat_id);
        if (!seat.alive || !seat.leaving) continue;
        directory_.take_over(seat_id);
        seat.alive = false;
        bus.send(kControllerAddress, seat.address, Goodbye{roster_.id_of(seat_id)});
        notices_.add("simulator " + std::to_string(seat_id) + " left at tick " + std::to_string(tick()));
    }
    counters_.simulators = roster_.alive_count();
    observations_due_ = true;
    return false;
}

void Controller::notice_losses(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    for (const Address& address : bus.take_vanished(kControllerAddress)) take_vanished(address, now);
    if (options_.loss_ms <= 0) return;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id) {
        const SimulatorSeat& seat = roster_.seat(seat_id);
        if (!seat.alive || now - seat.heard_ms <= options_.loss_ms) continue;
        ++counters_.silences;
        give_up(seat_id, "was silent for " + std::to_string(now - seat.heard_ms) + " ms");
    }
}

void Controller::take_vanished(const Address& address, std::int64_t now_ms) {
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id)
        if (roster_.alive(seat_id) && roster_.seat(seat_id).address == address) give_up(seat_id, "vanished");
    for (ClientSeat& seat : clients_.seats())
        if (seat.serves() && seat.address == address && !seat.vanished_ms) seat.vanished_ms = now_ms;
}

void Controller::give_up(SeatId seat_id, const std::string& why) {
    SimulatorSeat& seat = roster_.seat(seat_id);
    seat.alive = false;
    seat.leaving = false;
    ++epoch_;
    ++counters_.losses;
    counters_.simulators = roster_.alive_count();
    round_.reset();
    if (next_base_ && !pull_.complete()) {
        pull_.cancel();
        recorder_.checkpoint_lost(next_base_->tick);
        next_base_.reset();
        directory_.forget_checkpoint();
    }
    notices_.add("simulator " + std::to_string(seat_id) + " " + why + " and is given up at tick " +
                 std::to_string(tick()));
}

/// Robots to recompute: those lost, now or at a tick that is still needed, and all that they may have touched
/// since the checkpoint. Ascending.
std::vector<RobotId> Controller::closure_of_lost() {
    const std::vector<bool> lost = directory_.lost(roster_);
    const auto n = static_cast<std::uint32_t>(lost.size());
    std::vector<bool> root_lost(n, false);
    for (std::uint32_t r = 0; r < n; ++r)
        if (lost[r]) root_lost[base_.touched.find(r)] = true;
    std::vector<RobotId> closure;
    for (std::uint32_t r = 0; r < n; ++r)
        if (root_lost[base_.touched.find(r)]) closure.emplace_back(r);
    return closure;
}

void Controller::begin_recovery() {
    if (roster_.workers().empty()) return;
    recovering_ = closure_of_lost();
    ++counters_.recoveries;
    notices_.add("bringing back " + std::to_string(recovering_.size()) +
                 " robots from the checkpoint at tick " + std::to_string(base_.tick));
    directory_.begin_recovery(recovering_, base_.tick);
    observations_due_ = true;
    if (base_.tick < tick()) begin_leg(base_.tick);
}

/// Steps the recovering robots from `from` to the next tick that is needed, or to the committed one.
void Controller::begin_leg(Tick from) {
    const Tick until = directory_.next_needed(from);
    std::vector<SeatId> source = round_ ? std::vector(round_->seats().begin(), round_->seats().end())
                                        : std::vector(directory_.holders().size(), kAtController);
    Islands islands;
    collect_islands(base_.touched, recovering_, islands);
    const bool first = from == base_.tick;
    Round round(RoundSpan{epoch_, ++window_, from, until, true}, directory_.holders().size());
    std::vector<SeatId> seat_of_island;
    if (first) {
        seat_of_island = costs_.assign_recovered(islands, roster_);
    } else {
        for (std::size_t i = 0; i < islands.count(); ++i)
            seat_of_island.push_back(source[islands.of(i).front().index()]);
    }
    round.assign(islands, seat_of_island, source, roster_);
    give_all(order_log_, round);
    if (!first) {
        std::vector<std::vector<RobotId>> robots(roster_.size());
        for (const RobotId robot : recovering_) robots[source[robot.index()]].push_back(robot);
        for (SeatId seat = 0; seat < robots.size(); ++seat)
            if (!robots[seat].empty()) round.keep(seat, std::move(robots[seat]));
    }
    round.release_before(std::min(base_.tick, directory_.oldest_wanted(base_.tick)));
    round.islands = std::move(islands);
    round_ = std::move(round);
}

void Controller::finish_leg() {
    const Tick until = round_->span().until;
    observations_due_ = true;
    if (until == tick()) {
        const auto differs = std::find_if(recovering_.begin(), recovering_.end(), [this](RobotId robot) {
            return next_hashes_[robot.index()] != hashes_[robot.index()];
        });
        if (differs != recovering_.end()) return fail_recovery(*differs);
    }
    directory_.recovered(recovering_, until, round_->seats(), roster_);
    if (until < tick()) return begin_leg(until);
    round_.reset();
    recovering_.clear();
}

/// The recovered state of this robot is not the committed one.
void Controller::fail_recovery(RobotId robot) {
    round_.reset();
    notices_.fail(
        {"robot '" + model_->robots[robot.index()].name + "' came to another state at tick " +
             std::to_string(tick()) + " when it was stepped again after a loss",
         "a Simulator computes other bits: compare the machines with `roboss check`, and report this",
         "bits-differ"});
}

}  // namespace roboss
