// KeepLast: a queue of the messages of many topics, of each of which it keeps the last few. What is too much
// goes from the front, so a slow reader loses old messages and costs a bounded amount of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <utility>

namespace roboss::foxglove {

/// See the top of the file. `T` has size(), in bytes.
template <class T>
class KeepLast {
  public:
    /// Adds an item; where the topic has `depth` items already, its oldest one goes. A depth of 0 counts
    /// as 1.
    void push(std::uint64_t topic, std::size_t depth, T item) {
        std::deque<Place>& places = places_[topic];
        while (!places.empty() && places.size() >= depth) {
            drop(places.front());
            places.pop_front();
            ++dropped_;
        }
        bytes_ += item.size();
        places.push_back(items_.insert(items_.end(), {topic, std::move(item)}));
    }
    /// Takes the oldest item; nothing if there is none.
    std::optional<T> take() {
        if (items_.empty()) return std::nullopt;
        T item = std::move(items_.front().second);
        bytes_ -= item.size();
        forget_front();
        return item;
    }
    /// Drops the oldest item, which exists.
    void drop_oldest() {
        bytes_ -= items_.front().second.size();
        forget_front();
        ++dropped_;
    }
    /// Drops all items of a topic; they do not count as dropped.
    void forget(std::uint64_t topic) {
        const auto found = places_.find(topic);
        if (found == places_.end()) return;
        for (const Place place : found->second) drop(place);
        places_.erase(found);
    }

    bool empty() const { return items_.empty(); }
    /// Limits of all items together.
    std::size_t bytes() const { return bytes_; }
    /// How many items of a topic wait.
    std::size_t waiting(std::uint64_t topic) const {
        const auto found = places_.find(topic);
        return found == places_.end() ? 0 : found->second.size();
    }
    /// Items so far that went unread.
    std::uint64_t dropped() const { return dropped_; }

  private:
    using Items = std::list<std::pair<std::uint64_t, T>>;
    using Place = typename Items::iterator;

    void drop(Place place) {
        bytes_ -= place->second.size();
        items_.erase(place);
    }
    void forget_front() {
        const auto topic = places_.find(items_.front().first);
        topic->second.pop_front();
        if (topic->second.empty()) places_.erase(topic);
        items_.pop_front();
    }

    Items items_;                                        // by age
    std::map<std::uint64_t, std::deque<Place>> places_;  // in items_, by topic and age
    std::size_t bytes_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace roboss::foxglove
