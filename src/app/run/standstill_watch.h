// StandstillWatch: says whom a run waits for when its world does not advance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/types.h"
#include "simulation/simulation.h"

namespace roboss {

class StandstillWatch {
  public:
    /// A line for the log: after 5 s at one tick, then at growing intervals of a minute at most.
    std::optional<std::string> look(const Simulation& simulation, std::int64_t now_ms) {
        if (simulation.tick() != tick_) since_ms_ = now_ms, next_ms_ = kFirst_ms, tick_ = simulation.tick();
        const std::int64_t for_ms = now_ms - since_ms_;
        if (for_ms < next_ms_) return {};
        next_ms_ += std::min(next_ms_, kMost_ms);
        const std::string whom = simulation.waits_for();
        if (whom.empty()) return {};
        return "at tick " + std::to_string(tick_) + " for " + std::to_string(for_ms / 1'000) +
               " s: the run waits for " + whom + " [standstill]";
    }

  private:
    static constexpr std::int64_t kFirst_ms = 5'000, kMost_ms = 60'000;
    Tick tick_ = -1;
    std::int64_t since_ms_ = 0, next_ms_ = 0;
};

}  // namespace roboss
