// One thread: it waits, and sends if the role has not.
#include "dds/pulse.h"

#include <chrono>
#include <utility>

#include "bus/bus.h"

namespace roboss {

Pulse::Pulse(Send send, const Limits& limits)
    : send_(std::move(send)), limits_(limits), own_ms_(monotonic_ms()), thread_([this] { beat(); }) {}

Pulse::~Pulse() {
    {
        const std::lock_guard lock(mutex_);
        end_ = true;
    }
    ended_.notify_one();
    thread_.join();
}

void Pulse::beat() {
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(limits_.every_ms), [this] { return end_; })) {
        const std::int64_t now = monotonic_ms(), silent_ms = now - own_ms_;
        if (silent_ms >= limits_.every_ms && silent_ms < limits_.busy_most_ms) send_(now);
    }
}

}  // namespace roboss
