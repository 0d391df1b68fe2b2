// MulticopterVelocityControl of Gazebo: flies a multicopter with commanded velocities (Lee, Leok and
// McClamroch, Geometric Tracking Control of a Quadrotor UAV on SE(3), 2010). It commands the rotors' motors.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A rotor, in the order of the motors' numbers.
struct RotorSpec {
    JointNames joint;           ///< of the rotor
    double force_constant = 0,  ///< N s^2/rad^2
        moment_constant = 0;    ///< m
    int direction = 0;          ///< 1: counter-clockwise, -1: clockwise

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint", "jointName"}, s.joint);
        visit({"force_constant", "forceConstant", "N s^2/rad^2"}, s.force_constant);
        visit({"moment_constant", "momentConstant", "m"}, s.moment_constant);
        visit({"direction", "direction"}, s.direction);
    }
    /// Compares all members.
    friend bool operator==(const RotorSpec&, const RotorSpec&) = default;
};

/// Gains act along the axes of the link.
struct MulticopterControlSpec {
    std::string robot_namespace,           ///< first part of the topics
        topic = "cmd_vel",                 ///< of the velocity, below the namespace
        enable_topic = "enable";           ///< of the switch, below the namespace
    LinkNames link;                        ///< whose motion is controlled
    Vec3 velocity_gain,                    ///< N s/m
        attitude_gain,                     ///< N m/rad
        angular_rate_gain;                 ///< N m s/rad
    Vec3 max_acceleration{1e9, 1e9, 1e9},  ///< m/s^2, by component
        max_velocity{1e9, 1e9, 1e9},       ///< m/s, by component of the command
        max_turn_rate{1e9, 1e9, 1e9};      ///< rad/s, by component of the command
    Vec3 velocity_noise_mean,              ///< m/s, where its deviation is not zero
        velocity_noise_deviation,          ///< m/s, of the measured velocity
        turn_rate_noise_mean,              ///< rad/s, where its deviation is not zero
        turn_rate_noise_deviation;         ///< rad/s, of the measured angular velocity
    std::vector<RotorSpec> rotors;         ///< at least four

    /// Elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {{"maxLinearAcceleration", "",
                                                   "Gazebo does not read it either",
                                                   "Write <maximumLinearAcceleration>."}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 61,
                                       .name = "multicopter-control",
                                       .phrase = "a multicopter velocity control",
                                       .classes = "MulticopterVelocityControl",
                                       .files = "multicopter-control-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"robot_namespace", "robotNamespace"}, s.robot_namespace);
        visit({"topic", "commandSubTopic"}, s.topic);
        visit({"enable_topic", "enableSubTopic"}, s.enable_topic);
        visit({"link", "comLinkName"}, s.link);
        visit({"velocity_gain", "velocityGain"}, s.velocity_gain);
        visit({"attitude_gain", "attitudeGain"}, s.attitude_gain);
        visit({"angular_rate_gain", "angularRateGain"}, s.angular_rate_gain);
        visit({"max_acceleration", "maximumLinearAcceleration", "m/s^2"}, s.max_acceleration);
        visit({"max_velocity", "maximumLinearVelocity", "m/s"}, s.max_velocity);
        visit({"max_turn_rate", "maximumAngularVelocity", "rad/s"}, s.max_turn_rate);
        visit({"velocity_noise_mean", "linearVelocityNoiseMean", "m/s"}, s.velocity_noise_mean);
        visit({"velocity_noise_deviation", "linearVelocityNoiseStdDev", "m/s"}, s.velocity_noise_deviation);
        visit({"turn_rate_noise_mean", "angularVelocityNoiseMean", "rad/s"}, s.turn_rate_noise_mean);
        visit({"turn_rate_noise_deviation", "angularVelocityNoiseStdDev", "rad/s"},
              s.turn_rate_noise_deviation);
        visit({"rotors", "rotorConfiguration/rotor"}, s.rotors);
    }
    /// The commands that it takes: the velocity, the switch.
    std::vector<Channel> channels() const;
    /// Its memory: the tick at which it was switched off last; -1: never.
    std::vector<double> memory() const { return {-1.0}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const MulticopterControlSpec&, const MulticopterControlSpec&) = default;
};

}  // namespace roboss
