// Flat lists of seats by RobotId: one for the committed tick, one for each wanted tick.
#include "roles/controller/state_directory.h"

#include <algorithm>

#include "core/check.h"

namespace roboss {

void StateDirectory::commit(Tick tick, std::span<const SeatId> holders, const Roster& roster) {
    ROBOSS_CHECK(tick > tick_,
                 "tick " + std::to_string(tick) + " is committed after tick " + std::to_string(tick_));
    ROBOSS_CHECK(holders.size() == holders_.size(), std::to_string(holders.size()) + " holders for " +
                                                        std::to_string(holders_.size()) + " robots");
    for (std::size_t r = 0; r < holders.size(); ++r)
        ROBOSS_CHECK(roster.alive(holders[r]), "no Simulator that is alive holds robot " + std::to_string(r) +
                                                   " at tick " + std::to_string(tick));
    tick_ = tick;
    holders_.assign(holders.begin(), holders.end());
}

WantedTick& StateDirectory::here() {
    if (!wants_this_tick()) wanted_.push_back({tick_, holders_, {}, false});
    return wanted_.back();
}

void StateDirectory::forget(ClientId client, Tick tick) {
    for (WantedTick& want : wanted_)
        if (want.tick == tick) std::erase(want.clients, client);
    drop_closed();
}

void StateDirectory::forget_checkpoint() {
    for (WantedTick& want : wanted_) want.checkpoint = false;
    drop_closed();
}

void StateDirectory::drop_closed() {
    std::erase_if(wanted_, [](const WantedTick& want) { return !want.open(); });
}

Tick StateDirectory::next_needed(Tick tick) const {
    for (const WantedTick& want : wanted_)
        if (want.tick > tick) return want.tick;
    return tick_;
}

void StateDirectory::take_over(SeatId seat_id) {
    std::replace(holders_.begin(), holders_.end(), seat_id, kAtController);
    for (WantedTick& want : wanted_)
        std::replace(want.holders.begin(), want.holders.end(), seat_id, kAtController);
}

bool StateDirectory::anything_lost(const Roster& roster) const {
    const auto any_lost = [&roster](std::span<const SeatId> holders) {
        return std::any_of(holders.begin(), holders.end(), [&](SeatId seat) { return roster.lost(seat); });
    };
    return any_lost(holders_) || std::any_of(wanted_.begin(), wanted_.end(),
                                             [&](const WantedTick& want) { return any_lost(want.holders); });
}

std::vector<bool> StateDirectory::lost(const Roster& roster) const {
    std::vector<bool> lost(holders_.size());
    for (std::size_t r = 0; r < holders_.size(); ++r)
        lost[r] = roster.lost(holders_[r]) ||
                  std::any_of(wanted_.begin(), wanted_.end(),
                              [&](const WantedTick& w) { return roster.lost(w.holders[r]); });
    return lost;
}

void StateDirectory::begin_recovery(std::span<const RobotId> robots, Tick checkpoint) {
    const auto holder_at = [checkpoint](Tick tick) { return tick == checkpoint ? kAtController : kLost; };
    for (const RobotId robot : robots) holders_[robot.index()] = holder_at(tick_);
    for (WantedTick& want : wanted_)
        for (const RobotId robot : robots) want.holders[robot.index()] = holder_at(want.tick);
}

void StateDirectory::recovered(std::span<const RobotId> robots, Tick tick, std::span<const SeatId> seats,
                               const Roster& roster) {
    for (WantedTick& want : wanted_)
        if (want.tick == tick)
            for (const RobotId robot : robots)
                if (SeatId& holder = want.holders[robot.index()]; roster.lost(holder))
                    holder = seats[robot.index()];
    if (tick == tick_)
        for (const RobotId robot : robots) holders_[robot.index()] = seats[robot.index()];
}

}  // namespace roboss
