// Lockstep: holds the world until nodes have answered. Each period of a synchronous Client needs one message
// of each named topic; a period's messages become orders in the order of their topics, however they arrived.
// So the same nodes give the same run, on any machine and at any load.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "ros2/robot_commands.h"

namespace roboss::ros2 {

/// See the top of the file.
class Lockstep {
  public:
    /// Waits for the topics that match a pattern (* and ? do not match slashes). An Error names a pattern
    /// that no topic matches.
    static Result<Lockstep> of(const std::vector<std::string>& patterns, const RobotCommands& commands);

    /// A period begins whose sensors bear this stamp, ns. Messages that came too early count for it.
    void begin(std::int64_t stamp_ns);
    /// The run went back: messages that arrived do not count.
    void forget();
    /// A message of a topic arrived. `stamp_ns`: its own stamp, if it has one that is not 0. False: nobody
    /// waits for this topic, and the message must not have an effect.
    bool take(std::size_t topic, std::string bytes, std::optional<std::int64_t> stamp_ns);
    /// True if every topic has its message of this period.
    bool is_complete() const { return open_ == 0; }
    /// All topics that it waits for, in RobotCommands::topics().
    std::vector<std::size_t> topics() const;
    /// Topics that still lack it.
    std::vector<std::size_t> missing() const;

    /// A message of the period.
    struct Accepted {
        std::size_t topic = 0;  ///< in RobotCommands::topics()
        std::string bytes;      ///< CDR
    };
    /// The messages of the period, by topic. Only once it is complete.
    std::vector<Accepted> accepted();

    /// Messages so far that came more than once in a period, or between two, and wait for the next ones.
    std::uint64_t early() const { return early_; }
    /// Messages so far that answered to a period that has its message, or for which there was no room.
    std::uint64_t dropped() const { return dropped_; }

  private:
    struct Waiting {
        std::string bytes;
        std::optional<std::int64_t> stamp_ns;
    };
    struct Gate {
        std::size_t topic = 0;
        std::optional<std::string> message;  // of this period
        std::deque<Waiting> next;            // for later periods
    };
    void fill(Gate& gate);

    std::vector<Gate> gates_;          // by topic
    std::vector<std::size_t> places_;  // of topics in gates_; kNowhere: nobody waits for it
    static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
    std::int64_t stamp_ns_ = 0;
    bool is_collecting_ = false;  // from begin() to accepted(); else messages wait for the next period
    std::size_t open_ = 0, waiting_bytes_ = 0;
    std::uint64_t early_ = 0, dropped_ = 0;
};

}  // namespace roboss::ros2
