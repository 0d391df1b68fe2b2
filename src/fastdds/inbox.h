// Inbox: messages and requests that have arrived and wait until the program takes them. Threads of Fast DDS
// put them in; others decide how many come, so there is an end to how many wait.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "ros2_types/transport.h"

namespace roboss::fastdds {

/// Safe to use from many threads.
class Inbox {
  public:
    /// Limits of all entities together.
    struct Limits {
        std::size_t messages = 20'000;  ///< that wait
        std::size_t bytes = 256 << 20;  ///< of the messages that wait
    };

    explicit Inbox(const Limits& limits) : limits_(limits) {}
    Inbox() : Inbox(Limits{}) {}

    /// Adds a message. If `depth` messages of its entity wait already, the oldest of them goes. False: a
    /// message was lost, this one or the oldest.
    bool put(ros2::Incoming message, std::size_t depth);
    /// Lets take() return soon, with nothing if nothing is there.
    void wake();
    /// Calls `ring` in the thread that puts or wakes.
    void on_arrival(std::function<void()> ring);
    /// Removes what waits of an entity.
    void forget(ros2::EntityId entity);
    /// All messages, in the order of their arrival; waits for the first, or wake(), at most so long.
    std::vector<ros2::Incoming> take(std::int64_t wait_ms);

  private:
    struct Item {
        std::uint64_t order = 0;
        ros2::Incoming message;
    };

    void drop_oldest(std::deque<Item>& queue);

    Limits limits_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unordered_map<ros2::EntityId, std::deque<Item>> queues_;
    std::uint64_t order_ = 0;
    std::size_t messages_ = 0, bytes_ = 0;
    bool is_woken_ = false;
    std::function<void()> ring_ = [] {};
};

}  // namespace roboss::fastdds
