// --log: what happens in a run and how it stands, one event a line, as `name=value` pairs that people read
// and programs split: who came and went, and every so often the window, its repetitions, the balance, and who
// has what. Times are those of the wall (UTC), ticks the world's.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "simulation/simulation.h"

namespace spdlog {
class logger;
}

namespace roboss {

/// How a run stands: a line for all of it (`event=state`), then one for each Simulator (`event=load`: its
/// robots as ranges of ids, CPU time a tick, share of the busiest's).
std::vector<std::string> state_lines(const Simulation& simulation);

class EventLog {
  public:
    /// `path`: a file to add to, or `-` for standard error. How the run stands is told each `every_s`
    /// seconds.
    static Result<EventLog> open(const std::string& path, double every_s);

    void event(Tick tick, const std::string& text);
    /// How it stands, now, or if it is time to.
    void tell(const Simulation& simulation);
    void tell_if_due(const Simulation& simulation);

  private:
    using Clock = std::chrono::steady_clock;
    EventLog(std::shared_ptr<spdlog::logger> logger, double every_s)
        : logger_(std::move(logger)), every_s_(every_s) {}

    std::shared_ptr<spdlog::logger> logger_;
    double every_s_;
    Clock::time_point told_ = Clock::now();
};

}  // namespace roboss
