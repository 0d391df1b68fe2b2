// Bags: recordings of ROS 2, as MCAP files or SQLite files (.db3), alone or in the folder of a rosbag2. Their
// bytes come from anywhere: nothing in them is believed before it is checked.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/diagnostics.h"
#include "core/result.h"

namespace roboss::bags {

using Bytes = std::span<const std::uint8_t>;

/// A topic of a file.
struct Topic {
    std::string file;      ///< path of the file
    std::string name;      ///< "/car_3/cmd_vel"
    std::string type;      ///< "geometry_msgs/msg/Twist"; empty: the file does not say
    std::string encoding;  ///< "cdr"
};

/// A message of a topic.
struct Message {
    std::int64_t log_ns = 0;   ///< when it was recorded: 0 to 4e18
    std::uint64_t number = 0;  ///< among those of its topic in the file, from 1
    Bytes bytes;               ///< in the encoding of its topic; valid until take() returns
};

/// Gets the messages of a bag.
class Sink {
  public:
    virtual ~Sink() = default;
    /// True if take() shall get the messages of this topic. Asked for each topic of each file, and more than
    /// once where a file lists a topic for each publisher.
    virtual bool wants(const Topic& topic) = 0;
    /// A message, in the order of the file. An Error ends reading.
    virtual Result<> take(const Topic& topic, const Message& message) = 0;
};

/// True for a folder, and for a file that is a bag by its first bytes (MCAP, SQLite, also packed, or a bag
/// of ROS 1) or by its name.
bool is_bag(const std::string& path);

/// Hands the messages of a bag to the sink. Of a folder it reads all files that end in .mcap, or all that end
/// in .db3, in the natural order of their names; its metadata.yaml is not read, so it may be missing or
/// outdated. What is wrong with a file is a diagnostic; an error ends reading. Returns the earliest log time
/// of all messages, ns, also of those that are not wanted; none: there are no messages.
std::optional<std::int64_t> read_bag(const std::string& path, Sink& sink, Diagnostics& diagnostics);

}  // namespace roboss::bags
