// The YAML file of ros_gz_bridge, as plain data: which topic of Gazebo has which name and type in ROS 2.
// bridge.h finds what they are in a world.
//
// Keys and defaults are those of ros_gz_bridge, also the older ones (ign_topic_name, IGN_TO_ROS). Where it
// skips an entry that it cannot read, here the file is refused.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace roboss::ros2 {

/// An entry: a topic, or a service.
struct BridgeEntry {
    /// Where messages go.
    enum class Direction {
        kBoth,     ///< BIDIRECTIONAL, the default
        kToRos,    ///< GZ_TO_ROS
        kToGazebo  ///< ROS_TO_GZ
    };
    std::string ros_name,     ///< "/car/scan"; absolute
        gz_name,              ///< "/lidar"; as gazebo_name() writes it
        type;                 ///< in ROS 2: "sensor_msgs/msg/LaserScan"
    Direction direction{};    ///< of a topic
    bool is_service = false;  ///< its name is both ros_name and gz_name
    int line = 0;             ///< in the file, from 1
};

/// A file.
struct Bridge {
    std::string file;                  ///< its path, for messages
    std::vector<BridgeEntry> entries;  ///< in the order of the file
    std::vector<std::string> notices;  ///< keys that have no effect, one line each
};

/// The name of a topic as gz-transport writes it: "lidar" is "/lidar".
std::string gazebo_name(const std::string& name);

/// Reads the text of a file. An Error names file and line.
Result<Bridge> parse_bridge(const std::string& file, const std::string& text);

/// Reads a file of at most 1 MB.
Result<Bridge> read_bridge(const std::filesystem::path& file);

}  // namespace roboss::ros2
