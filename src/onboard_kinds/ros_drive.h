// What the drives of gazebo_ros_pkgs (classic Gazebo) have in common: names of topics, where odometry comes
// from.
#pragma once

#include <string>
#include <string_view>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// Topics and odometry of a classic drive, in the dialects of ROS 1 and ROS 2.
struct RosDrive {
    std::string ros_namespace,            ///< ROS 2 `<ros><namespace>`, ROS 1 `<robotNamespace>`
        remapping,                        ///< ROS 2, the first `<remapping>`: "cmd_vel:=drive"
        command_topic;                    ///< ROS 1 `<commandTopic>`
    std::string odometry_frame = "odom",  ///< name of the frame
        base_frame = "base_footprint",    ///< name of the frame
        odometry_source = "1";            ///< "1" or "world": the true pose; "0" or "encoder": wheel angles
    double update_rate = 100;             ///< Hz
    bool publishes_odometry = false;      ///< for telemetry

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"ros_namespace", "ros/namespace|robotNamespace"}, s.ros_namespace);
        visit({"remapping", "ros/remapping"}, s.remapping);
        visit({"command_topic", "commandTopic"}, s.command_topic);
        visit({"odometry_frame", "odometry_frame|odometryFrame"}, s.odometry_frame);
        visit({"base_frame", "robot_base_frame|robotBaseFrame"}, s.base_frame);
        visit({"odometry_source", "odometry_source|odometrySource"}, s.odometry_source);
        visit({"update_rate", "update_rate|updateRate", "Hz"}, s.update_rate);
        visit({"publishes_odometry", "publish_odom|publishTf"}, s.publishes_odometry);
    }
    /// The channel of its velocity command: ROS names relate to the namespace.
    Channel command() const {
        std::string name = command_topic.empty() ? "cmd_vel" : command_topic;
        constexpr std::string_view kRule = "cmd_vel:=";
        if (remapping.starts_with(kRule)) name = remapping.substr(kRule.size());
        while (name.starts_with('/')) name.erase(0, 1);
        Channel channel = twist_channel("", name);
        channel.topic = "/" + name;
        if (!ros_namespace.empty())
            channel.topic = (ros_namespace.starts_with('/') ? "" : "/") + ros_namespace + channel.topic;
        return channel;
    }
    /// Whether odometry is that of the wheels.
    bool counts_wheels() const { return odometry_source == "0" || odometry_source == "encoder"; }
    /// Compares all members.
    friend bool operator==(const RosDrive&, const RosDrive&) = default;
};

/// Elements of the classic drives that have no effect.
inline constexpr IgnoredElement kRosIgnored[] = {
    {"publish_odom_tf", "0|false", "transforms belong to the bridge to ROS"},
    {"publishOdomTF", "0|false", "transforms belong to the bridge to ROS"},
    {"publish_wheel_tf", "0|false", "transforms belong to the bridge to ROS"},
    {"publishWheelTF", "0|false", "transforms belong to the bridge to ROS"},
    {"broadcastTF", "0|false", "transforms belong to the bridge to ROS"},
    {"publishWheelJointState", "0|false", "joint states belong to the bridge to ROS"},
    {"odometryTopic", "odom", "odometry is read from the robot's state"},
    {"covariance_x", "", "odometry has no covariance"},
    {"covariance_y", "", "odometry has no covariance"},
    {"covariance_yaw", "", "odometry has no covariance"}};

}  // namespace roboss
