// Status reports: which Simulator has which robots.
#include <algorithm>

#include "roles/controller.h"

namespace roboss {

std::vector<MemberReport> Controller::members() const {
    std::vector<MemberReport> members(roster_.size());
    double busiest_ns = 0;
    for (const SeatId seat_id : roster_.workers())
        busiest_ns = std::max(busiest_ns, roster_.seat(seat_id).spent_ns);
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id) {
        const SimulatorSeat& seat = roster_.seat(seat_id);
        MemberReport& member = members[seat_id];
        member = {seat_id, seat.name, seat.threads, seat.alive, seat.leaving, 0, 0, 0, 0, seat.address};
        if (!seat.alive) continue;
        member.step_us = 1e-3 * seat.spent_ns;
        member.load = busiest_ns > 0 ? seat.spent_ns / busiest_ns : 0;
    }
    for (const SeatId seat_id : directory_.holders())
        if (seat_id < members.size()) ++members[seat_id].robots;
    for (std::size_t i = 0; i < islands_.count(); ++i)
        if (const SeatId seat_id = directory_.holder_of(islands_.of(i).front()); seat_id < members.size())
            ++members[seat_id].islands;
    // seats of the run before a rewind have no address
    std::erase_if(members, [this](const MemberReport& member) {
        return roster_.seat(member.number).address.role != Role::kSimulator;
    });
    return members;
}

}  // namespace roboss
