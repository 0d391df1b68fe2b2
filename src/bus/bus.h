// Bus: how roles talk. Values go in, values come out; nothing is promised (a message may be lost, late,
// doubled or out of order), so the same roles run over queues in one process, over a faulty bus in tests, and
// over a network.
#pragma once

#include <cstdint>
#include <vector>

#include "wire/message.h"

namespace roboss {

inline constexpr Address kControllerAddress{Role::kController, 0};

/// What went from one address to another since the start.
struct Flow {
    Address from, to;
    std::uint64_t messages = 0, bytes = 0;
};

class Bus {
  public:
    virtual ~Bus() = default;
    virtual void send(const Address& from, const Address& to, Message message) = 0;
    /// Moves everything that has arrived for `self` to `inbox` (cleared first), oldest first.
    virtual void drain(const Address& self, std::vector<Envelope>& inbox) = 0;
    /// For sending again and for noticing losses only; no result depends on it.
    virtual std::int64_t now_ms() = 0;

    /// Addresses that wrote to `self` before and now are gone or cut off, as far as the Bus can tell; each is
    /// told once. A hint that comes sooner than silence would: a Bus that cannot tell says nothing, and one
    /// that errs costs time only.
    virtual std::vector<Address> take_vanished(const Address&) { return {}; }
    /// Between two turns of the roles: returns when something may have come for an address of this process,
    /// at the latest after `ms_max`. A Bus whose messages need no time returns at once.
    virtual void wait(std::int64_t) {}
    /// For people: what addresses of this process have sent and received. Bytes are those encoded, so 0
    /// within a process. A Bus that does not count says nothing.
    virtual std::vector<Flow> flows() const { return {}; }
};

/// Milliseconds of the machine's monotonic clock.
std::int64_t monotonic_ms();

}  // namespace roboss
