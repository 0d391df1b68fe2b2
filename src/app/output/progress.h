// A progress line of a run, on a terminal only.
#pragma once

#include <chrono>
#include <string>

#include "simulation/simulation.h"

namespace roboss {

class Progress {
  public:
    /// `wanted`: show anything at all. Quiet too if standard error is no terminal.
    explicit Progress(bool wanted);
    /// Updates the line every half second; `more` is its end.
    void show(const Simulation& simulation, const std::string& more = {});
    /// Ends the line, so that other text can follow.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    bool on_ = false;
    bool line_open_ = false;
    Clock::time_point last_ = Clock::now();
    double last_time_s_ = -1;
    std::uint64_t last_contacts_ = 0, last_ticks_ = 0;
};

}  // namespace roboss
