// See robot_controllers.h.
#include "ros2/robot_controllers.h"

#include <algorithm>
#include <optional>

#include "core/similar.h"
#include "model/powerless_joints.h"
#include "ros2/file_line.h"
#include "ros2/trajectory_goal.h"

namespace roboss::ros2 {

namespace {

/// The joints of an entry; none: the robot has not all of them, or something else moves them.
std::optional<std::vector<JointId>> joints_of(const ControllerEntry& entry, const RobotType& type) {
    std::vector<JointId> joints;
    for (const std::string& name : entry.joints) {
        const std::optional<JointId> joint = type.find_joint(name);
        if (!joint || !(is_driven(type, *joint) || follows(type, *joint))) return {};
        joints.push_back(*joint);
    }
    if (type.onboard.empty()) return joints;
    const TrajectoryJoints able = TrajectoryJoints::of(type);
    const bool is_its_own = entry.kind == ControllerEntry::Kind::kTrajectory && able.channel &&
                            std::ranges::is_permutation(joints, able.joints);
    return is_its_own ? std::optional(joints) : std::nullopt;
}

/// Why no robot has a controller: a joint that is not there, or not free.
std::string why_unused(const ControllerEntry& entry, const Model& model) {
    std::vector<std::string> names;
    for (const RobotType& type : model.types)
        for (const Joint& joint : type.joints) names.push_back(joint.name);
    for (const std::string& joint : entry.joints)
        if (std::ranges::find(names, joint) == names.end())
            return "no robot has the joint '" + joint.substr(0, 100) + "'; " +
                   did_you_mean(joint, names, "`roboss check WORLD --names` prints them");
    if (!entry.space.empty()) return "no robot '" + entry.space.substr(0, 100) + "' has all of its joints";
    return "no robot has all of its joints, with motors, and no on-board controller of its own";
}

}  // namespace

bool follows(const RobotType& type, JointId joint) {
    return type.joints[joint.index()].nv == 1 &&
           std::ranges::any_of(type.couplings, [&](const CoordinateCoupling& c) { return c.joint == joint; });
}

bool is_driven(const RobotType& type, JointId id) {
    const Joint& joint = type.joints[id.index()];
    if (joint.nv != 1 || joint.loop >= 0 || follows(type, id)) return false;
    const Dof& dof = type.dof(joint, 0);
    return zero_limit(dof.max_effort, dof.max_velocity) == nullptr;
}

std::vector<RobotController> controllers_of(const Controllers& controllers, const RobotType& type,
                                            const std::string& robot) {
    std::vector<RobotController> found;
    for (const ControllerEntry& entry : controllers.entries) {
        if (!entry.space.empty() && entry.space != robot) continue;
        if (std::optional<std::vector<JointId>> joints = joints_of(entry, type))
            found.push_back({&entry, std::move(*joints)});
    }
    return found;
}

std::vector<std::string> controller_notices(const Controllers& controllers, const Model& model,
                                            const std::vector<std::string>& robots) {
    std::vector<const ControllerEntry*> used;
    for (std::size_t r = 0; r < robots.size(); ++r)
        for (const RobotController& has : controllers_of(controllers, model.type_of(RobotId(r)), robots[r]))
            used.push_back(has.entry);
    std::vector<std::string> lines = controllers.notices;
    for (const ControllerEntry& entry : controllers.entries)
        if (std::ranges::find(used, &entry) == used.end())
            lines.push_back(at_line(controllers.file, entry.line) + "the controller '" + entry.name +
                            "' has no effect: " + why_unused(entry, model) + " [no-joint]");
    return lines;
}

}  // namespace roboss::ros2
