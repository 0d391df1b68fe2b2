// TrafficMeter: messages and bytes per second to and from the Controller, in total and by member, from the
// counters of the Bus over the last one or two seconds.
#pragma once

#include <map>
#include <span>

#include "bus/bus.h"
#include "wire/control.h"

namespace roboss {

class TrafficMeter {
  public:
    bool due(std::int64_t now_ms) const { return now_ms - taken_ms_ >= kEvery_ms; }
    void take(std::span<const Flow> flows, std::int64_t now_ms);
    MessageRate total() const;
    MessageRate of(const Address& member) const;

  private:
    static constexpr std::int64_t kEvery_ms = 1'000;
    struct Sums {
        std::uint64_t messages_in = 0, bytes_in = 0, messages_out = 0, bytes_out = 0;
    };

    std::int64_t taken_ms_ = -kEvery_ms;
    std::map<Address, Sums> before_;
    std::map<Address, MessageRate> rates_;
};

}  // namespace roboss
