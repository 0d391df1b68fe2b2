#include "fastdds/inbox.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace roboss::fastdds {

bool Inbox::put(ros2::Incoming message, std::size_t depth) {
    {
        const std::lock_guard lock(mutex_);
        std::deque<Item>& queue = queues_[message.entity];
        const bool is_full = !queue.empty() && queue.size() >= depth;
        if (is_full) drop_oldest(queue);
        if (messages_ >= limits_.messages || message.bytes.size() > limits_.bytes - bytes_) return false;
        ++messages_;
        bytes_ += message.bytes.size();
        queue.push_back({order_++, std::move(message)});
        ring_();
        if (is_full) return false;
    }
    changed_.notify_one();
    return true;
}

void Inbox::wake() {
    {
        const std::lock_guard lock(mutex_);
        is_woken_ = true;
        ring_();
    }
    changed_.notify_one();
}

void Inbox::on_arrival(std::function<void()> ring) {
    const std::lock_guard lock(mutex_);
    ring_ = std::move(ring);
}

void Inbox::forget(ros2::EntityId entity) {
    const std::lock_guard lock(mutex_);
    const auto at = queues_.find(entity);
    if (at == queues_.end()) return;
    while (!at->second.empty()) drop_oldest(at->second);
    queues_.erase(at);
}

std::vector<ros2::Incoming> Inbox::take(std::int64_t wait_ms) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(wait_ms), [&] { return messages_ > 0 || is_woken_; });
    is_woken_ = false;
    std::vector<Item> items;
    items.reserve(messages_);
    for (auto& [entity, queue] : queues_) std::move(queue.begin(), queue.end(), std::back_inserter(items));
    queues_.clear();
    messages_ = bytes_ = 0;
    lock.unlock();
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.order < b.order; });
    std::vector<ros2::Incoming> messages;
    messages.reserve(items.size());
    for (Item& item : items) messages.push_back(std::move(item.message));
    return messages;
}

void Inbox::drop_oldest(std::deque<Item>& queue) {
    --messages_;
    bytes_ -= queue.front().message.bytes.size();
    queue.pop_front();
}

}  // namespace roboss::fastdds
