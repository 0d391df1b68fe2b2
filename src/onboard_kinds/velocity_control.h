// VelocityControl of Gazebo: gives a free body the commanded velocity at the beginning of each tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// Velocities are those of the base in the axes of the robot's (model) frame. Before the first command, the
/// initial velocity holds if it is not zero; else the robot moves freely.
struct VelocityControlSpec {
    std::string topic;    ///< of the command; empty: /model/NAME/cmd_vel
    Vec3 initial_linear,  ///< m/s, robot axes
        initial_angular;  ///< rad/s, robot axes

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 1,
                                       .name = "velocity-control",
                                       .phrase = "a velocity control",
                                       .classes = "VelocityControl",
                                       .files = "velocity-control-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", "topic"}, s.topic);
        visit({"initial_linear", "initial_linear", "m/s"}, s.initial_linear);
        visit({"initial_angular", "initial_angular", "rad/s"}, s.initial_angular);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        return {channel_of(topic, "cmd_vel",
                           {{"linear_x", "m/s"},
                            {"linear_y", "m/s"},
                            {"linear_z", "m/s"},
                            {"angular_x", "rad/s"},
                            {"angular_y", "rad/s"},
                            {"angular_z", "rad/s"}})};
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const VelocityControlSpec&, const VelocityControlSpec&) = default;
};

}  // namespace roboss
