// A controller of wheels of a file of ros2_control, as plain data: the on-board controller that it becomes,
// and what ROS 2 nodes see of it.
#pragma once

#include <array>
#include <string>

#include "onboard_kinds/onboard_spec.h"

namespace roboss::ros2 {

/// The diagonal of the covariance of a pose or twist: x, y, z (m or m/s), then about x, y, z (rad or rad/s),
/// squared.
using CovarianceDiagonal = std::array<double, 6>;

/// A drive of ros2_control, as its parameters describe it.
struct DriveController {
    OnboardParameters parameters;  ///< wheels, sizes and limits; one of the drives (onboard_kinds)
    std::string command,           ///< topic of the velocity, below the robot's name: "base/cmd_vel"
        odometry;                  ///< likewise, of nav_msgs/msg/Odometry: "base/odom"
    bool stamped = true;           ///< the velocity is TwistStamped, until a node sends Twist
    double timeout_s = 0.5,        ///< s without a command after which the robot stops; 0: it drives on
        odometry_rate_hz = 50;     ///< Hz
    std::string odometry_frame,    ///< of the poses
        base_frame;                ///< that it names for the base; empty: none
    int base_frame_line = 0;       ///< of that in the file, from 1
    bool publishes_base = true;    ///< with plain frames, where the base stands in the odometry's frame
    CovarianceDiagonal pose_covariance{},  ///< of the odometry's poses
        twist_covariance{};                ///< of its velocities
};

}  // namespace roboss::ros2
