// Heartbeats from a thread of their own: a role whose tick takes seconds sends nothing meanwhile, and would
// be taken for lost.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace roboss {

class Pulse {
  public:
    struct Limits {
        std::int64_t every_ms = 200;         // between two heartbeats, and from the role's last message
        std::int64_t busy_most_ms = 60'000;  // a role that is silent for longer hangs: the pulse ends with it
    };

    using Send = std::function<void(std::int64_t now_ms)>;

    /// Calls `send` in its thread.
    Pulse(Send send, const Limits& limits);
    ~Pulse();

    /// The role itself has sent a message there.
    void note_own(std::int64_t now_ms) { own_ms_ = now_ms; }

  private:
    void beat();

    const Send send_;
    const Limits limits_;
    std::atomic<std::int64_t> own_ms_;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool end_ = false;
    std::thread thread_;  // the last: it uses what stands above
};

}  // namespace roboss
