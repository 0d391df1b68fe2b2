// JointPositionController of Gazebo: drives a joint to the commanded position, by a PID controller or by
// velocities.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "onboard_kinds/joint_command.h"
#include "onboard_kinds/pid_gains.h"

namespace roboss {

/// Before the first command the target is `initial_position`. All joints get the same command, which follows
/// from the position of the first. With `use_velocity_commands` the joint gets there in one tick, but not
/// faster than `cmd_max` if that is written.
struct JointPositionControllerSpec {
    JointNames joints;                                        ///< each has one axis
    int joint_index = 0;                                      ///< which axis of the joint is measured
    PidGains pid{1, 0.1, 0.01, 1, -1, kUnwritten, -1000, 0};  ///< N m or N, of the position's error
    bool use_velocity_commands = false;                       ///< a velocity motor rather than forces
    double initial_position = 0;                              ///< rad or m
    bool use_actuator_msg = false;  ///< the command is a list of all actuators' positions
    int actuator_number = -1;       ///< in that list
    std::string topic;              ///< of the command
    std::string sub_topic;          ///< of the command, below /model/NAME/

    /// `cmd_max` where none is written: 1000 N m or N, and no limit of velocity.
    static constexpr double kUnwritten = std::numeric_limits<double>::infinity();

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 21,
                                       .name = "joint-position-controller",
                                       .phrase = "a joint position controller",
                                       .classes = "JointPositionController",
                                       .files = "joint-position-controller-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint_name", "joint_name"}, s.joints);
        visit({"joint_index", "joint_index"}, s.joint_index);
        PidGains::parameters(visit, s.pid);
        visit({"use_velocity_commands", "use_velocity_commands"}, s.use_velocity_commands);
        visit({"initial_position", "initial_position", "rad or m"}, s.initial_position);
        visit({"use_actuator_msg", "use_actuator_msg"}, s.use_actuator_msg);
        visit({"actuator_number", "actuator_number"}, s.actuator_number);
        visit({"topic", "topic"}, s.topic);
        visit({"sub_topic", "sub_topic"}, s.sub_topic);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        if (use_actuator_msg) return {actuators_channel(topic, sub_topic)};
        const std::string usual =
            "joint/" + first_of(joints) + "/" + std::to_string(joint_index) + "/cmd_pos";
        return {joint_channel(topic, sub_topic, usual, {"position", "rad or m"})};
    }
    /// At the start: that of the PID controller.
    std::vector<double> memory() const { return std::vector<double>(use_velocity_commands ? 0 : 2); }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        check_joint_command(joints, use_actuator_msg, actuator_number, problems);
        if (joint_index != 0)
            problems.push_back({"measures axis " + std::to_string(joint_index) +
                                    " of its joint; only joints "
                                    "of one axis are controlled",
                                "Leave <joint_index> out."});
    }
    /// Compares all members.
    friend bool operator==(const JointPositionControllerSpec&, const JointPositionControllerSpec&) = default;
};

}  // namespace roboss
