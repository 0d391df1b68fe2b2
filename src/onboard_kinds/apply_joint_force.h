// ApplyJointForce of Gazebo: the commanded force or torque of a joint.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/joint_command.h"

namespace roboss {

/// The effort holds until the next command and is added to what other controllers give the joint.
struct ApplyJointForceSpec {
    JointNames joints;  ///< one, with one axis

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 23,
                                       .name = "joint-force",
                                       .phrase = "a joint force",
                                       .classes = "ApplyJointForce",
                                       .files = "apply-joint-force-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint_name", "joint_name"}, s.joints);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        return {channel_of("", "joint/" + first_of(joints) + "/cmd_force", {{"force", "N m or N"}})};
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        check_joint_command(joints, false, 0, problems);
        if (joints.size() > 1)
            problems.push_back({"names more than one joint", "Write a plugin for each of them."});
    }
    /// Compares all members.
    friend bool operator==(const ApplyJointForceSpec&, const ApplyJointForceSpec&) = default;
};

}  // namespace roboss
