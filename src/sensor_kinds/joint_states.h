// The joints' positions, velocities and efforts, as JointStatePublisher of Gazebo publishes them.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// One number for each joint: of its first axis.
struct JointStatesReading {
    std::vector<double> positions,  ///< rad (m of prismatic joints)
        velocities,                 ///< rad/s (m/s)
        efforts;                    ///< N m (N), of the motor, in the tick before
    Tick tick = 0;                  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"positions", "rad"}, r.positions);
        visit({"velocities", "rad/s"}, r.velocities);
        visit({"efforts", "N m"}, r.efforts);
    }
};

/// Of the joints in `joints`, or, if it is empty, of all of the robot that can move, in its order.
struct JointStatesSpec {
    using Reading = JointStatesReading;  ///< what it measures

    std::vector<std::string> joints;  ///< names with the prefix of their nested model

    /// What this kind states about itself.
    static constexpr SensorKind kKind{
        .number = 21,
        .name = "joint states",
        .phrase = "a sensor of joint states",
        .sdf_types = "",
        .ours = true,
        .plugin = {.classes = "JointStatePublisher",
                   .files = "joint-state-publisher-system|gazebo_ros_joint_state_publisher",
                   .topic = "topic|topicName",
                   .usual_topic = "joint_state",
                   .rate = "update_rate|updateRate"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joints", "joint_name|jointName"}, s.joints);
    }
    /// Joints are those of the plugin's model.
    void use_plugin(const PluginFacts& plugin) {
        for (std::string& joint : joints) joint = plugin.scope + joint;
    }

    /// Compares all members.
    friend bool operator==(const JointStatesSpec&, const JointStatesSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
