// What the Controller tells people: who has what, and how evenly the work is spread.
#include <algorithm>

#include "roles/controller.h"

namespace roboss {

std::vector<MemberReport> Controller::members() const {
    std::vector<MemberReport> members(roster_.size());
    double busiest_ns = 0;
    for (const std::uint32_t place : roster_.workers())
        busiest_ns = std::max(busiest_ns, roster_.seat(place).spent_ns);
    for (std::uint32_t place = 0; place < roster_.size(); ++place) {
        const SimulatorSeat& seat = roster_.seat(place);
        MemberReport& member = members[place];
        member = {place, seat.name, seat.threads, seat.alive, seat.leaving, 0, 0, 0, 0, seat.address};
        if (!seat.alive) continue;
        member.step_us = 1e-3 * seat.spent_ns;
        member.load = busiest_ns > 0 ? seat.spent_ns / busiest_ns : 0;
    }
    for (const std::uint32_t place : holder_)
        if (place < members.size()) ++members[place].robots;
    for (std::size_t i = 0; i < islands_.count(); ++i)
        if (const std::uint32_t place = holder_[islands_.of(i).front().index()]; place < members.size())
            ++members[place].islands;
    // seats of the run before a rewind say nothing
    std::erase_if(members, [this](const MemberReport& member) {
        return roster_.seat(member.number).address.role != Role::kSimulator;
    });
    return members;
}

double Controller::balance() const {
    double sum = 0, busiest = 0, threads = 0;
    for (const std::uint32_t place : roster_.workers()) {
        const SimulatorSeat& seat = roster_.seat(place);
        sum += seat.spent_ns * seat.threads;
        busiest = std::max(busiest, seat.spent_ns);
        threads += seat.threads;
    }
    return busiest > 0 ? sum / (threads * busiest) : 1;
}

}  // namespace roboss
