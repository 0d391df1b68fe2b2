// See lockstep.h.
#include "ros2/lockstep.h"

#include <fnmatch.h>

#include <utility>

namespace roboss::ros2 {

namespace {

constexpr std::size_t kWaitingMost = 100;                          // messages of a topic for later periods
constexpr std::size_t kWaitingBytesMost = std::size_t{256} << 20;  // of all topics

}  // namespace

Result<Lockstep> Lockstep::of(const std::vector<std::string>& patterns, const RobotCommands& commands) {
    Lockstep lockstep;
    lockstep.places_.assign(commands.topics().size(), kNowhere);
    for (const std::string& pattern : patterns) {
        bool matches = false;
        for (std::size_t t = 0; t < commands.topics().size(); ++t) {
            if (fnmatch(pattern.c_str(), commands.topics()[t].name.c_str(), FNM_PATHNAME) != 0) continue;
            matches = true;
            lockstep.places_[t] = 0;
        }
        if (!matches)
            return Error{"no robot is driven by a topic '" + pattern + "'",
                         "`roboss ros2 --list` prints the topics of this world", "no-topic"};
    }
    for (std::size_t t = 0; t < lockstep.places_.size(); ++t) {
        if (lockstep.places_[t] == kNowhere) continue;
        lockstep.places_[t] = lockstep.gates_.size();
        lockstep.gates_.push_back({t, {}, {}});
    }
    return lockstep;
}

void Lockstep::begin(std::int64_t stamp_ns) {
    stamp_ns_ = stamp_ns, is_collecting_ = true;
    open_ = gates_.size();
    for (Gate& gate : gates_) {
        gate.message.reset();
        fill(gate);
    }
}

void Lockstep::forget() {
    is_collecting_ = false;
    for (Gate& gate : gates_) gate.message.reset(), gate.next.clear();
    waiting_bytes_ = 0;
}

/// Gives a gate that is open the first message that waits for this period.
void Lockstep::fill(Gate& gate) {
    while (is_collecting_ && !gate.message && !gate.next.empty()) {
        Waiting& first = gate.next.front();
        if (first.stamp_ns && *first.stamp_ns > stamp_ns_) return;
        waiting_bytes_ -= first.bytes.size();
        if (first.stamp_ns && *first.stamp_ns < stamp_ns_)
            ++dropped_;
        else
            gate.message = std::move(first.bytes), --open_;
        gate.next.pop_front();
    }
}

bool Lockstep::take(std::size_t topic, std::string bytes, std::optional<std::int64_t> stamp_ns) {
    if (places_[topic] == kNowhere) return false;
    Gate& gate = gates_[places_[topic]];
    const bool is_crowded = waiting_bytes_ + bytes.size() > kWaitingBytesMost;  // each topic has room for one
    if (gate.next.size() >= kWaitingMost || (is_crowded && !gate.next.empty())) return ++dropped_, true;
    if (gate.message && stamp_ns == stamp_ns_) return ++dropped_, true;  // the same answer once more
    if (gate.message || !is_collecting_) ++early_;
    waiting_bytes_ += bytes.size();
    gate.next.push_back({std::move(bytes), stamp_ns});
    fill(gate);
    return true;
}

std::vector<std::size_t> Lockstep::topics() const {
    std::vector<std::size_t> topics;
    for (const Gate& gate : gates_) topics.push_back(gate.topic);
    return topics;
}

std::vector<std::size_t> Lockstep::missing() const {
    std::vector<std::size_t> topics;
    for (const Gate& gate : gates_)
        if (!gate.message) topics.push_back(gate.topic);
    return topics;
}

std::vector<Lockstep::Accepted> Lockstep::accepted() {
    is_collecting_ = false;
    std::vector<Accepted> all;
    for (Gate& gate : gates_) all.push_back({gate.topic, std::exchange(gate.message, {}).value_or("")});
    return all;
}

}  // namespace roboss::ros2
