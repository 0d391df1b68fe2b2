// TopicOptions: the form of a Face's topics: names, frames, and topics that not everybody wants.
#pragma once

#include <string>

namespace roboss::ros2 {

/// See the top of the file.
struct TopicOptions {
    /// Frames without the robot's name, and "tf" and "tf_static" in its namespace, as Nav2 wants them.
    bool plain_frames = false;
    std::string root;           ///< robot that has no namespace, with plain frames: "/cmd_vel"; empty: none
    bool ground_truth = false;  ///< where each robot is, as "ground_truth" in its namespace
    bool fleet = false;         ///< all robots in one message: "/fleet/states"
    bool stamped = false;       ///< velocities are TwistStamped, until a node sends Twist
};

}  // namespace roboss::ros2
