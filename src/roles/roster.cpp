// Seats of Simulators.
#include "roles/roster.h"

#include <algorithm>

#include "bus/bus.h"

namespace roboss {

std::optional<SeatId> Roster::seat_for(const Address& address, const Hello& hello, std::int64_t now_ms,
                                       bool& is_new) {
    const std::optional<SeatId> here = seat_at(address);
    is_new = !here;
    if (here) return here;
    const bool has_left = std::any_of(seats_.begin(), seats_.end(), [&](const SimulatorSeat& s) {
        return !s.alive && s.leaving && s.address == address;
    });
    if (has_left) return is_new = false, std::nullopt;
    SimulatorSeat seat;
    seat.address = address;
    seat.name = hello.name;
    seat.threads = std::max(hello.threads, 1u);
    seat.heard_ms = now_ms;
    seats_.push_back(seat);
    return static_cast<std::uint32_t>(seats_.size() - 1);
}

std::optional<SeatId> Roster::seat_at(const Address& address) const {
    const auto here = std::find_if(seats_.begin(), seats_.end(),
                                   [&](const SimulatorSeat& s) { return s.alive && s.address == address; });
    if (here == seats_.end()) return std::nullopt;
    return static_cast<std::uint32_t>(here - seats_.begin());
}

std::optional<SeatId> Roster::seat_of(SimulatorId id) const {
    const SeatId seat_id = id.value - first_id_;  // of an id from before it: far too large
    return seat_id < seats_.size() ? std::optional(seat_id) : std::nullopt;
}

std::size_t Roster::alive_count() const {
    return static_cast<std::size_t>(
        std::count_if(seats_.begin(), seats_.end(), [](const auto& s) { return s.alive; }));
}

std::vector<std::uint32_t> Roster::workers() const {
    std::vector<SeatId> workers;
    for (SeatId seat_id = 0; seat_id < seats_.size(); ++seat_id)
        if (seats_[seat_id].alive && !seats_[seat_id].leaving) workers.push_back(seat_id);
    return workers;
}

std::uint32_t Roster::threads() const {
    std::uint32_t threads = 0;
    for (const SeatId seat_id : workers()) threads += seats_[seat_id].threads;
    return threads;
}

Address Roster::address_of(SeatId seat_id) const {
    return seat_id == kAtController ? kControllerAddress : seats_[seat_id].address;
}

double Roster::balance() const {
    double sum = 0, busiest = 0, threads = 0;
    for (const SeatId seat_id : workers()) {
        const SimulatorSeat& seat = seats_[seat_id];
        sum += seat.spent_ns * seat.threads;
        busiest = std::max(busiest, seat.spent_ns);
        threads += seat.threads;
    }
    return busiest > 0 ? sum / (threads * busiest) : 1;
}

}  // namespace roboss
