// RunWaits: what services wait for: answers of the run, and conditions. Nothing blocks; each wait ends in a
// later turn with its result, or because it took too long.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "ros2/run_control.h"

namespace roboss::ros2 {

/// See the top of the file.
class RunWaits {
  public:
    /// The longest that a request may take that the run answers at once, ms.
    static constexpr std::int64_t kPatience_ms = 10'000;
    /// The longest that a request may take for which the run reads files, ms.
    static constexpr std::int64_t kLong_ms = 60'000;

    /// `run` outlives it.
    explicit RunWaits(RunControl& run) : run_(run) {}

    /// Sends a request; `then` gets the answer, or a refusal "no-answer" after `patience_ms`.
    void ask(ControlAction action, RunControl::Done then, std::int64_t patience_ms = kPatience_ms);
    /// Asks for the status; `then` gets null if there is no answer.
    void ask_status(std::function<void(const RunStatus*)> then);
    /// Calls `then` with true once the condition holds, or with false after `patience_ms`.
    void until(std::function<bool()> condition, std::function<void(bool)> then,
               std::int64_t patience_ms = kPatience_ms);
    /// Calls `then` some time later.
    void after(std::int64_t delay_ms, std::function<void()> then);
    /// Lets one of those go on that change which robots there are: `begin` is called when the others that
    /// came before are over. It calls the function that it gets when it is over itself.
    void in_turn(std::function<void(std::function<void()> over)> begin);

    /// Ends the waits that are over.
    void advance(std::int64_t now_ms);

  private:
    struct Wait {
        std::function<bool()> condition;
        std::function<void(bool)> then;
        std::int64_t until_ms = 0;
    };
    void begin_next();

    RunControl& run_;
    std::int64_t now_ms_ = 0;
    std::vector<Wait> waits_;
    std::deque<std::function<void(std::function<void()>)>> queue_;
    bool busy_ = false;
};

}  // namespace roboss::ros2
