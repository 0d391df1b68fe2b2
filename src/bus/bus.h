// Bus: how roles talk. Values go in, values come out; nothing is promised (a message may be lost, late,
// doubled or out of order), so the same roles run over queues in one process, over a faulty bus in tests, and
// over a network.
#pragma once

#include <cstdint>
#include <vector>

#include "wire/message.h"

namespace roboss {

inline constexpr Address kControllerAddress{Role::kController, 0};

class Bus {
  public:
    virtual ~Bus() = default;
    virtual void send(const Address& from, const Address& to, Message message) = 0;
    /// Moves everything that has arrived for `self` to `inbox` (cleared first), oldest first.
    virtual void drain(const Address& self, std::vector<Envelope>& inbox) = 0;
    /// For sending again and for noticing losses only; no result depends on it.
    virtual std::int64_t now_ms() = 0;
};

/// Milliseconds of the machine's monotonic clock.
std::int64_t monotonic_ms();

}  // namespace roboss
