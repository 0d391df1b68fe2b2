#include "fastdds/notices.h"

#include <utility>

#include "core/printable.h"

namespace roboss::fastdds {
namespace {

constexpr std::size_t kMaxTold = 1000, kMaxWaiting = 100, kMaxLength = 1000;

std::string number_of(std::uint64_t messages) {
    return messages == 1 ? "a message was" : std::to_string(messages) + " messages were";
}

}  // namespace

void Notices::tell_once(const std::string& key, const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (lines_.size() >= kMaxWaiting || told_.size() >= kMaxTold) return;
    if (told_.insert(key.substr(0, kMaxLength)).second)
        lines_.push_back(printable_line(line.substr(0, kMaxLength)));
}

void Notices::count_dropped(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    ++dropped_.messages;
    dropped_.last = topic;
}

void Notices::count_unreadable(const std::string& topic, const std::string& why) {
    const std::lock_guard lock(mutex_);
    ++unreadable_.messages;
    unreadable_.last = "on " + topic.substr(0, kMaxLength) + ", " + why;
}

std::vector<std::string> Notices::take() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> lines = std::exchange(lines_, {});
    if (const Count lost = std::exchange(dropped_, {}); lost.messages > 0)
        lines.push_back(number_of(lost.messages) + " dropped, the last on " + printable_line(lost.last) +
                        ": they come faster than they are taken");
    if (const Count bad = std::exchange(unreadable_, {}); bad.messages > 0)
        lines.push_back(number_of(bad.messages) + " not understood, the last " + printable_line(bad.last));
    return lines;
}

}  // namespace roboss::fastdds
