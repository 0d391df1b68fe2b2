// JointController of Gazebo: holds a joint at the commanded velocity, by a velocity motor or by forces.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/joint_command.h"
#include "onboard_kinds/pid_gains.h"

namespace roboss {

/// Before the first command the joints turn with `initial_velocity`; zero: they are held. All joints get the
/// same command; in force mode one PID controller follows the velocity of the first.
struct JointControllerSpec {
    JointNames joints;                             ///< each has one axis
    double initial_velocity = 0;                   ///< rad/s or m/s
    bool use_force_commands = false;               ///< PID on the velocity rather than a velocity motor
    PidGains pid{1, 0, 0, 1, -1, 1000, -1000, 0};  ///< of force mode
    bool disable_braking = false;   ///< force mode: no force unless the joint is slower than the target
    bool use_actuator_msg = false;  ///< the command is a list of all actuators' velocities
    int actuator_number = -1;       ///< in that list
    std::string topic;              ///< of the command
    std::string sub_topic;          ///< of the command, below /model/NAME/; `topic` counts more

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 20,
                                       .name = "joint-controller",
                                       .phrase = "a joint controller",
                                       .classes = "JointController",
                                       .files = "joint-controller-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint_name", "joint_name"}, s.joints);
        visit({"initial_velocity", "initial_velocity", "rad/s or m/s"}, s.initial_velocity);
        visit({"use_force_commands", "use_force_commands"}, s.use_force_commands);
        PidGains::parameters(visit, s.pid);
        visit({"disable_braking", "disable_braking"}, s.disable_braking);
        visit({"use_actuator_msg", "use_actuator_msg"}, s.use_actuator_msg);
        visit({"actuator_number", "actuator_number"}, s.actuator_number);
        visit({"topic", "topic"}, s.topic);
        visit({"sub_topic", "sub_topic"}, s.sub_topic);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        if (use_actuator_msg) return {actuators_channel(topic, sub_topic)};
        return {joint_channel(topic, sub_topic, "joint/" + first_of(joints) + "/cmd_vel",
                              {"velocity", "rad/s or m/s"})};
    }
    /// At the start: that of the PID controller.
    std::vector<double> memory() const { return std::vector<double>(use_force_commands ? 2 : 0); }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        check_joint_command(joints, use_actuator_msg, actuator_number, problems);
    }
    /// Compares all members.
    friend bool operator==(const JointControllerSpec&, const JointControllerSpec&) = default;
};

}  // namespace roboss
