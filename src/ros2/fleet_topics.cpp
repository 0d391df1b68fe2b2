// See fleet_topics.h.
#include "ros2/fleet_topics.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/topics.h"
#include "physics/dynamics/kinematics.h"
#include "ros2/robot_messages.h"
#include "ros2/sensor_messages.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

namespace {

constexpr std::size_t kNames = 0, kStates = 1, kPoses = 2, kJoints = 3, kScans = 4;  // behind first_
constexpr std::size_t kStateNumbers = 13;

/// Rows of `width` numbers.
MultiArrayLayout layout(std::size_t rows, std::size_t width, const char* what) {
    const auto size = [](std::size_t number) { return static_cast<std::uint32_t>(number); };
    return {{{"robot", size(rows), size(rows * width)}, {what, size(width), size(width)}}, 0};
}

std::size_t first_level_laser(const RobotType& type) {
    const auto at = std::ranges::find_if(type.sensors, [](const SensorInfo& info) {
        const auto* laser = info.spec.as<LaserSpec>();
        return laser != nullptr && sensor_messages::is_level_scan(*laser);
    });
    return static_cast<std::size_t>(at - type.sensors.begin());
}

}  // namespace

std::vector<RobotId> fleet_of(const Model& model) {
    std::vector<RobotId> robots;
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const RobotType& type = model.type_of(RobotId(r));
        if (!type.is_static && !type.links.empty() && board_of(type) == nullptr) robots.push_back(RobotId(r));
    }
    return robots;
}

FleetTopics::FleetTopics(std::shared_ptr<const Model> model, const std::vector<std::string>& names,
                         std::vector<Topic>& topics)
    : model_(std::move(model)), first_(topics.size()) {
    topics.push_back({"/fleet/names", &type_of<String>(), true, {}});
    topics.push_back({"/fleet/states", &type_of<Float64MultiArray>(), false, {}});
    topics.push_back({"/fleet/poses", &type_of<PoseArray>(), false, {}});
    topics.push_back({"/fleet/joint_states", &type_of<JointStateMessage>(), false, {}});
    topics.push_back({"/fleet/scans", &type_of<Float32MultiArray>(), false, {}});
    for (const RobotId robot : fleet_of(*model_)) {
        const RobotType& type = model_->type_of(robot);
        Row row{robot, names[robot.index()], first_level_laser(type), single_axis_joints(type)};
        if (row.laser == type.sensors.size())
            row.laser = kNone;
        else
            beams_ = std::max(
                beams_, static_cast<std::size_t>(type.sensors[row.laser].spec.as<LaserSpec>()->samples));
        rows_.push_back(std::move(row));
    }
}

void FleetTopics::add_latched(const std::vector<bool>& wanted, std::vector<RobotTopics::Message>& out) const {
    if (!wanted[first_ + kNames]) return;
    std::string names;
    for (const Row& row : rows_) names += (names.empty() ? "" : "\n") + row.name;
    out.push_back({first_ + kNames, to_cdr(String{names})});
}

Result<> FleetTopics::add_messages(Tick tick, Tick last, std::span<const RobotState> states,
                                   const std::vector<bool>& wanted, const RobotTopics::Measure& measure,
                                   std::vector<RobotTopics::Message>& out) const {
    if (wanted[first_ + kStates]) out.push_back({first_ + kStates, states_message(states)});
    if (wanted[first_ + kPoses]) out.push_back({first_ + kPoses, poses_message(tick, states)});
    if (wanted[first_ + kJoints]) out.push_back({first_ + kJoints, joints_message(tick, states)});
    if (!wanted[first_ + kScans]) return Ok{};
    Result<std::string> scans = scans_message(tick, last, measure);
    if (!scans) return scans.error();
    if (!scans.value().empty()) out.push_back({first_ + kScans, std::move(scans).value()});
    return Ok{};
}

std::string FleetTopics::states_message(std::span<const RobotState> states) const {
    Float64MultiArray message{layout(rows_.size(), kStateNumbers, "state"), {}};
    for (const Row& row : rows_) {
        const RobotType& type = model_->type_of(row.robot);
        const RobotState& state = states[row.robot.index()];
        const LinkId base(std::size_t{0});
        const Pose X = to_pose(link_pose(type, state, base));
        const Twist twist = link_twist(type, state, base);
        for (const double number :
             {X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w, twist.linear.x, twist.linear.y, twist.linear.z,
              twist.angular.x, twist.angular.y, twist.angular.z})
            message.data.push_back(number);
    }
    return to_cdr(message);
}

std::string FleetTopics::poses_message(Tick tick, std::span<const RobotState> states) const {
    PoseArray message{{stamp_of(*model_, tick), "world"}, {}};
    for (const Row& row : rows_) {
        const Pose X =
            to_pose(link_pose(model_->type_of(row.robot), states[row.robot.index()], LinkId(std::size_t{0})));
        message.poses.push_back(sensor_messages::pose(X.p, X.q));
    }
    return to_cdr(message);
}

std::string FleetTopics::joints_message(Tick tick, std::span<const RobotState> states) const {
    JointStateMessage message;
    message.header.stamp = stamp_of(*model_, tick);
    for (const Row& row : rows_)
        add_joint_states(*model_, row.robot, states[row.robot.index()], row.joints,
                         row.name.empty() ? "" : row.name + "/", message);
    return to_cdr(message);
}

Result<std::string> FleetTopics::scans_message(Tick tick, Tick last,
                                               const RobotTopics::Measure& measure) const {
    Float32MultiArray message{layout(rows_.size(), beams_, "beam"), {}};
    message.data.assign(rows_.size() * beams_, std::numeric_limits<float>::quiet_NaN());
    bool is_new = false;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const Row& row = rows_[r];
        if (row.laser == kNone) continue;
        const SensorSpec& laser = model_->type_of(row.robot).sensors[row.laser].spec;
        if (!has_new_sample(laser, *model_, last, tick)) continue;
        const Result<std::optional<Sample>> sample = measure(row.robot, row.laser);
        if (!sample) return sample.error();
        if (!sample.value()) continue;
        const auto& ranges = std::get<LaserReading>(*sample.value()).ranges;
        std::transform(ranges.begin(),
                       ranges.begin() + static_cast<std::ptrdiff_t>(std::min(ranges.size(), beams_)),
                       message.data.begin() + static_cast<std::ptrdiff_t>(r * beams_),
                       [](double range) { return static_cast<float>(range); });
        is_new = true;
    }
    return is_new ? to_cdr(message) : std::string();
}

}  // namespace roboss::ros2
