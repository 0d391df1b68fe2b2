// Interfaces of ROS 2 that come with Gazebo: ros_gz_interfaces. See standard_messages.h.
#pragma once

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

/// ros_gz_interfaces/msg/Entity
struct GazeboEntity {
    static constexpr const char* kName = "ros_gz_interfaces/msg/Entity";
    std::uint64_t id = 0;   ///< 0: it is given by its name
    std::string name;       ///< of the robot
    std::uint8_t type = 0;  ///< 2: a model

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("id", m.id);
        visit("name", m.name);
        visit("type", m.type);
    }
};

/// std_msgs/msg/UInt32
struct UInt32 {
    static constexpr const char* kName = "std_msgs/msg/UInt32";
    std::uint32_t data = 0;  ///< the value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// ros_gz_interfaces/msg/JointWrench
struct JointWrench {
    static constexpr const char* kName = "ros_gz_interfaces/msg/JointWrench";
    Header header;                ///< time and frame
    String body_1_name;           ///< one side
    UInt32 body_1_id;             ///< 0: it is given by its name
    String body_2_name;           ///< the other
    UInt32 body_2_id;             ///< 0: it is given by its name
    WrenchMessage body_1_wrench;  ///< N and N m, on body 1
    WrenchMessage body_2_wrench;  ///< on body 2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("body_1_name", m.body_1_name);
        visit("body_1_id", m.body_1_id);
        visit("body_2_name", m.body_2_name);
        visit("body_2_id", m.body_2_id);
        visit("body_1_wrench", m.body_1_wrench);
        visit("body_2_wrench", m.body_2_wrench);
    }
};

/// ros_gz_interfaces/msg/Contact
struct GazeboContact {
    static constexpr const char* kName = "ros_gz_interfaces/msg/Contact";
    GazeboEntity collision1;            ///< the link with the sensor
    GazeboEntity collision2;            ///< the touching one
    std::vector<Vector3> positions;     ///< m
    std::vector<Vector3> normals;       ///< unit, towards collision1
    std::vector<double> depths;         ///< m
    std::vector<JointWrench> wrenches;  ///< of each point

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("collision1", m.collision1);
        visit("collision2", m.collision2);
        visit("positions", m.positions);
        visit("normals", m.normals);
        visit("depths", m.depths);
        visit("wrenches", m.wrenches);
    }
};

/// ros_gz_interfaces/msg/Contacts
struct Contacts {
    static constexpr const char* kName = "ros_gz_interfaces/msg/Contacts";
    Header header;                        ///< time and frame
    std::vector<GazeboContact> contacts;  ///< one for each touching thing

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("contacts", m.contacts);
    }
};

/// ros_gz_interfaces/msg/Altimeter
struct Altimeter {
    static constexpr const char* kName = "ros_gz_interfaces/msg/Altimeter";
    Header header;                  ///< time and frame
    double vertical_position = 0;   ///< m, above the reference
    double vertical_velocity = 0;   ///< m/s, upwards
    double vertical_reference = 0;  ///< m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("vertical_position", m.vertical_position);
        visit("vertical_velocity", m.vertical_velocity);
        visit("vertical_reference", m.vertical_reference);
    }
};

}  // namespace roboss::ros2
