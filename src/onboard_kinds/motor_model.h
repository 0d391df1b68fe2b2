// MulticopterMotorModel of Gazebo: a rotor of a multicopter with its motor: thrust, drag, torque, lag.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// With the rotor's real angular velocity w (the joint turns `slowdown` times slower): thrust k w^2 along
/// the rotor's z, its drag torque on the parent link, rotor drag and rolling moment of the flow across the
/// axis (Martin and Salaun, The True Role of Accelerometer Feedback in Quadrotor Control, 2010).
struct MotorModelSpec {
    std::string robot_namespace;          ///< first part of the topic; empty: the robot's name
    JointNames joint;                     ///< of the rotor
    LinkNames link;                       ///< the rotor, on which the thrust acts
    std::string topic;                    ///< of the command, below the namespace
    int actuator = -1,                    ///< which value of the command; negative: `motor_number`
        motor_number = 0;                 ///< its older name
    std::string direction = "cw";         ///< "cw" or "ccw", seen from above
    std::string motor_type = "velocity";  ///< the only one that Gazebo runs
    double max_velocity = 838,            ///< rad/s, of the rotor
        motor_constant = 8.54858e-06,     ///< N s^2/rad^2: thrust by angular velocity squared
        moment_constant = 0.016,          ///< m: drag torque by thrust
        rotor_drag = 1e-4,                ///< N s^2/(m rad): force by angular velocity and flow across
        rolling_moment = 1e-6,            ///< N s^2/rad: torque by angular velocity and flow across
        time_up = 1.0 / 80,               ///< s, lag while it speeds up
        time_down = 1.0 / 40,             ///< s, lag while it slows down
        slowdown = 10;                    ///< real angular velocity by that of the joint

    /// Elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"motorSpeedPubTopic", "", "what a rotor does is in the robot's state"},
        {"joint_control_pid", "", "only the type 'velocity' runs, in Gazebo too"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 60,
                                       .name = "multicopter-motor",
                                       .phrase = "a multicopter motor",
                                       .classes = "MulticopterMotorModel",
                                       .files = "multicopter-motor-model-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"robot_namespace", "robotNamespace"}, s.robot_namespace);
        visit({"joint", "jointName"}, s.joint);
        visit({"link", "linkName"}, s.link);
        visit({"topic", "commandSubTopic"}, s.topic);
        visit({"motor_number", "motorNumber"}, s.motor_number);
        visit({"actuator", "actuator_number"}, s.actuator);
        visit({.name = "direction", .element = "turningDirection", .choice = true}, s.direction);
        visit({.name = "motor_type", .element = "motorType", .choice = true}, s.motor_type);
        visit({"max_velocity", "maxRotVelocity", "rad/s"}, s.max_velocity);
        visit({"motor_constant", "motorConstant", "N s^2/rad^2"}, s.motor_constant);
        visit({"moment_constant", "momentConstant", "m"}, s.moment_constant);
        visit({"rotor_drag", "rotorDragCoefficient"}, s.rotor_drag);
        visit({"rolling_moment", "rollingMomentCoefficient"}, s.rolling_moment);
        visit({"time_up", "timeConstantUp", "s"}, s.time_up);
        visit({"time_down", "timeConstantDown", "s"}, s.time_down);
        visit({"slowdown", "rotorVelocitySlowdownSim"}, s.slowdown);
    }
    /// The commands that it takes: the angular velocities of all rotors, rad/s.
    std::vector<Channel> channels() const { return {motor_speeds(robot_namespace, topic)}; }
    /// The command that all rotors of a robot share.
    static Channel motor_speeds(const std::string& robot_namespace, const std::string& topic);
    /// Its memory: the lagged angular velocity of the rotor, rad/s.
    std::vector<double> memory() const { return {0.0}; }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> memory) const { return memory[0] < 1e-3 && memory[0] > -1e-3; }
    /// Which value of the command is its own.
    int index() const { return actuator >= 0 ? actuator : motor_number; }
    /// 1: counter-clockwise.
    double sign() const { return direction == "ccw" ? 1.0 : -1.0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const MotorModelSpec&, const MotorModelSpec&) = default;
};

}  // namespace roboss
