// See run_waits.h.
#include "ros2/run_waits.h"

#include <optional>
#include <utility>

namespace roboss::ros2 {

void RunWaits::ask(ControlAction action, RunControl::Done then, std::int64_t patience_ms) {
    const auto answer = std::make_shared<std::optional<ControlOutcome>>();
    run_.request(std::move(action), [answer](const ControlOutcome& outcome) { *answer = outcome; });
    until([answer] { return answer->has_value(); },
          [answer, then = std::move(then)](bool has_come) {
              then(has_come
                       ? **answer
                       : ControlOutcome(ControlRefused(Error{"the run did not answer in time",
                                                             "see whether it is still there", "no-answer"})));
          },
          patience_ms);
}

void RunWaits::ask_status(std::function<void(const RunStatus*)> then) {
    ask(GetStatus{},
        [then = std::move(then)](const ControlOutcome& outcome) { then(std::get_if<RunStatus>(&outcome)); });
}

void RunWaits::until(std::function<bool()> condition, std::function<void(bool)> then,
                     std::int64_t patience_ms) {
    waits_.push_back({std::move(condition), std::move(then), now_ms_ + patience_ms});
}

void RunWaits::after(std::int64_t delay_ms, std::function<void()> then) {
    until([] { return false; }, [then = std::move(then)](bool) { then(); }, delay_ms);
}

void RunWaits::in_turn(std::function<void(std::function<void()>)> begin) {
    queue_.push_back(std::move(begin));
    begin_next();
}

void RunWaits::begin_next() {
    if (busy_ || queue_.empty()) return;
    busy_ = true;
    const auto begin = std::move(queue_.front());
    queue_.pop_front();
    begin([this] {
        busy_ = false;
        begin_next();
    });
}

void RunWaits::advance(std::int64_t now_ms) {
    now_ms_ = now_ms;
    // Those that begin meanwhile are looked at in the next turn.
    for (Wait& wait : std::exchange(waits_, {})) {
        const bool holds = wait.condition();
        if (holds || now_ms >= wait.until_ms)
            wait.then(holds);
        else
            waits_.push_back(std::move(wait));
    }
}

}  // namespace roboss::ros2
