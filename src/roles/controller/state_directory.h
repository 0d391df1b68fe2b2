// StateDirectory: which seat holds each robot's state, at the committed tick and at earlier ticks whose
// states somebody still needs (a Client that has not replied, a checkpoint that is being fetched). Every role
// that asks for states is sent to the seats named here. A state is at exactly one seat, at the Controller, or
// lost.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "roles/controller/roster.h"

namespace roboss {

/// A committed tick whose states somebody still needs.
struct WantedTick {
    Tick tick = 0;
    std::vector<SeatId> holders;  // by RobotId
    std::vector<ClientId> clients;
    bool checkpoint = false;
    bool open() const { return checkpoint || !clients.empty(); }
};

class StateDirectory {
  public:
    /// At `tick` the Controller has all states.
    StateDirectory(std::size_t robots, Tick tick) : tick_(tick), holders_(robots, kAtController) {}

    /// The committed tick.
    Tick tick() const { return tick_; }
    /// By RobotId: the seats of the states at tick().
    std::span<const SeatId> holders() const { return holders_; }
    SeatId holder_of(RobotId robot) const { return holders_[robot.index()]; }
    /// The world has advanced to `tick`; `holders` have its states. All of them are alive, and ticks grow.
    void commit(Tick tick, std::span<const SeatId> holders, const Roster& roster);

    // Ticks that are wanted.
    /// This Client needs the states at tick().
    void want(ClientId client) { here().clients.push_back(client); }
    void want_checkpoint() { here().checkpoint = true; }
    /// The Client does not need `tick` any more.
    void forget(ClientId client, Tick tick);
    void forget_checkpoint();
    /// Ascending by tick.
    std::span<const WantedTick> wanted() const { return wanted_; }
    /// Somebody needs the states at tick().
    bool wants_this_tick() const { return !wanted_.empty() && wanted_.back().tick == tick_; }
    /// The earliest wanted tick, or `otherwise`.
    Tick oldest_wanted(Tick otherwise) const { return wanted_.empty() ? otherwise : wanted_.front().tick; }
    /// The first tick after `tick` that is wanted or committed.
    Tick next_needed(Tick tick) const;

    // Changes of holders.
    /// The Simulator of this seat leaves; the Controller has all states that it held.
    void take_over(SeatId seat_id);
    bool anything_lost(const Roster& roster) const;
    /// By RobotId: whether its state is lost, at tick() or at a wanted tick.
    std::vector<bool> lost(const Roster& roster) const;
    /// These robots are stepped again from the Controller's checkpoint at `checkpoint`, which overwrites the
    /// Simulators' states of them: until they are stepped, only those of the checkpoint are valid.
    void begin_recovery(std::span<const RobotId> robots, Tick checkpoint);
    /// They were stepped again to `tick`; `seats`, by RobotId, have the states.
    void recovered(std::span<const RobotId> robots, Tick tick, std::span<const SeatId> seats,
                   const Roster& roster);

  private:
    WantedTick& here();
    void drop_closed();

    Tick tick_;
    std::vector<SeatId> holders_;
    std::vector<WantedTick> wanted_;
};

}  // namespace roboss
