// Interfaces of ROS 2 that others are made of: builtin_interfaces, std_msgs, rosgraph_msgs, geometry_msgs,
// tf2_msgs. A message states its name and its fields, in the order of its definition; encoding, type hash and
// definition text follow from these (ros2_types/cdr.h, ros2_types/type_description.h). Units and frames are
// those of REP 103: SI, radians, x ahead, y left, z up. Source of names and order: the public definitions of
// ROS 2.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ros2_types/field_types.h"

namespace roboss::ros2 {

/// builtin_interfaces/msg/Time
struct Time {
    static constexpr const char* kName = "builtin_interfaces/msg/Time";
    std::int32_t sec = 0;       ///< s
    std::uint32_t nanosec = 0;  ///< ns, below 10^9

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("sec", m.sec);
        visit("nanosec", m.nanosec);
    }
};

/// std_msgs/msg/Header
struct Header {
    static constexpr const char* kName = "std_msgs/msg/Header";
    Time stamp;            ///< of the measurement, simulated time
    std::string frame_id;  ///< in whose axes the values are

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("stamp", m.stamp);
        visit("frame_id", m.frame_id);
    }
};

/// std_msgs/msg/String
struct String {
    static constexpr const char* kName = "std_msgs/msg/String";
    std::string data;  ///< the text

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// rosgraph_msgs/msg/Clock
struct Clock {
    static constexpr const char* kName = "rosgraph_msgs/msg/Clock";
    Time clock;  ///< simulated time

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("clock", m.clock);
    }
};

/// geometry_msgs/msg/Vector3
struct Vector3 {
    static constexpr const char* kName = "geometry_msgs/msg/Vector3";
    double x = 0, y = 0, z = 0;  ///< in the unit of what they are

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("x", m.x);
        visit("y", m.y);
        visit("z", m.z);
    }
};

/// geometry_msgs/msg/Point
struct Point {
    static constexpr const char* kName = "geometry_msgs/msg/Point";
    double x = 0, y = 0, z = 0;  ///< m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("x", m.x);
        visit("y", m.y);
        visit("z", m.z);
    }
};

/// geometry_msgs/msg/Quaternion
struct Quaternion {
    static constexpr const char* kName = "geometry_msgs/msg/Quaternion";
    double x = 0, y = 0, z = 0, w = 1;  ///< a unit quaternion

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("x", m.x);
        visit("y", m.y);
        visit("z", m.z);
        visit("w", m.w);
    }
};

/// geometry_msgs/msg/Pose
struct PoseMessage {
    static constexpr const char* kName = "geometry_msgs/msg/Pose";
    Point position;          ///< m
    Quaternion orientation;  ///< from its own axes to those of the frame

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("position", m.position);
        visit("orientation", m.orientation);
    }
};

/// geometry_msgs/msg/PoseWithCovariance
struct PoseWithCovariance {
    static constexpr const char* kName = "geometry_msgs/msg/PoseWithCovariance";
    PoseMessage pose;                     ///< m
    std::array<double, 36> covariance{};  ///< rows of x, y, z, and rotations about X, Y, Z; m, rad

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("pose", m.pose);
        visit("covariance", m.covariance);
    }
};

/// geometry_msgs/msg/PoseArray
struct PoseArray {
    static constexpr const char* kName = "geometry_msgs/msg/PoseArray";
    Header header;                   ///< time and frame
    std::vector<PoseMessage> poses;  ///< m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("poses", m.poses);
    }
};

/// geometry_msgs/msg/PoseStamped
struct PoseStamped {
    static constexpr const char* kName = "geometry_msgs/msg/PoseStamped";
    Header header;     ///< time and frame
    PoseMessage pose;  ///< m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("pose", m.pose);
    }
};

/// geometry_msgs/msg/Twist
struct TwistMessage {
    static constexpr const char* kName = "geometry_msgs/msg/Twist";
    Vector3 linear,  ///< m/s
        angular;     ///< rad/s

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("linear", m.linear);
        visit("angular", m.angular);
    }
};

/// geometry_msgs/msg/TwistWithCovariance
struct TwistWithCovariance {
    static constexpr const char* kName = "geometry_msgs/msg/TwistWithCovariance";
    TwistMessage twist;                   ///< m/s, rad/s
    std::array<double, 36> covariance{};  ///< rows of x, y, z, and rotations about X, Y, Z; m/s, rad/s

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("twist", m.twist);
        visit("covariance", m.covariance);
    }
};

/// geometry_msgs/msg/Wrench
struct WrenchMessage {
    static constexpr const char* kName = "geometry_msgs/msg/Wrench";
    Vector3 force,  ///< N
        torque;     ///< N m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("force", m.force);
        visit("torque", m.torque);
    }
};

/// geometry_msgs/msg/WrenchStamped
struct WrenchStamped {
    static constexpr const char* kName = "geometry_msgs/msg/WrenchStamped";
    Header header;         ///< time and frame
    WrenchMessage wrench;  ///< N, N m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("wrench", m.wrench);
    }
};

/// geometry_msgs/msg/Transform
struct TransformMessage {
    static constexpr const char* kName = "geometry_msgs/msg/Transform";
    Vector3 translation;  ///< m
    Quaternion rotation;  ///< from the child's axes to the parent's

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("translation", m.translation);
        visit("rotation", m.rotation);
    }
};

/// geometry_msgs/msg/TransformStamped
struct TransformStamped {
    static constexpr const char* kName = "geometry_msgs/msg/TransformStamped";
    Header header;               ///< time, and the parent frame
    std::string child_frame_id;  ///< the child frame
    TransformMessage transform;  ///< of the child in the parent

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("child_frame_id", m.child_frame_id);
        visit("transform", m.transform);
    }
};

/// tf2_msgs/msg/TFMessage
struct TFMessage {
    static constexpr const char* kName = "tf2_msgs/msg/TFMessage";
    std::vector<TransformStamped> transforms;  ///< a tree: each child has one parent

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("transforms", m.transforms);
    }
};

}  // namespace roboss::ros2
