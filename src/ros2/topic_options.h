// TopicOptions: the form of a Face's topics: names, frames, types, and topics that not everybody wants.
#pragma once

#include <memory>
#include <string>

#include "ros2/bridge_file.h"
#include "ros2/controllers_file.h"

namespace roboss::ros2 {

/// See the top of the file.
struct TopicOptions {
    /// Frames without the robot's name, and "tf" and "tf_static" in its namespace, as Nav2 wants them.
    bool plain_frames = false;
    std::string root;           ///< robot that has no namespace, with plain frames: "/cmd_vel"; empty: none
    bool ground_truth = false;  ///< where each robot is, as "ground_truth" in its namespace
    bool fleet = false;         ///< all robots in one message: "/fleet/states"
    bool stamped = false;       ///< velocities are TwistStamped, until a node sends Twist
    std::shared_ptr<const Bridge> bridge{};  ///< gives topics other names and types; null: none does
    std::shared_ptr<const Controllers> controllers{};  ///< of joints; null: the usual ones
};

}  // namespace roboss::ros2
