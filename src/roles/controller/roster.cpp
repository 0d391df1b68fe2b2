// Seats of Simulators.
#include "roles/controller/roster.h"

#include <algorithm>

#include "core/check.h"

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

std::uint32_t Roster::fewest_threads() const {
    std::uint32_t fewest = 0;
    for (const SeatId seat_id : workers())
        if (fewest == 0 || seats_[seat_id].threads < fewest) fewest = seats_[seat_id].threads;
    return std::max(fewest, 1u);
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

std::optional<SeatId> Roster::heard_from(Bus& bus, const Address& from) {
    const auto seat_id = seat_at(from);
    if (seat_id) seats_[*seat_id].heard_ms = bus.now_ms();
    return seat_id;
}

std::optional<SeatId> Roster::heard_from(Bus& bus, const Address& from, SimulatorId id) {
    const auto seat_id = seat_of(id);
    // A seat of an earlier Controller: its holder has to join again.
    const bool is_known = seat_id && seats_[*seat_id].address == from;
    if (is_known && seats_[*seat_id].alive) {
        seats_[*seat_id].heard_ms = bus.now_ms();
        return seat_id;
    }
    if (is_known && seats_[*seat_id].leaving) {
        bus.send(kControllerAddress, from, Goodbye{id});
    } else {
        bus.send(kControllerAddress, from, Expelled{id});
    }
    return std::nullopt;
}

void Roster::give_up(SeatId seat_id) {
    ROBOSS_CHECK(alive(seat_id), "simulator " + std::to_string(seat_id) + " is lost twice");
    seats_[seat_id].alive = false;
    seats_[seat_id].leaving = false;
}

std::vector<SeatId> Roster::leaving() const {
    std::vector<SeatId> leaving;
    for (SeatId seat_id = 0; seat_id < seats_.size(); ++seat_id)
        if (seats_[seat_id].alive && seats_[seat_id].leaving) leaving.push_back(seat_id);
    return leaving;
}

void Roster::release(Bus& bus, SeatId seat_id) {
    ROBOSS_CHECK(alive(seat_id) && seats_[seat_id].leaving,
                 "simulator " + std::to_string(seat_id) + " is released but did not want to leave");
    seats_[seat_id].alive = false;
    bus.send(kControllerAddress, seats_[seat_id].address, Goodbye{id_of(seat_id)});
}

void Roster::send_heartbeats(Bus& bus) const {
    for (SeatId seat_id = 0; seat_id < seats_.size(); ++seat_id)
        if (seats_[seat_id].alive)
            bus.send(kControllerAddress, seats_[seat_id].address, Heartbeat{id_of(seat_id)});
}

void Roster::dismiss(Bus& bus, const RunOver& over) const {
    for (const SimulatorSeat& seat : seats_)
        if (seat.alive) bus.send(kControllerAddress, seat.address, over);
}

}  // namespace roboss
