// Checkpoints, leaving, and losses. A lost robot's state is recomputed: the robot and all that it may have
// touched since the last checkpoint are stepped from there with the logged orders, and must reach the
// committed hashes.
#include <algorithm>

#include "roles/controller.h"

namespace roboss {

bool Controller::checkpoint_due() const {
    if (checkpoints_.under_way() || checkpoints_.tick() == tick()) return false;
    const bool by_ticks =
        options_.checkpoint_ticks > 0 && tick() - checkpoints_.tick() >= options_.checkpoint_ticks;
    return by_ticks ||
           (options_.checkpoint_work_s > 0 && checkpoints_.work_s() >= options_.checkpoint_work_s);
}

/// A checkpoint for the log, if one is due at this tick.
void Controller::begin_log_checkpoint() {
    if (!recorder_.take_checkpoint_due(tick())) return;
    checkpoints_.begin(directory_, roster_);
    if (!checkpoints_.has_or_fetches(tick())) return;
    recorder_.checkpoint_begun(tick());
    if (checkpoints_.tick() == tick()) recorder_.checkpoint_complete(tick(), checkpoints_.states());
}

/// Fetches states while Simulators step, so that nobody waits for it. A recovery keeps the checkpoint that it
/// began with.
void Controller::advance_checkpoint(Bus& bus) {
    checkpoints_.advance(bus, directory_, roster_, options_.resend_ms);
    if (checkpoints_.fetched() && round_ && !round_->span().recovery) finish_checkpoint();
}

void Controller::finish_checkpoint() {
    if (!checkpoints_.replace(directory_)) return;
    order_log_.trim(checkpoints_.tick());
    ++counters_.checkpoints;
    recorder_.checkpoint_complete(checkpoints_.tick(), checkpoints_.states());
}

/// No window starts while a member leaves, so the checkpoint taken for it has all states that it held.
bool Controller::release_leaving_members(Bus& bus) {
    bool leaving = false;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id)
        leaving = leaving || (roster_.alive(seat_id) && roster_.seat(seat_id).leaving);
    if (!leaving) return false;
    if (checkpoints_.tick() != tick()) {
        checkpoints_.begin(directory_, roster_);
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
    if (const auto lost = checkpoints_.abandon(directory_)) recorder_.checkpoint_lost(*lost);
    notices_.add("simulator " + std::to_string(seat_id) + " " + why + " and is given up at tick " +
                 std::to_string(tick()));
}

void Controller::begin_recovery() {
    if (roster_.workers().empty()) return;
    recovery_.begin();
    ++counters_.recoveries;
    notices_.add("bringing back " + std::to_string(recovery_.robots().size()) +
                 " robots from the checkpoint at tick " + std::to_string(checkpoints_.tick()));
    observations_due_ = true;
    if (recovery_.has_legs()) round_ = recovery_.first_leg(epoch_, ++window_);
}

void Controller::finish_leg() {
    observations_due_ = true;
    if (round_->span().until == tick())
        if (const auto robot = recovery_.first_difference(next_hashes_, hashes_))
            return fail_recovery(*robot);
    if (recovery_.finish_leg(*round_)) {
        round_.reset();
    } else {
        round_ = recovery_.next_leg(*round_, ++window_);
    }
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
