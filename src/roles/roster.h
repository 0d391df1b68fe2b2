// The Simulators that the Controller knows. A seat is never given twice, so a message that names a lost
// Simulator's seat can be told from one of its successor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wire/message.h"

namespace roboss {

/// Where a robot's state is: the index of a seat, or one of these.
inline constexpr std::uint32_t kAtController = 0xFFFFFFFEu;
inline constexpr std::uint32_t kLost = 0xFFFFFFFDu;

struct SimulatorSeat {
    Address address;
    std::string name;
    bool alive = true;
    bool leaving = false;  // asked to go; with !alive: has gone in good order
    std::uint32_t threads = 1;
    std::int64_t heard_ms = 0;
    double rate = 1;      // measured: how much faster than the mean of all one of its threads is
    double spent_ns = 0;  // CPU time of its stepping a tick and thread, running mean
    double speed() const { return rate * threads; }
};

class Roster {
  public:
    /// `taken`: seats that were given before; these are lost ones. `first_id`: of seat 0.
    explicit Roster(std::size_t taken = 0, std::uint32_t first_id = 0) : seats_(taken), first_id_(first_id) {
        for (SimulatorSeat& seat : seats_) seat.alive = false;
    }
    /// The place of the living Simulator at this address; a new one if there is none. None if it has left in
    /// good order: then the hello is a late copy.
    std::optional<std::uint32_t> seat_for(const Address& address, const Hello& hello, std::int64_t now_ms,
                                          bool& is_new);
    SimulatorId id_of(std::uint32_t place) const { return SimulatorId(first_id_ + place); }
    /// Of the living Simulator there.
    std::optional<std::uint32_t> place_at(const Address& address) const;
    /// None: the id is of another Controller's run.
    std::optional<std::uint32_t> place_of(SimulatorId id) const;
    bool alive(std::uint32_t place) const { return place < seats_.size() && seats_[place].alive; }
    SimulatorSeat& seat(std::uint32_t place) { return seats_[place]; }
    const SimulatorSeat& seat(std::uint32_t place) const { return seats_[place]; }
    std::size_t size() const { return seats_.size(); }
    std::size_t alive_count() const;
    /// Seats that may get work: alive and not leaving.
    std::vector<std::uint32_t> workers() const;
    /// Threads of all workers.
    std::uint32_t threads() const;
    Address address_of(std::uint32_t place) const;

  private:
    std::vector<SimulatorSeat> seats_;
    std::uint32_t first_id_;
};

}  // namespace roboss
