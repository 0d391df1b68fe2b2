// JointTrajectoryController of Gazebo: follows points of positions, velocities and efforts of several joints.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/joint_command.h"
#include "onboard_kinds/pid_gains.h"

namespace roboss {

/// Gains of a PID controller for each joint, in the order of the joints; what is missing has the default of
/// PidGains, which does nothing.
struct JointGains {
    std::vector<double> p,  ///< PidGains::p
        i,                  ///< PidGains::i
        d,                  ///< PidGains::d
        i_min,              ///< PidGains::i_min
        i_max,              ///< PidGains::i_max
        cmd_min,            ///< PidGains::cmd_min
        cmd_max,            ///< PidGains::cmd_max
        cmd_offset;         ///< PidGains::cmd_offset

    /// Of one joint.
    PidGains of(std::size_t joint) const {
        const auto value = [joint](const std::vector<double>& all, double usual) {
            return joint < all.size() ? all[joint] : usual;
        };
        const PidGains usual;
        return {value(p, usual.p),
                value(i, usual.i),
                value(d, usual.d),
                value(i_max, usual.i_max),
                value(i_min, usual.i_min),
                value(cmd_max, usual.cmd_max),
                value(cmd_min, usual.cmd_min),
                value(cmd_offset, usual.cmd_offset)};
    }
    /// Compares all members.
    friend bool operator==(const JointGains&, const JointGains&) = default;
};

/// The command is a list of points. Each row is [time from the command in s; then for each joint its
/// position, velocity and effort]. The targets are those of the next point to be reached: they jump, as
/// Gazebo's do. The targets of the last point stay in force. The effort of a joint is that of a PID
/// controller of its position, plus that of one of its velocity, plus the point's effort.
struct JointTrajectoryControllerSpec {
    JointNames joints;                      ///< each has one axis; none written: all of the model
    std::vector<double> initial_positions;  ///< rad or m, targets before the first command
    JointGains position,                    ///< gains of the position's error
        velocity;                           ///< gains of the velocity's error
    std::string topic;                      ///< of the command

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {{"use_header_start_time", "false|0",
                                                   "a trajectory starts when its command takes effect",
                                                   "Send the command at the tick at which it shall start."}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 22,
                                       .name = "joint-trajectory-controller",
                                       .phrase = "a joint trajectory controller",
                                       .classes = "JointTrajectoryController",
                                       .files = "joint-trajectory-controller-system",
                                       .ignored = kIgnored};

    /// Numbers of its memory ahead of those of the joints.
    enum Head { kSeen, kStart, kIndex, kProgress, kIsActive, kHeadSize };
    /// Numbers of its memory for each joint: the targets, and two PID controllers.
    enum PerJoint { kPosition, kVelocity, kEffort, kPositionPid, kVelocityPid = 5, kJointSize = 7 };

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint_name", "joint_name"}, s.joints);
        visit({"initial_position", "initial_position", "rad or m"}, s.initial_positions);
        visit({"position_p_gain", "position_p_gain"}, s.position.p);
        visit({"position_i_gain", "position_i_gain"}, s.position.i);
        visit({"position_d_gain", "position_d_gain"}, s.position.d);
        visit({"position_i_min", "position_i_min"}, s.position.i_min);
        visit({"position_i_max", "position_i_max"}, s.position.i_max);
        visit({"position_cmd_min", "position_cmd_min"}, s.position.cmd_min);
        visit({"position_cmd_max", "position_cmd_max"}, s.position.cmd_max);
        visit({"position_cmd_offset", "position_cmd_offset"}, s.position.cmd_offset);
        visit({"velocity_p_gain", "velocity_p_gain"}, s.velocity.p);
        visit({"velocity_i_gain", "velocity_i_gain"}, s.velocity.i);
        visit({"velocity_d_gain", "velocity_d_gain"}, s.velocity.d);
        visit({"velocity_i_min", "velocity_i_min"}, s.velocity.i_min);
        visit({"velocity_i_max", "velocity_i_max"}, s.velocity.i_max);
        visit({"velocity_cmd_min", "velocity_cmd_min"}, s.velocity.cmd_min);
        visit({"velocity_cmd_max", "velocity_cmd_max"}, s.velocity.cmd_max);
        visit({"velocity_cmd_offset", "velocity_cmd_offset"}, s.velocity.cmd_offset);
        visit({"topic", "topic"}, s.topic);
    }
    /// Takes all joints of the model where none is named.
    void use_model(const std::vector<std::string>& joints_of_model) {
        if (joints.empty()) joints.assign(joints_of_model.begin(), joints_of_model.end());
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        std::vector<ChannelValue> row{{"time", "s"}};
        for (const std::string& joint : joints) {
            row.push_back({"position/" + joint, "rad or m"});
            row.push_back({"velocity/" + joint, "rad/s or m/s"});
            row.push_back({"effort/" + joint, "N m or N"});
        }
        Channel channel = channel_of(topic, "joint_trajectory", std::move(row));
        channel.is_list = true;
        return {std::move(channel)};
    }
    /// At the start.
    std::vector<double> memory() const {
        std::vector<double> memory(kHeadSize + kJointSize * joints.size());
        memory[kSeen] = -1;
        for (std::size_t j = 0; j < joints.size() && j < initial_positions.size(); ++j)
            memory[kHeadSize + kJointSize * j + kPosition] = initial_positions[j];
        return memory;
    }
    /// Whether it would change nothing while its robot is at rest: no point is still to come.
    static bool rests(std::span<const double> memory) { return memory[kIsActive] == 0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        check_joint_command(joints, false, 0, problems);
    }
    /// Compares all members.
    friend bool operator==(const JointTrajectoryControllerSpec&,
                           const JointTrajectoryControllerSpec&) = default;
};

}  // namespace roboss
