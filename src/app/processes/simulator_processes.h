// SimulatorProcesses: the Simulators of `roboss run --processes`. It starts them as processes of
// this computer, watches them until all have joined, ends them, and reports which ended early or did not
// join.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/processes/local_process.h"
#include "core/result.h"

namespace roboss {

class SimulatorProcesses {
  public:
    /// `arguments`: of `roboss`.
    Result<> start(const std::vector<std::string>& arguments);
    std::size_t count() const { return processes_.size(); }
    /// By which their Simulators will join.
    std::vector<std::string> names() const;
    /// True if the Simulator with this name runs in one of them.
    bool has(const std::string& name) const;
    /// Kills the process of the Simulator with this name; false: there is none.
    bool kill(const std::string& name);

    /// The beginning of a run, until every process has joined. An Error names those that have ended, or that
    /// have not joined though for `patience_ms` none joined and nothing was fetched. `joined`: names of all
    /// Simulators so far; `fetched`: a count that grows while somebody fetches the Model.
    Result<> watch_start(const std::vector<std::string>& joined, std::uint64_t fetched, std::int64_t now_ms,
                         std::int64_t patience_ms);
    bool starting() const { return starting_; }
    /// Takes out those that have ended; one line for each.
    std::vector<std::string> take_ended();
    /// Waits until all have ended, at most so long; then kills them.
    void await_exit(std::int64_t ms_max);

  private:
    struct Member {
        std::size_t number;  // from 1
        LocalProcess process;
        bool joined = false;
    };
    Error have_ended(const std::vector<std::string>& lines) const;
    Error have_not_joined(std::int64_t silent_ms) const;
    std::string name_of(const Member& member) const;

    std::vector<Member> processes_;
    std::size_t started_ = 0;
    bool starting_ = true;
    std::uint64_t fetched_ = 0;
    std::int64_t moved_ms_ = 0;  // when somebody joined or fetched last; 0: not yet watched
};

}  // namespace roboss
