// Bus: how roles exchange messages. Delivery is not guaranteed (a message may be lost, late, duplicated or
// out of order), so the same roles run over queues in one process, over a faulty bus in tests, and over a
// network.
#pragma once

#include <cstdint>
#include <vector>

#include "wire/message.h"

namespace roboss {

inline constexpr Address kControllerAddress{Role::kController, 0};

/// Messages from one address to another since the start.
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
    /// Only for resending and for detecting losses; no result depends on it.
    virtual std::int64_t now_ms() = 0;

    /// Addresses that sent to `self` before and are now gone or disconnected, as far as the Bus can tell;
    /// each is reported once. A hint that is faster than a timeout: a Bus that cannot tell reports nothing,
    /// and a wrong hint costs time only.
    virtual std::vector<Address> take_vanished(const Address&) { return {}; }
    /// From now on the Bus sends this heartbeat of `from` while `from` sends none itself, because its step is
    /// long; not without end, so that a member that hangs is still noticed. A Bus of one thread does nothing.
    virtual void keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) {
        (void)from, (void)to, (void)heartbeat;
    }
    virtual void end_keep_alive(const Address& from) { (void)from; }
    /// To be called between two advance() of the roles: returns when a message may have arrived for an
    /// address of this process, at the latest after `ms_max`. A Bus whose messages need no time returns at
    /// once.
    virtual void wait(std::int64_t) {}
    /// For status reports: what addresses of this process have sent and received. Bytes are encoded bytes, so
    /// 0 within a process. Empty if the Bus does not count.
    virtual std::vector<Flow> flows() const { return {}; }
};

/// Milliseconds of the machine's monotonic clock.
std::int64_t monotonic_ms();

}  // namespace roboss
