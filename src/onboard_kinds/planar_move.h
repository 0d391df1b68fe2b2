// libgazebo_ros_planar_move.so of classic Gazebo: moves a free body in the plane as commanded.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/ros_drive.h"

namespace roboss {

/// Velocities are in the axes of the robot's frame, turned about z only. Before the first command they are
/// zero.
struct PlanarMoveSpec {
    RosDrive ros;         ///< topics, odometry
    double timeout = -1;  ///< s: older commands count as zero; negative: never

    /// Elements of the original without effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"publish_odom_tf", "0|false", "transforms belong to the bridge to ROS"},
        {"publish_rate", "", "telemetry chooses the rate"},
        {"odometryRate", "", "telemetry chooses the rate"},
        {"odometryTopic", "odom", "odometry is read from the robot's state"},
        {"covariance_x", "", "odometry has no covariance"},
        {"covariance_y", "", "odometry has no covariance"},
        {"covariance_yaw", "", "odometry has no covariance"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 34,
                                       .name = "planar-move",
                                       .phrase = "a planar move",
                                       .classes = "",
                                       .files = "gazebo_ros_planar_move",
                                       .ignored = kIgnored,
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        RosDrive::parameters(visit, s.ros);
        visit({"timeout", "cmdTimeout", "s"}, s.timeout);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const { return {ros.command()}; }
    /// Its memory at the start: the odometry.
    std::vector<double> memory() const { return std::vector<double>(5, 0.0); }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const PlanarMoveSpec&, const PlanarMoveSpec&) = default;
};

}  // namespace roboss
