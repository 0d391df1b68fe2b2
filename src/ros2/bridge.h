// Matches the entries of a bridge's file with the topics of a world. What is matched gets the name and type
// of its entry in ROS 2; RobotTopics and RobotCommands take them from here. What no entry names keeps its
// usual name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ros2/bridge_file.h"
#include "ros2/gazebo_topics.h"

namespace roboss::ros2 {

/// A topic that an entry names.
struct BridgedTopic {
    GazeboTopic topic;                  ///< the thing here
    std::string name;                   ///< in ROS 2: "/scan"
    const MessageType* type = nullptr;  ///< of its messages, one of topic.types
};

/// The meaning of a file in a world.
struct BridgeMatch {
    std::vector<BridgedTopic> topics;  ///< in the order of the file; no two are equal
    std::set<std::string> names;       ///< of these topics
    /// Entries that have no effect, one line each: file, line, why, and what there is instead.
    std::vector<std::string> notices;
};

/// See the top of the file.
BridgeMatch match_bridge(const Bridge& bridge, const Model& model);

}  // namespace roboss::ros2
