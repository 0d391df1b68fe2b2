// LocalProcess: another process of this program, started and ended by its id. It ends with its parent.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// "HOST/PID" of a process of this computer, for people.
std::string process_name(pid_t process);

class LocalProcess {
  public:
    /// What it prints goes to a log in memory.
    static Result<LocalProcess> start(const std::vector<std::string>& arguments);
    LocalProcess(LocalProcess&& other) noexcept;
    LocalProcess& operator=(LocalProcess&& other) noexcept;
    /// Kills it if it still runs.
    ~LocalProcess();

    pid_t id() const { return id_; }
    /// Sends SIGKILL; ended() reports the end later.
    void kill();
    /// How it ended, as text; nullopt while it runs.
    std::optional<std::string> ended();
    /// Its exit code; nullopt while it runs, and if a signal ended it.
    std::optional<int> exit_code();
    /// Waits for its end, at most so long. False: it still runs.
    bool wait(int ms_max);
    /// Its state, as text: "running", "stopped ..." ...
    std::string doing() const;
    /// The end of its log, at most so many lines.
    std::string last_lines(std::size_t count) const;
    /// The whole lines that it printed since the last call.
    std::vector<std::string> new_lines();

  private:
    LocalProcess(pid_t id, int log) : id_(id), log_(log) {}
    pid_t id_ = -1;
    int log_ = -1;
    std::int64_t read_ = 0;      // bytes of the log that new_lines() has returned
    std::optional<int> status_;  // as waitpid() gave it; nullopt: it runs
};

}  // namespace roboss
