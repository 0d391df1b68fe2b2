// Simulators that are lost or leave, and the checkpoints that make up for it.
#include <algorithm>

#include "roles/controller/controller.h"

namespace roboss {

void Controller::notice_losses(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    for (const Address& address : bus.take_vanished(kControllerAddress)) {
        if (const auto seat_id = roster_.seat_at(address)) give_up(*seat_id, "vanished");
        clients_.take_vanished(address, now);
    }
    if (options_.loss_ms <= 0) return;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id) {
        const SimulatorSeat& seat = roster_.seat(seat_id);
        if (!seat.alive || now - seat.heard_ms <= options_.loss_ms) continue;
        ++counters_.silences;
        give_up(seat_id, "was silent for " + std::to_string(now - seat.heard_ms) + " ms");
    }
}

void Controller::give_up(SeatId seat_id, const std::string& why) {
    roster_.give_up(seat_id);
    ++epoch_;
    ++counters_.losses;
    counters_.simulators = roster_.alive_count();
    if (round_) {
        round_.reset();
        enter(Phase::kIdle);
    }
    if (const auto lost = checkpoints_.abandon(directory_)) recorder_.checkpoint_lost(*lost);
    notices_.add("simulator " + std::to_string(seat_id) + " " + why + " and is given up at tick " +
                 std::to_string(tick()));
}

/// Only Simulators can step again what is lost.
void Controller::begin_recovery() {
    if (phase_ == Phase::kReleasing) enter(Phase::kIdle);
    if (roster_.workers().empty()) return;
    recovery_.begin();
    ++counters_.recoveries;
    notices_.add("bringing back " + std::to_string(recovery_.robots().size()) +
                 " robots from the checkpoint at tick " + std::to_string(checkpoints_.tick()));
    clients_.holders_changed();
    if (!recovery_.has_legs()) return;
    enter(Phase::kRecovering);
    round_ = recovery_.first_leg(epoch_, ++window_);
}

void Controller::finish_leg() {
    clients_.holders_changed();
    std::optional<RobotId> differs;
    if (round_->span().until == tick()) differs = recovery_.first_difference(next_hashes_, hashes_);
    if (!differs && !recovery_.finish_leg(*round_)) {
        round_ = recovery_.next_leg(*round_, ++window_);
        return;
    }
    round_.reset();
    enter(Phase::kIdle);
    if (differs)
        notices_.fail(
            {"robot '" + model_->robots[differs->index()].name + "' came to another state at tick " +
                 std::to_string(tick()) + " when it was stepped again after a loss",
             "a Simulator computes other bits: compare the machines with `roboss check`, and report this",
             "bits-differ"});
}

/// No window starts while a member leaves, so the checkpoint taken for it has all states that it held. True:
/// some still have to wait.
bool Controller::release_leaving_members(Bus& bus) {
    const std::vector<SeatId> leaving = roster_.leaving();
    const bool must_wait =
        !leaving.empty() && (checkpoints_.tick() != tick() || directory_.oldest_wanted(tick()) < tick());
    if (must_wait != (phase_ == Phase::kReleasing)) enter(must_wait ? Phase::kReleasing : Phase::kIdle);
    if (must_wait && checkpoints_.tick() != tick()) checkpoints_.begin(directory_, roster_);
    if (must_wait || leaving.empty()) return must_wait;
    for (const SeatId seat_id : leaving) {
        directory_.take_over(seat_id);
        roster_.release(bus, seat_id);
        notices_.add("simulator " + std::to_string(seat_id) + " left at tick " + std::to_string(tick()));
    }
    counters_.simulators = roster_.alive_count();
    clients_.holders_changed();
    return false;
}

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
    if (checkpoints_.fetched() && phase_ == Phase::kStepping) finish_checkpoint();
}

void Controller::finish_checkpoint() {
    if (!checkpoints_.replace(directory_)) return;
    order_log_.trim(checkpoints_.tick());
    ++counters_.checkpoints;
    recorder_.checkpoint_complete(checkpoints_.tick(), checkpoints_.states());
}

void Controller::send_heartbeats(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (now - heartbeat_sent_ms_ < options_.heartbeat_ms) return;
    heartbeat_sent_ms_ = now;
    roster_.send_heartbeats(bus);
    clients_.send_heartbeats(bus);
}

}  // namespace roboss
