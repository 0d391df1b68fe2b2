// Thruster of Gazebo: a propeller in water that pushes along its joint's axis.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Thrust T = K w |w| with K = density * coefficient * diameter^4 (Fossen, Guidance and Control of Ocean
/// Vehicles, 1994, equation 4.9). The command is the thrust, or the angular velocity.
struct ThrusterSpec {
    /// No coefficient is written: then it is 1, and follows the advance ratio.
    static constexpr double kFollows = 1e300;

    JointNames joint;             ///< of the propeller, whose link is pushed
    std::string robot_namespace,  ///< first part of the topics; empty: the robot's name
        topic;                    ///< of the command, below the namespace; empty: the usual one
    bool by_velocity = false;     ///< the command is an angular velocity, rad/s; else a thrust, N
    double density = 1000,        ///< kg/m^3, of the fluid
        diameter = 0.02,          ///< m, of the propeller
        coefficient = kFollows;   ///< of thrust
    bool servo = false;           ///< the joint is driven by velocity; else by a torque
    double p_gain = 0.1,          ///< N m s/rad, of the torque
        max_command = 1000,       ///< N or rad/s
        min_command = -1000,      ///< N or rad/s
        deadband = -1;            ///< N, thrust below it is none; negative: off
    double wake_fraction = 0.2,   ///< share of the speed that the wake takes
        alpha_1 = 1,              ///< thrust coefficient at rest
        alpha_2 = 0;              ///< its slope by the advance ratio
    double power_load = 0;        ///< W, taken from the battery
    std::string battery;          ///< name of the battery that it loads; empty: none

    /// Elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {{"i_gain", "0", "Gazebo does not read it either"},
                                                  {"d_gain", "0", "Gazebo does not read it either"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 64,
                                       .name = "thruster",
                                       .phrase = "a thruster",
                                       .classes = "Thruster",
                                       .files = "thruster-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint", "joint_name"}, s.joint);
        visit({"robot_namespace", "namespace"}, s.robot_namespace);
        visit({"topic", "topic"}, s.topic);
        visit({"by_velocity", "use_angvel_cmd"}, s.by_velocity);
        visit({"density", "fluid_density", "kg/m^3"}, s.density);
        visit({"diameter", "propeller_diameter", "m"}, s.diameter);
        visit({"coefficient", "thrust_coefficient"}, s.coefficient);
        visit({"servo", "velocity_control"}, s.servo);
        visit({"p_gain", "p_gain"}, s.p_gain);
        visit({"max_command", "max_thrust_cmd"}, s.max_command);
        visit({"min_command", "min_thrust_cmd"}, s.min_command);
        visit({"deadband", "deadband", "N"}, s.deadband);
        visit({"wake_fraction", "wake_fraction"}, s.wake_fraction);
        visit({"alpha_1", "alpha_1"}, s.alpha_1);
        visit({"alpha_2", "alpha_2"}, s.alpha_2);
        visit({"power_load", "power_load", "W"}, s.power_load);
        visit({"battery_name", "battery_name"}, s.battery);
    }
    /// The commands that it takes: the thrust or velocity, and the switch of the deadband.
    std::vector<Channel> channels() const;
    /// Its memory: the angular velocity wanted, rad/s.
    std::vector<double> memory() const { return {0.0}; }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> memory) const { return memory[0] == 0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const ThrusterSpec&, const ThrusterSpec&) = default;
};

}  // namespace roboss
