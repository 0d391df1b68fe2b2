// Seats of Clients and what they allow.
#include "roles/client_service.h"

#include <algorithm>
#include <limits>

namespace roboss {

namespace {

/// The first multiple of `period` that is not before `tick`.
Tick next_multiple(Tick tick, Tick period) {
    return (tick + period - 1) / period * period;
}

}  // namespace

ClientService::ClientService(const std::vector<std::string>& expected) {
    for (const std::string& name : expected) seats_.emplace_back().name = name;
}

ClientId ClientService::welcome(const Address& address, const ClientHello& hello, Tick earliest,
                                bool& is_new) {
    auto seat = std::find_if(seats_.begin(), seats_.end(),
                             [&](const ClientSeat& s) { return s.joined && s.address == address; });
    is_new = seat == seats_.end();
    if (is_new) {
        seat = std::find_if(seats_.begin(), seats_.end(),
                            [&](const ClientSeat& s) { return !s.joined && s.name == hello.name; });
        if (seat == seats_.end()) seat = seats_.insert(seats_.end(), ClientSeat{});
        seat->name = hello.name;
        seat->address = address;
        seat->period = hello.period;
        seat->latency = hello.latency;
        seat->synchronous = hello.synchronous;
        seat->observer = hello.observer;
        seat->joined = true;
        seat->first = next_multiple(std::max(earliest, hello.expected), hello.period);
        seat->last_reply = seat->acknowledged = hello.acknowledged;
        seat->reply_awaited = hello.last_reply;
    }
    return ClientId(static_cast<std::size_t>(seat - seats_.begin()));
}

bool ClientService::all_joined() const {
    return std::all_of(seats_.begin(), seats_.end(), [](const ClientSeat& s) { return s.joined; });
}

Tick ClientService::limit(Tick tick, bool all_answered) const {
    Tick limit = std::numeric_limits<Tick>::max();
    for (const ClientSeat& seat : seats_) {
        if (!seat.serves()) continue;
        if (!all_answered && seat.synchronous && seat.last_reply < seat.reply_awaited) return tick;
        const Tick next = std::max(next_multiple(tick + 1, seat.period), seat.first);
        if (next > tick) limit = std::min(limit, next);
        if (!seat.synchronous) continue;
        Tick open = seat.unanswered.empty() ? next : seat.unanswered.front();
        if (all_answered) open = observes(seat, tick) ? tick : next;
        limit = std::min(limit, open + seat.latency);
    }
    return limit;
}

}  // namespace roboss
