// Notices: warnings about others, for the user, each of one line. Others can cause any number of them, so few
// wait at a time and each is reported once.
#pragma once

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace roboss::fastdds {

/// Safe to use from many threads.
class Notices {
  public:
    /// Keeps a line for take(), unless one with this key was reported before.
    void tell_once(const std::string& key, const std::string& line);
    /// Counts a message that is lost since nobody took it; `topic`: its own.
    void count_dropped(const std::string& topic);
    /// Counts a message that could not be read, and why.
    void count_unreadable(const std::string& topic, const std::string& why);
    /// Lines since the last call.
    std::vector<std::string> take();

  private:
    struct Count {
        std::uint64_t messages = 0;
        std::string last;  // topic, or why
    };

    std::mutex mutex_;
    std::set<std::string> told_;
    std::vector<std::string> lines_;
    Count dropped_, unreadable_;
};

}  // namespace roboss::fastdds
