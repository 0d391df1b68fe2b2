// See world_drives.h.
#include "ros2/world_drives.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "ros2/drive_controller.h"
#include "ros2/robot_names.h"
#include "world/joint_type.h"

namespace roboss::ros2 {

namespace {

constexpr double kSteepest = 1.4;  // rad, of steering joints without limits
constexpr double kLeastSteering = 0.01;

using DriveEntries = std::vector<const ControllerEntry*>;

const JointSpec* joint_of(const ModelSpec& model, const std::string& name) {
    const auto at = std::ranges::find(model.joints, name, &JointSpec::name);
    return at == model.joints.end() ? nullptr : &*at;
}

/// True of a joint with one axis that follows no other.
bool may_be_driven(const ModelSpec& model, const std::string& name) {
    const JointSpec* joint = joint_of(model, name);
    if (joint == nullptr || joint->closes_loop || joint->axes.size() != 1) return false;
    return joint_type(joint->kind).motions.size() == 1 && !joint->axes.front().mimic;
}

/// The drives of a model, in the order of the file; of several of one joint the first.
DriveEntries drives_for(const Controllers& controllers, const ModelSpec& model, const std::string& robot) {
    DriveEntries found;
    if (model.is_static) return found;
    std::set<std::string> taken;
    for (const OnboardSpec& onboard : model.onboard)
        for (const std::string& joint : joints_named(onboard.parameters)) taken.insert(joint);
    for (const ControllerEntry& entry : controllers.entries) {
        if (!entry.drive || (!entry.space.empty() && entry.space != robot)) continue;
        const bool fits = std::ranges::all_of(entry.joints, [&](const std::string& joint) {
            return may_be_driven(model, joint) && !taken.contains(joint);
        });
        if (!fits) continue;
        taken.insert(entry.joints.begin(), entry.joints.end());
        found.push_back(&entry);
    }
    return found;
}

/// The angle that the steering joints reach on both sides, rad.
double steering_limit(const ModelSpec& model, const AckermannSteeringSpec& spec) {
    double limit = kSteepest;
    for (const JointNames* side : {&spec.left_steering, &spec.right_steering})
        for (const std::string& name : *side)
            if (const JointSpec* joint = joint_of(model, name); joint && joint->axes.front().has_limits())
                limit = std::min({limit, -joint->axes.front().lower, joint->axes.front().upper});
    return std::max(limit, kLeastSteering);
}

/// The odometry of the last on-board controller, which is a drive.
void add_odometry(const DriveController& drive, ModelSpec& model) {
    if (model.links.empty()) return;
    const OnboardSpec& last = model.onboard.back();
    const auto same = std::ranges::count_if(
        model.onboard, [&](const OnboardSpec& other) { return other.kind().number == last.kind().number; });
    WheelOdometrySpec odometry;
    odometry.controller_kind = static_cast<int>(last.kind().number);
    odometry.controller = static_cast<int>(same) - 1;
    auto link = std::ranges::find(model.links, model.canonical_link, &LinkSpec::name);
    if (link == model.links.end()) link = model.links.begin();
    SensorSpec sensor;
    sensor.name = drive.odometry, sensor.sdf_type = "plugin";
    sensor.X_LS = inverse(link->X_ML);
    sensor.update_rate_hz = drive.odometry_rate_hz;
    sensor.parameters = odometry, sensor.where = last.where;
    sensor.topic = channel_of("", drive.odometry, {}).topic;
    sensor.ros_topic = drive.odometry, sensor.ros_frame = drive.odometry_frame;
    link->sensors.push_back(std::move(sensor));
}

void add_drive(const ControllerEntry& entry, const std::string& file, ModelSpec& model) {
    const DriveController& drive = *entry.drive;
    const SourceLocation where{file, entry.line};
    if (drive.timeout_s > 0) {  // before the drive, so that this sees its command in the same tick
        CommandTimeoutSpec timeout;
        timeout.topic = drive.command, timeout.timeout = drive.timeout_s;
        timeout.joints.assign(entry.joints.begin(), entry.joints.end());
        model.onboard.emplace_back(entry.name, timeout, where);
    }
    OnboardParameters parameters = drive.parameters;
    if (auto* steering = std::get_if<AckermannSteeringSpec>(&parameters))
        steering->steering_limit = steering_limit(model, *steering);
    model.onboard.emplace_back(entry.name, std::move(parameters), where);
    add_odometry(drive, model);
}

}  // namespace

void add_drives(const Controllers& controllers, const std::string& root, const std::string& name,
                World& world) {
    std::vector<DriveEntries> wanted;
    for (const ModelInstance& instance : world.instances) {
        const std::string& own = name.empty() || world.instances.size() != 1 ? instance.name : name;
        wanted.push_back(drives_for(controllers, world.prototypes[instance.prototype],
                                    !root.empty() && own == root ? "" : ros_name(own)));
    }
    // Models that share a prototype and not their drives get one of their own.
    std::map<std::size_t, std::set<DriveEntries>> of_prototypes;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        of_prototypes[world.instances[i].prototype].insert(wanted[i]);
    std::map<std::pair<std::size_t, DriveEntries>, std::size_t> made;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i].empty()) continue;
        const std::size_t from = world.instances[i].prototype;
        const auto [place, is_new] = made.try_emplace({from, wanted[i]}, from);
        if (is_new && of_prototypes[from].size() > 1) {
            place->second = world.prototypes.size();
            world.prototypes.push_back(ModelSpec(world.prototypes[from]));
        }
        if (is_new)
            for (const ControllerEntry* entry : wanted[i])
                add_drive(*entry, controllers.file, world.prototypes[place->second]);
        world.instances[i].prototype = place->second;
    }
}

}  // namespace roboss::ros2
