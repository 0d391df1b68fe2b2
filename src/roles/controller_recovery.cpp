// Checkpoints, leaving, and losses. A lost robot's state is made again: it and every robot that it may have
// touched since the last checkpoint are stepped from there with the logged orders, and must come to the
// committed hashes.
#include <algorithm>

#include "plan/assign.h"
#include "roles/controller.h"

namespace roboss {

namespace {

std::vector<Holding> holdings_of(std::span<const std::uint32_t> holder, const Roster& roster) {
    std::vector<Holding> holdings;
    std::vector<std::uint32_t> places;
    for (std::size_t r = 0; r < holder.size(); ++r) {
        auto place = std::find(places.begin(), places.end(), holder[r]);
        if (place == places.end()) {
            place = places.insert(places.end(), holder[r]);
            holdings.push_back({roster.address_of(holder[r]), {}});
        }
        holdings[static_cast<std::size_t>(place - places.begin())].robots.emplace_back(r);
    }
    return holdings;
}

}  // namespace

bool Controller::checkpoint_due() const {
    if (next_base_ || base_.tick == tick_) return false;
    const bool by_ticks = options_.checkpoint_ticks > 0 && tick_ - base_.tick >= options_.checkpoint_ticks;
    return by_ticks || (options_.checkpoint_work_s > 0 && work_since_s_ >= options_.checkpoint_work_s);
}

/// Only says which states are wanted, for plans wait for it; tend_checkpoint() fetches them.
void Controller::begin_checkpoint() {
    if (next_base_) return;
    states_wanted_ = false;
    if (base_.tick == tick_ || anything_lost()) return;
    next_base_.emplace();
    next_base_->tick = tick_;
    want_at_this_tick().checkpoint = true;
    work_since_s_ = 0;
}

/// What nobody waits for, in the time in which Simulators step. A recovery steps from the checkpoint that it
/// began with.
void Controller::tend_checkpoint(Bus& bus) {
    if (next_base_ && !next_base_->states) {  // begun in this turn: holder_ is still that of its tick
        next_base_->states = std::make_shared<std::vector<RobotState>>(model_->robots.size());
        next_base_->touched.reset(model_->robots.size());
        pull_.begin(*model_, next_base_->tick, holdings_of(holder_, roster_));
    }
    pull_.advance(bus, kControllerAddress, options_.resend_ms);
    if (pull_.complete() && round_ && !round_->span().recovery) finish_checkpoint();
}

void Controller::finish_checkpoint() {
    for (WantedTick& want : wants_)
        if (want.tick == next_base_->tick) want.checkpoint = false;
    std::erase_if(wants_, [](const WantedTick& want) { return !want.open(); });
    // An earlier tick that is still wanted could not be made again from the new checkpoint.
    if (!wants_.empty() && wants_.front().tick < next_base_->tick) return;
    base_ = std::move(*next_base_);
    next_base_.reset();
    pull_.cancel();
    book_.trim(base_.tick);
    ++counters_.checkpoints;
    if (log_tick_ == base_.tick) log_checkpoint_ = RunCheckpoint{base_.tick, base_.states, {}};
}

/// Nothing is planned while somebody leaves, so the checkpoint taken for it has everything it held.
bool Controller::let_leavers_go(Bus& bus) {
    bool leaving = false;
    for (std::uint32_t place = 0; place < roster_.size(); ++place)
        leaving = leaving || (roster_.alive(place) && roster_.seat(place).leaving);
    if (!leaving) return false;
    if (base_.tick != tick_) {
        begin_checkpoint();
        return true;
    }
    if (!wants_.empty() && wants_.front().tick < tick_) return true;
    for (std::uint32_t place = 0; place < roster_.size(); ++place) {
        SimulatorSeat& seat = roster_.seat(place);
        if (!seat.alive || !seat.leaving) continue;
        for (std::uint32_t& holder : holder_)
            if (holder == place) holder = kAtController;
        for (WantedTick& want : wants_)
            for (std::uint32_t& holder : want.holder)
                if (holder == place) holder = kAtController;
        seat.alive = false;
        bus.send(kControllerAddress, seat.address, Goodbye{roster_.id_of(place)});
        notice("simulator " + std::to_string(place) + " left at tick " + std::to_string(tick_));
    }
    counters_.simulators = roster_.alive_count();
    tell_again_ = true;
    return false;
}

void Controller::notice_losses(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    for (const Address& address : bus.take_vanished(kControllerAddress)) take_vanished(address, now);
    if (options_.loss_ms <= 0) return;
    for (std::uint32_t place = 0; place < roster_.size(); ++place) {
        const SimulatorSeat& seat = roster_.seat(place);
        if (!seat.alive || now - seat.heard_ms <= options_.loss_ms) continue;
        ++counters_.silences;
        give_up(place, "was silent for " + std::to_string(now - seat.heard_ms) + " ms");
    }
}

void Controller::take_vanished(const Address& address, std::int64_t now_ms) {
    for (std::uint32_t place = 0; place < roster_.size(); ++place)
        if (roster_.alive(place) && roster_.seat(place).address == address) give_up(place, "vanished");
    for (ClientSeat& seat : desk_.seats())
        if (seat.serves() && seat.address == address && !seat.vanished_ms) seat.vanished_ms = now_ms;
}

void Controller::give_up(std::uint32_t place, const std::string& why) {
    SimulatorSeat& seat = roster_.seat(place);
    seat.alive = false;
    seat.leaving = false;
    ++epoch_;
    ++counters_.losses;
    counters_.simulators = roster_.alive_count();
    round_.reset();
    if (next_base_ && !pull_.complete()) {
        pull_.cancel();
        if (log_tick_ == next_base_->tick) log_tick_.reset();
        next_base_.reset();
        for (WantedTick& want : wants_) want.checkpoint = false;
        std::erase_if(wants_, [](const WantedTick& want) { return !want.open(); });
    }
    notice("simulator " + std::to_string(place) + " " + why + " and is given up at tick " +
           std::to_string(tick_));
}

bool Controller::anything_lost() const {
    const auto lost = [this](std::uint32_t place) { return is_lost(place); };
    return std::any_of(holder_.begin(), holder_.end(), lost) ||
           std::any_of(wants_.begin(), wants_.end(), [&](const WantedTick& want) {
               return std::any_of(want.holder.begin(), want.holder.end(), lost);
           });
}

/// Robots to be made again: those lost, now or at a tick that is still wanted, and all that they may have
/// touched since the checkpoint. Ascending.
std::vector<RobotId> Controller::closure_of_lost() {
    const std::size_t n = holder_.size();
    std::vector<bool> root_lost(n, false);
    for (std::uint32_t r = 0; r < n; ++r) {
        bool lost = is_lost(holder_[r]);
        for (const WantedTick& want : wants_) lost = lost || is_lost(want.holder[r]);
        if (lost) root_lost[base_.touched.find(r)] = true;
    }
    std::vector<RobotId> closure;
    for (std::uint32_t r = 0; r < n; ++r)
        if (root_lost[base_.touched.find(r)]) closure.emplace_back(r);
    return closure;
}

void Controller::begin_recovery() {
    if (roster_.workers().empty()) return;
    recovering_ = closure_of_lost();
    ++counters_.recoveries;
    notice("bringing back " + std::to_string(recovering_.size()) + " robots from the checkpoint at tick " +
           std::to_string(base_.tick));
    // Stepping them again overwrites what Simulators have of them; only what the Controller has is certain
    // until it is done.
    const std::uint32_t place = base_.tick == tick_ ? kAtController : kLost;
    for (const RobotId robot : recovering_) holder_[robot.index()] = place;
    for (WantedTick& want : wants_)
        for (const RobotId robot : recovering_)
            want.holder[robot.index()] = want.tick == base_.tick ? kAtController : kLost;
    tell_again_ = true;
    if (base_.tick < tick_) begin_leg(base_.tick);
}

/// Steps the recovering robots from `from` to the next tick that is wanted, or to the committed one.
void Controller::begin_leg(Tick from) {
    Tick until = tick_;
    for (const WantedTick& want : wants_)
        if (want.tick > from) until = std::min(until, want.tick);
    std::vector<std::uint32_t> source = round_ ? std::vector(round_->seats().begin(), round_->seats().end())
                                               : std::vector(holder_.size(), kAtController);
    Islands islands;
    collect_islands(base_.touched, recovering_, islands);
    const bool first = from == base_.tick;
    Round round(RoundSpan{epoch_, ++window_, from, until, true}, holder_.size());
    std::vector<std::uint32_t> place;
    if (first) {
        const std::vector<std::uint32_t> workers = roster_.workers();
        const std::vector<std::uint32_t> nowhere(holder_.size(), kNowhere);
        std::vector<double> speeds;
        speeds.reserve(workers.size());
        for (const std::uint32_t worker : workers) speeds.push_back(roster_.seat(worker).threads);
        place = assign({islands, cost_, nowhere, speeds, 0});
        for (std::uint32_t& seat : place) seat = workers[seat];
    } else {
        for (std::size_t i = 0; i < islands.count(); ++i)
            place.push_back(source[islands.of(i).front().index()]);
    }
    round.plan(islands, place, source, roster_);
    give_all(book_, round);
    if (!first) {
        std::vector<std::vector<RobotId>> robots(roster_.size());
        for (const RobotId robot : recovering_) robots[source[robot.index()]].push_back(robot);
        for (std::uint32_t seat = 0; seat < robots.size(); ++seat)
            if (!robots[seat].empty()) round.keep(seat, std::move(robots[seat]));
    }
    round.release_before(wants_.empty() ? base_.tick : std::min(base_.tick, wants_.front().tick));
    round.islands = std::move(islands);
    round_ = std::move(round);
}

void Controller::finish_leg() {
    const Tick until = round_->span().until;
    for (WantedTick& want : wants_)
        if (want.tick == until)
            for (const RobotId robot : recovering_)
                if (is_lost(want.holder[robot.index()])) want.holder[robot.index()] = round_->seat_of(robot);
    tell_again_ = true;
    if (until < tick_) return begin_leg(until);
    for (const RobotId robot : recovering_) {
        if (next_hashes_[robot.index()] != hashes_[robot.index()]) {
            round_.reset();
            return fail({"robot '" + model_->robots[robot.index()].name + "' came to another state at tick " +
                             std::to_string(tick_) + " when it was stepped again after a loss",
                         "a Simulator computes other bits: compare the machines with `roboss check`, and "
                         "report this"});
        }
        holder_[robot.index()] = round_->seat_of(robot);
    }
    round_.reset();
    recovering_.clear();
}

}  // namespace roboss
