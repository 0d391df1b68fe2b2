// Companion: a process of this program that stands beside a run, and is started again when it ends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/processes/local_process.h"
#include "core/result.h"

namespace roboss {

class Companion {
  public:
    /// `what`: for messages, "the ROS 2 process"; `arguments`: of `roboss`.
    Companion(std::string what, std::vector<std::string> arguments)
        : what_(std::move(what)), arguments_(std::move(arguments)) {}

    Result<> start(std::int64_t now_ms);
    /// To be called now and then. Starts it again if it has ended; an Error: it refuses to run.
    Result<> look(std::int64_t now_ms);
    /// Lines that it printed since the last call, and that it was started again.
    std::vector<std::string> take_notices();
    /// Waits until it has ended by itself, at most so long; then kills it.
    void await_exit(std::int64_t ms_max);

  private:
    std::string what_;
    std::vector<std::string> arguments_;
    std::optional<LocalProcess> process_;
    std::int64_t started_ms_ = 0;
    std::vector<std::string> notices_;
};

}  // namespace roboss
