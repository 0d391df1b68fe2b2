// VelocityControl of Gazebo: gives a free body the commanded velocity at the beginning of each tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// Velocities are those of the canonical link's origin in the axes of the robot's (model) frame; those of a
/// link are in its own axes. Before the first command the initial velocity holds: zero freezes the robot.
/// A plugin with links becomes several controllers (parts).
struct VelocityControlSpec {
    std::string topic;    ///< of the command; empty: /model/NAME/cmd_vel, or /model/NAME/link/LINK/cmd_vel
    Vec3 initial_linear,  ///< m/s, robot axes
        initial_angular;  ///< rad/s, robot axes
    LinkNames links;      ///< one: it moves that link when commanded, not the model

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
        visit({"links", "link_name"}, s.links);
    }
    /// The controllers that a plugin becomes: one for the model, one for each link.
    std::vector<VelocityControlSpec> parts() const {
        std::vector<VelocityControlSpec> found{*this};
        found.front().links.clear();
        for (const std::string& link : links) {
            found.emplace_back();
            found.back().links.push_back(link);
        }
        return found;
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        if (!links.empty()) return {twist_channel("", "link/" + links.front() + "/cmd_vel")};
        return {twist_channel(topic, "cmd_vel")};
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const VelocityControlSpec&, const VelocityControlSpec&) = default;
};

}  // namespace roboss
