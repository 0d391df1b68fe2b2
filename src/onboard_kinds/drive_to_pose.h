// DriveToPoseController of Gazebo: commands a drive of the same robot until it stands at a commanded pose.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Turns on the spot towards the target, drives straight, turns on the spot to the heading wanted. It knows
/// the true pose of the robot's frame. It commands the channel cmd_vel.
struct DriveToPoseSpec {
    double linear_gain = 1.0,      ///< 1/s: speed over distance
        angular_gain = 2.0,        ///< 1/s: turn rate over angle
        linear_deviation = 0.1,    ///< m: nearer is there
        angular_deviation = 0.05;  ///< rad: less is straight

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 30,
                                       .name = "drive-to-pose",
                                       .phrase = "a drive-to-pose controller",
                                       .classes = "DriveToPoseController",
                                       .files = "drive-to-pose-controller-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"linear_gain", "linear_p_gain", "1/s"}, s.linear_gain);
        visit({"angular_gain", "angular_p_gain", "1/s"}, s.angular_gain);
        visit({"linear_deviation", "linear_deviation", "m"}, s.linear_deviation);
        visit({"angular_deviation", "angular_deviation"}, s.angular_deviation);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        return {channel_of("", "cmd_pose", {{"x", "m"}, {"y", "m"}, {"yaw", "rad"}})};
    }
    /// The commands that it gives.
    std::vector<std::string> commands() const { return {"cmd_vel"}; }
    /// Places in its memory.
    enum Memory : std::size_t {
        kDone = 0,    ///< tick of the command that it fulfilled last
        kActive = 1,  ///< 1: it is on its way
        kMemorySize = 2
    };
    /// Its memory at the start.
    std::vector<double> memory() const { return {-1, 0}; }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const { return m[kActive] == 0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const DriveToPoseSpec&, const DriveToPoseSpec&) = default;
};

}  // namespace roboss
