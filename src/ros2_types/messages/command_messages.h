// Interfaces of ROS 2 by which programs drive robots: values of std_msgs, velocities of geometry_msgs,
// trajectory_msgs. See standard_messages.h.
#pragma once

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

/// builtin_interfaces/msg/Duration
struct Duration {
    static constexpr const char* kName = "builtin_interfaces/msg/Duration";
    std::int32_t sec = 0;       ///< s
    std::uint32_t nanosec = 0;  ///< ns, below 10^9; added to sec

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("sec", m.sec);
        visit("nanosec", m.nanosec);
    }
};

/// std_msgs/msg/Empty
struct Empty {
    static constexpr const char* kName = "std_msgs/msg/Empty";
    std::uint8_t placeholder = 0;  ///< a message has at least one byte

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit(kNoField, m.placeholder);
    }
};

/// std_msgs/msg/Bool
struct Bool {
    static constexpr const char* kName = "std_msgs/msg/Bool";
    bool data = false;  ///< the value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// std_msgs/msg/Int32
struct Int32 {
    static constexpr const char* kName = "std_msgs/msg/Int32";
    std::int32_t data = 0;  ///< the value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// std_msgs/msg/Float32
struct Float32 {
    static constexpr const char* kName = "std_msgs/msg/Float32";
    float data = 0;  ///< the value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// std_msgs/msg/Float64
struct Float64 {
    static constexpr const char* kName = "std_msgs/msg/Float64";
    double data = 0;  ///< the value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// std_msgs/msg/MultiArrayDimension
struct MultiArrayDimension {
    static constexpr const char* kName = "std_msgs/msg/MultiArrayDimension";
    std::string label;         ///< its name
    std::uint32_t size = 0;    ///< elements along it
    std::uint32_t stride = 0;  ///< elements of this and all inner dimensions

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("label", m.label);
        visit("size", m.size);
        visit("stride", m.stride);
    }
};

/// std_msgs/msg/MultiArrayLayout
struct MultiArrayLayout {
    static constexpr const char* kName = "std_msgs/msg/MultiArrayLayout";
    std::vector<MultiArrayDimension> dim;  ///< outer first; none: a plain list
    std::uint32_t data_offset = 0;         ///< elements before the first

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("dim", m.dim);
        visit("data_offset", m.data_offset);
    }
};

/// std_msgs/msg/Float32MultiArray
struct Float32MultiArray {
    static constexpr const char* kName = "std_msgs/msg/Float32MultiArray";
    MultiArrayLayout layout;  ///< of the data
    std::vector<float> data;  ///< the values

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("layout", m.layout);
        visit("data", m.data);
    }
};

/// std_msgs/msg/Float64MultiArray
struct Float64MultiArray {
    static constexpr const char* kName = "std_msgs/msg/Float64MultiArray";
    MultiArrayLayout layout;   ///< of the data
    std::vector<double> data;  ///< the values

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("layout", m.layout);
        visit("data", m.data);
    }
};

/// geometry_msgs/msg/TwistStamped
struct TwistStamped {
    static constexpr const char* kName = "geometry_msgs/msg/TwistStamped";
    Header header;       ///< time and frame
    TwistMessage twist;  ///< m/s, rad/s

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("twist", m.twist);
    }
};

/// geometry_msgs/msg/Accel
struct AccelMessage {
    static constexpr const char* kName = "geometry_msgs/msg/Accel";
    Vector3 linear;   ///< m/s^2
    Vector3 angular;  ///< rad/s^2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("linear", m.linear);
        visit("angular", m.angular);
    }
};

/// trajectory_msgs/msg/JointTrajectoryPoint
struct JointTrajectoryPoint {
    static constexpr const char* kName = "trajectory_msgs/msg/JointTrajectoryPoint";
    std::vector<double> positions;      ///< rad or m, of each joint
    std::vector<double> velocities;     ///< rad/s or m/s, or empty
    std::vector<double> accelerations;  ///< rad/s^2 or m/s^2, or empty
    std::vector<double> effort;         ///< N m or N, or empty
    Duration time_from_start;           ///< when it is to be reached, since the stamp of the trajectory

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("positions", m.positions);
        visit("velocities", m.velocities);
        visit("accelerations", m.accelerations);
        visit("effort", m.effort);
        visit("time_from_start", m.time_from_start);
    }
};

/// trajectory_msgs/msg/JointTrajectory
struct JointTrajectory {
    static constexpr const char* kName = "trajectory_msgs/msg/JointTrajectory";
    Header header;                             ///< when it begins; 0: at once
    std::vector<std::string> joint_names;      ///< in the order of the values of points
    std::vector<JointTrajectoryPoint> points;  ///< in the order of their times

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("joint_names", m.joint_names);
        visit("points", m.points);
    }
};

/// trajectory_msgs/msg/MultiDOFJointTrajectoryPoint
struct MultiDofJointTrajectoryPoint {
    static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
    std::vector<TransformMessage> transforms;  ///< of each joint
    std::vector<TwistMessage> velocities;      ///< m/s, rad/s, or empty
    std::vector<TwistMessage> accelerations;   ///< m/s^2, rad/s^2, or empty
    Duration time_from_start;                  ///< as of JointTrajectoryPoint

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("transforms", m.transforms);
        visit("velocities", m.velocities);
        visit("accelerations", m.accelerations);
        visit("time_from_start", m.time_from_start);
    }
};

/// trajectory_msgs/msg/MultiDOFJointTrajectory
struct MultiDofJointTrajectory {
    static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectory";
    Header header;                                     ///< when it begins; 0: at once
    std::vector<std::string> joint_names;              ///< in the order of the values of points
    std::vector<MultiDofJointTrajectoryPoint> points;  ///< in the order of their times

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("joint_names", m.joint_names);
        visit("points", m.points);
    }
};

}  // namespace roboss::ros2
