// Roster: the Simulators that the Controller knows, as they join, report, leave and are lost. A seat is never
// given twice, so a message that names a lost Simulator's seat is never taken for one from its successor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.h"

namespace roboss {

/// Index of a Simulator's seat in the Roster. Where a robot's state is: such an index, or one of the two
/// below.
using SeatId = std::uint32_t;
inline constexpr SeatId kAtController = 0xFFFFFFFEu;
inline constexpr SeatId kLost = 0xFFFFFFFDu;

struct SimulatorSeat {
    Address address;
    std::string name;
    bool alive = true;
    bool leaving = false;  // asked to leave; with !alive: has left
    std::uint32_t threads = 1;
    std::int64_t heard_ms = 0;
    double rate = 1;      // measured: how much faster than the mean of all one of its threads is
    double spent_ns = 0;  // CPU time of its stepping a tick and thread, running mean
    double speed() const { return rate * threads; }
};

class Roster {
  public:
    /// `first_id`: the id of seat 0.
    explicit Roster(std::uint32_t first_id = 0) : first_id_(first_id) {}
    /// The seat of the Simulator that is alive at this address, or a new one. None if it has left: then the
    /// hello is a late copy.
    std::optional<SeatId> seat_for(const Address& address, const Hello& hello, std::int64_t now_ms,
                                   bool& is_new);
    SimulatorId id_of(SeatId seat_id) const { return SimulatorId(first_id_ + seat_id); }
    /// Seat of the Simulator that is alive at this address.
    std::optional<SeatId> seat_at(const Address& address) const;
    /// None: another Controller gave this id.
    std::optional<SeatId> seat_of(SimulatorId id) const;
    bool alive(SeatId seat_id) const { return seat_id < seats_.size() && seats_[seat_id].alive; }
    SimulatorSeat& seat(SeatId seat_id) { return seats_[seat_id]; }
    const SimulatorSeat& seat(SeatId seat_id) const { return seats_[seat_id]; }
    /// A state with this holder is lost.
    bool lost(SeatId holder) const { return holder != kAtController && !alive(holder); }
    std::size_t size() const { return seats_.size(); }
    std::size_t alive_count() const;
    /// Seats that can get work: alive and not leaving.
    std::vector<SeatId> workers() const;
    /// Threads of all workers.
    std::uint32_t threads() const;
    /// Threads of the worker that has the fewest; 1 if there is none.
    std::uint32_t fewest_threads() const;
    Address address_of(SeatId seat_id) const;
    /// A message came from this address. Returns the seat of the Simulator that is alive there.
    std::optional<SeatId> heard_from(Bus& bus, const Address& from);
    /// A message that names its sender came. One that is not alive there gets Expelled or Goodbye, and has no
    /// seat.
    std::optional<SeatId> heard_from(Bus& bus, const Address& from, SimulatorId id);
    /// The Simulator is lost.
    void give_up(SeatId seat_id);
    /// Seats of those that are alive and want to leave.
    std::vector<SeatId> leaving() const;
    /// The Simulator of this seat may go; nothing depends on it any more.
    void release(Bus& bus, SeatId seat_id);
    void send_heartbeats(Bus& bus) const;
    void dismiss(Bus& bus, const RunOver& over) const;

    /// Load balance of the stepping in recent windows: 1 is perfect.
    double balance() const;

  private:
    std::vector<SimulatorSeat> seats_;
    std::uint32_t first_id_;
};

}  // namespace roboss
