// See ready_flags.h.
#include "core/ready_flags.h"

#include <atomic>
#include <thread>

namespace roboss {

void ReadyFlags::clear(std::size_t count) {
    if (rounds_.size() < count) rounds_.resize(count, 0);
    ++round_;
}

void ReadyFlags::set(std::size_t flag) {
    std::atomic_ref(rounds_[flag]).store(round_, std::memory_order_release);
}

void ReadyFlags::wait_for(std::size_t flag) {
    constexpr int kPatience = 4000;  // some microseconds
    const std::atomic_ref round(rounds_[flag]);
    for (int i = 0; round.load(std::memory_order_acquire) != round_; ++i)
        if (i >= kPatience) std::this_thread::yield();
}

}  // namespace roboss
