// See companion.h.
#include "app/processes/companion.h"

#include <utility>

namespace roboss {

namespace {

constexpr std::int64_t kNotAgainBefore_ms = 1'000;
constexpr std::size_t kLastLines = 5;

}  // namespace

Result<> Companion::start(std::int64_t now_ms) {
    started_ms_ = now_ms;
    Result<LocalProcess> started = LocalProcess::start(arguments_);
    if (!started) return started.error();
    process_ = std::move(started).value();
    return Ok{};
}

Result<> Companion::look(std::int64_t now_ms) {
    if (!process_) return Ok{};
    const std::optional<std::string> how = process_->ended();
    if (!how) return Ok{};
    if (process_->exit_code() == 1)  // its options or this computer are wrong: it would end again
        return Error{what_ + " could not run: " + process_->last_lines(kLastLines), "see the message above",
                     "companion-ended"};
    if (now_ms - started_ms_ < kNotAgainBefore_ms) return Ok{};
    for (std::string& line : process_->new_lines()) notices_.push_back(std::move(line));
    notices_.push_back(what_ + " " + *how + "; it is started again [restarted]");
    return start(now_ms);
}

std::vector<std::string> Companion::take_notices() {
    if (process_)
        for (std::string& line : process_->new_lines()) notices_.push_back(std::move(line));
    return std::exchange(notices_, {});
}

void Companion::await_exit(std::int64_t ms_max) {
    if (!process_) return;
    (void)process_->wait(static_cast<int>(ms_max));
    process_.reset();
}

}  // namespace roboss
