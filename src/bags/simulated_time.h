// SimulatedTime: the log times of a bag as times of a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace roboss::bags {

/// A message of /clock.
struct ClockReading {
    std::int64_t log_ns = 0;        ///< when it was recorded
    std::int64_t simulated_ns = 0;  ///< the time that it gives
};

/// Without /clock a run begins at the earliest log time of the bag. With it, the simulated time of a log time
/// is that of /clock: between two of its messages in proportion, before the first and behind the last by the
/// same number of ns. So it is right for bags of runs that were slower or faster than real time, or paused,
/// and exact where log times are simulated.
class SimulatedTime {
  public:
    /// `clock`: in any order. `earliest_ns`: of all log times. All times are within 4e18 of 0. An Error,
    /// "clock-back": the world was reset within the bag.
    static Result<SimulatedTime> make(std::vector<ClockReading> clock, std::int64_t earliest_ns) {
        std::ranges::stable_sort(clock, {}, &ClockReading::log_ns);
        for (std::size_t i = 1; i < clock.size(); ++i)
            if (clock[i].simulated_ns < clock[i - 1].simulated_ns)
                return Error{"/clock goes back from " + seconds(clock[i - 1].simulated_ns) + " to " +
                                 seconds(clock[i].simulated_ns) + " at the log time " +
                                 seconds(clock[i].log_ns) + ": the bag has several runs",
                             "cut it into one bag for each run (`ros2 bag convert`)", "clock-back"};
        return SimulatedTime(std::move(clock), earliest_ns);
    }

    /// Negative: before the run.
    std::int64_t at(std::int64_t log_ns) const {
        if (clock_.empty()) return log_ns - earliest_ns_;
        const auto next = std::ranges::upper_bound(clock_, log_ns, {}, &ClockReading::log_ns);
        if (next == clock_.begin()) return next->simulated_ns - (next->log_ns - log_ns);
        const ClockReading& last = *(next - 1);
        const std::int64_t since_ns = log_ns - last.log_ns;
        if (next == clock_.end()) return last.simulated_ns + since_ns;
        const double rate = static_cast<double>(next->simulated_ns - last.simulated_ns) /
                            static_cast<double>(next->log_ns - last.log_ns);
        return last.simulated_ns + std::llround(rate * static_cast<double>(since_ns));
    }

  private:
    SimulatedTime(std::vector<ClockReading> clock, std::int64_t earliest_ns)
        : clock_(std::move(clock)), earliest_ns_(earliest_ns) {}
    static std::string seconds(std::int64_t ns) {
        return std::to_string(static_cast<double>(ns) / 1e9) + " s";
    }

    std::vector<ClockReading> clock_;  // ascending
    std::int64_t earliest_ns_ = 0;
};

}  // namespace roboss::bags
