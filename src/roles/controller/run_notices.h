// RunNotices: what happened in a run, one line each for its owner, and the error that ends the run.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/types.h"

namespace roboss {

class RunNotices {
  public:
    void add(std::string text) { lines_.push_back(std::move(text)); }
    /// Reports a refusal and its reason: equal ones once, and at most a hundred.
    void add_refusal(const std::string& what, const Error& why) {
        constexpr std::size_t kMost = 100;
        std::string line =
            what + " are refused: " + why.message + (why.code.empty() ? "" : " [" + why.code + "]");
        if (refusals_.size() < kMost && refusals_.insert(line).second) add(std::move(line));
    }
    /// An invalid message that was ignored at `tick`.
    void dropped(const char* message, Tick tick, const std::string& why) {
        add(std::string("dropped=") + message + " tick=" + std::to_string(tick) + " reason=\"" + why + "\"");
    }
    /// The run cannot continue. Only the first error counts. It is no line: who drives the run reports it.
    void fail(Error error) {
        if (!failure_) failure_ = std::move(error);
    }
    const std::optional<Error>& failure() const { return failure_; }
    /// The lines since the last call.
    std::vector<std::string> take() { return std::exchange(lines_, {}); }

  private:
    std::vector<std::string> lines_;
    std::set<std::string> refusals_;  // that were reported
    std::optional<Error> failure_;
};

}  // namespace roboss
