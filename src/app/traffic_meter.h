// TrafficMeter: what goes to and from the Controller in a second, in all and by member, from what the Bus
// counts; over the last second or two.
#pragma once

#include <map>
#include <span>

#include "bus/bus.h"

namespace roboss {

/// A second.
struct TrafficRate {
    double messages_in = 0, bytes_in = 0;    // to the Controller
    double messages_out = 0, bytes_out = 0;  // from it
};

class TrafficMeter {
  public:
    bool due(std::int64_t now_ms) const { return now_ms - taken_ms_ >= kEvery_ms; }
    void take(std::span<const Flow> flows, std::int64_t now_ms);
    TrafficRate total() const;
    TrafficRate of(const Address& member) const;

  private:
    static constexpr std::int64_t kEvery_ms = 1'000;
    struct Sums {
        std::uint64_t messages_in = 0, bytes_in = 0, messages_out = 0, bytes_out = 0;
    };

    std::int64_t taken_ms_ = -kEvery_ms;
    std::map<Address, Sums> before_;
    std::map<Address, TrafficRate> rates_;
};

}  // namespace roboss
