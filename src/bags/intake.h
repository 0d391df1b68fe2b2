// Intake: what the readers of all formats do with the topics and messages of a file.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bags/bag.h"

namespace roboss::bags {

class Intake {
  public:
    static constexpr std::uint64_t kLatest_ns = 4'000'000'000'000'000'000;  // year 2096
    static constexpr std::int64_t kNoTime = std::numeric_limits<std::int64_t>::max();

    Intake(std::string file, Sink& sink) : file_(std::move(file)), sink_(sink) {}

    const std::string& file() const { return file_; }
    /// Adds a topic, and returns its index.
    std::size_t add_topic(std::string name, std::string type, std::string encoding) {
        Entry entry{{file_, std::move(name), std::move(type), std::move(encoding)}};
        entry.wanted = sink_.wants(entry.topic);
        topics_.push_back(std::move(entry));
        return topics_.size() - 1;
    }
    std::size_t topic_count() const { return topics_.size(); }
    bool is_wanted(std::size_t topic) const { return topics_[topic].wanted; }
    /// Notes the time of a message, and hands the message on if it is wanted.
    Result<> add(std::size_t topic, std::uint64_t log_ns, Bytes bytes) {
        Entry& entry = topics_[topic];
        ++entry.messages;
        if (log_ns > kLatest_ns)
            return Error{"message " + std::to_string(entry.messages) + " of " + entry.topic.name +
                             " has the log time " + std::to_string(log_ns) + " ns",
                         "log times are from 0 to 4e18 ns", "bad-time"};
        earliest_ns_ = std::min(earliest_ns_, static_cast<std::int64_t>(log_ns));
        if (!entry.wanted) return Ok{};
        return sink_.take(entry.topic, {static_cast<std::int64_t>(log_ns), entry.messages, bytes});
    }
    /// kNoTime: there are no messages.
    std::int64_t earliest_ns() const { return earliest_ns_; }

  private:
    struct Entry {
        Topic topic;
        bool wanted = false;
        std::uint64_t messages = 0;  // so far
    };

    std::string file_;
    Sink& sink_;
    std::vector<Entry> topics_;
    std::int64_t earliest_ns_ = kNoTime;
};

}  // namespace roboss::bags
