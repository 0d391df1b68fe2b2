// See robot_controllers.h.
#include "ros2/robot_controllers.h"

#include <algorithm>
#include <optional>

#include "core/similar.h"
#include "model/powerless_joints.h"
#include "ros2/drive_controller.h"
#include "ros2/file_line.h"
#include "ros2/robot_names.h"
#include "ros2/trajectory_goal.h"

namespace roboss::ros2 {

namespace {

/// True if an on-board controller of the type is the drive of an entry.
bool has_drive(const ControllerEntry& entry, const RobotType& type) {
    return std::ranges::any_of(type.onboard, [&](const OnboardInfo& info) {
        if (info.channels.empty() || joints_named(info.spec.parameters) != entry.joints) return false;
        const auto first = static_cast<std::size_t>(info.channels.front());
        return type.channels[first].channel.name == entry.drive->command;
    });
}

/// True if an on-board controller moves one of the joints.
bool move_on_board(const RobotType& type, const std::vector<JointId>& joints) {
    return std::ranges::any_of(type.onboard, [&](const OnboardInfo& info) {
        return std::ranges::any_of(info.axes, [&](const AxisRef& axis) {
            return std::ranges::find(joints, axis.joint) != joints.end();
        });
    });
}

/// The joints of an entry; none: the robot has not all of them, or something else moves them.
std::optional<std::vector<JointId>> joints_of(const ControllerEntry& entry, const RobotType& type) {
    std::vector<JointId> joints;
    for (const std::string& name : entry.joints) {
        const std::optional<JointId> joint = type.find_joint(name);
        if (!joint || !(is_driven(type, *joint) || follows(type, *joint))) return {};
        joints.push_back(*joint);
    }
    if (entry.drive) return has_drive(entry, type) ? std::optional(joints) : std::nullopt;
    const TrajectoryJoints able = TrajectoryJoints::of(type);
    const bool is_its_own = able.channel && entry.kind == ControllerEntry::Kind::kTrajectory &&
                            std::ranges::is_permutation(joints, able.joints);
    return is_its_own || !move_on_board(type, joints) ? std::optional(joints) : std::nullopt;
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
    if (entry.drive)
        return "no robot has it on board; give the file to `roboss run` or `roboss controller` "
               "(--ros2-controllers), and take plugins that move these joints out of the world file";
    return "no robot has all of its joints, with motors, and no on-board controller that moves them";
}

/// The frame of a robot's base is named after its first link.
void add_notice_of_base(const std::string& file, const ControllerEntry& entry, const RobotType& type,
                        std::vector<std::string>& lines) {
    if (!entry.drive || entry.drive->base_frame.empty() || type.links.empty()) return;
    const std::string base = ros_name(type.links.front().name);
    if (entry.drive->base_frame != base)
        lines.push_back(at_line(file, entry.drive->base_frame_line) + "base_frame_id of '" + entry.name +
                        "' has no effect: the base of the robot is its link '" + base +
                        "' [controller-parameter]");
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

const DriveController* drive_of(const Controllers& controllers, const RobotType& type,
                                const std::string& robot, const SensorSpec& sensor) {
    if (!sensor.as<WheelOdometrySpec>()) return nullptr;
    for (const RobotController& has : controllers_of(controllers, type, robot))
        if (has.entry->drive && has.entry->drive->odometry == sensor.ros_topic) return has.entry->drive.get();
    return nullptr;
}

std::vector<std::string> controller_notices(const Controllers& controllers, const Model& model,
                                            const std::vector<std::string>& robots) {
    std::vector<const ControllerEntry*> used;
    std::vector<std::string> lines = controllers.notices;
    for (std::size_t r = 0; r < robots.size(); ++r) {
        const RobotType& type = model.type_of(RobotId(r));
        for (const RobotController& has : controllers_of(controllers, type, robots[r])) {
            if (std::ranges::find(used, has.entry) != used.end()) continue;
            used.push_back(has.entry);
            add_notice_of_base(controllers.file, *has.entry, type, lines);
        }
    }
    for (const ControllerEntry& entry : controllers.entries)
        if (std::ranges::find(used, &entry) == used.end())
            lines.push_back(at_line(controllers.file, entry.line) + "the controller '" + entry.name +
                            "' has no effect: " + why_unused(entry, model) + " [no-joint]");
    return lines;
}

}  // namespace roboss::ros2
