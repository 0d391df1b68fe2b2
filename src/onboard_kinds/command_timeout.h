// Stops a drive whose commands cease, as cmd_vel_timeout of the drives of ros2_control does. No plugin of
// Gazebo stands for it.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/speed_limits.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// It stands before a drive that takes the same velocity command. A command that is older than the timeout is
/// replaced by zeros; the drive then brakes within its own limits.
struct CommandTimeoutSpec {
    std::string topic;     ///< of the command, as the drive has it; empty: /model/NAME/cmd_vel
    double timeout = 0.5;  ///< s without a new command
    JointNames joints;     ///< of the drive: both belong to the robot that has them

    /// Its row in the table of kinds. No plugin has its names.
    static constexpr OnboardKind kKind{
        .number = 37, .name = "command-timeout", .phrase = "a command timeout", .classes = "", .files = ""};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", ""}, s.topic);
        visit({"timeout", "", "s"}, s.timeout);
        visit({"joints", ""}, s.joints);
    }
    /// The command that it watches.
    std::vector<Channel> channels() const { return {twist_channel(topic, "cmd_vel")}; }
    /// The command that it gives: the same.
    std::vector<std::string> commands() const { return {channels().front().name}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const { expect_positive("timeout", timeout, problems); }
    /// Compares all members.
    friend bool operator==(const CommandTimeoutSpec&, const CommandTimeoutSpec&) = default;
};

}  // namespace roboss
