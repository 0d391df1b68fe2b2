// gazebo_ros_joint_pose_trajectory: puts joints at given positions, one point after the other.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/joint_command.h"

namespace roboss {

/// The command is a list of points. Each row is [time to the next point in s; the position of each joint of
/// the model that can move]. The first point counts at once. Joints are put there, not driven; in between
/// they move freely. The model's base stays where it is.
struct JointPoseTrajectorySpec {
    JointNames joints;         ///< each has one axis; none written: all of the model
    double update_rate = 100;  ///< Hz, at which points are looked for; 0: at each tick
    std::string topic;         ///< of the command

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 24,
                                       .name = "joint-pose-trajectory",
                                       .phrase = "a joint pose trajectory",
                                       .classes = "",
                                       .files = "gazebo_ros_joint_pose_trajectory"};

    /// The numbers of its memory: the tick of the command, the time of the next point and of the last look in
    /// s, the next point.
    enum Memory { kSeen, kNext, kLooked, kIndex, kSize };

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint_name", "joint_name"}, s.joints);
        visit({"update_rate", "update_rate|updateRate", "Hz"}, s.update_rate);
        visit({"topic", "topicName"}, s.topic);
    }
    /// Takes all joints of the model where none is named.
    void use_model(const std::vector<std::string>& joints_of_model) {
        if (joints.empty()) joints.assign(joints_of_model.begin(), joints_of_model.end());
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        std::vector<ChannelValue> row{{"time", "s"}};
        for (const std::string& joint : joints) row.push_back({"position/" + joint, "rad or m"});
        Channel channel = channel_of(topic, "set_joint_trajectory", std::move(row));
        channel.is_list = true;
        return {std::move(channel)};
    }
    /// At the start.
    std::vector<double> memory() const { return {-1, 0, -1e9, -1}; }
    /// Whether it would change nothing while its robot is at rest: no point is still to come.
    static bool rests(std::span<const double> memory) { return memory[kIndex] < 0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        check_joint_command(joints, false, 0, problems);
        if (!(update_rate >= 0)) problems.push_back({"has a negative update rate", "Write it in Hz."});
    }
    /// Compares all members.
    friend bool operator==(const JointPoseTrajectorySpec&, const JointPoseTrajectorySpec&) = default;
};

}  // namespace roboss
