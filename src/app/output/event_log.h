// --log: the events and, at intervals, the state of a run, one per line as `name=value` pairs: members that
// join and leave, the window, its repetitions, the load balance, and the robots of each Simulator. Times are
// wall-clock times (UTC); ticks are those of the world.
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

/// The state of a run: one line for the whole run (`event=state`), then one for each Simulator (`event=load`:
/// its robots as ranges of ids, CPU time a tick, share of the busiest's).
std::vector<std::string> state_lines(const Simulation& simulation);

class EventLog {
  public:
    /// `path`: a file to append to, or `-` for standard error. The state is written every `every_s` seconds.
    static Result<EventLog> open(const std::string& path, double every_s);

    void event(Tick tick, const std::string& text);
    /// A message that the world's message board published (client/triggers/triggers.h).
    void message(Tick tick, const std::string& text);
    /// The end of the run, with `code` done or failed.
    void end(Tick tick, const std::string& code);
    /// Writes the state of the run: now, or if the interval is over.
    void write_state(const Simulation& simulation);
    void write_state_if_due(const Simulation& simulation);

  private:
    using Clock = std::chrono::steady_clock;
    EventLog(std::shared_ptr<spdlog::logger> logger, double every_s)
        : logger_(std::move(logger)), every_s_(every_s) {}

    std::shared_ptr<spdlog::logger> logger_;
    double every_s_;
    Clock::time_point written_ = Clock::now();
};

}  // namespace roboss
