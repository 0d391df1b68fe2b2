// See robot_commands.h.
#include "ros2/robot_commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "ros2/bridged_commands.h"
#include "ros2/drive_controller.h"
#include "ros2/fleet_topics.h"
#include "ros2/robot_controllers.h"
#include "ros2/robot_names.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

namespace {

using Kind = CommandTopic::Kind;

bool is_velocity(const Channel& channel) {
    return channel.values.size() == 6 && channel.values.front().name == "linear_x";
}
bool is_pose(const Channel& channel) {
    return channel.values.size() == 3 && channel.values[0].name == "x" && channel.values[2].name == "yaw";
}
bool is_trajectory(const Channel& channel) {
    return channel.is_list && channel.values.size() > 1 && channel.values.front().name == "time" &&
           channel.values[1].name.starts_with("position/");
}
bool is_switch(const ChannelValue& value) {
    static constexpr std::array kNames{"enable", "on", "pause"};
    return value.unit.empty() && std::ranges::find(kNames, value.name) != kNames.end();
}

}  // namespace

std::pair<Kind, const MessageType*> message_of(const Channel& channel, bool stamped) {
    if (is_trajectory(channel)) return {Kind::kTrajectory, &type_of<JointTrajectory>()};
    if (channel.is_list) return {Kind::kNumbers, &type_of<Float64MultiArray>()};
    if (channel.values.empty()) return {Kind::kSignal, &type_of<Empty>()};
    if (is_velocity(channel) && stamped) return {Kind::kTwistStamped, &type_of<TwistStamped>()};
    if (is_velocity(channel)) return {Kind::kTwist, &type_of<TwistMessage>()};
    if (is_pose(channel)) return {Kind::kPose, &type_of<PoseStamped>()};
    if (channel.values.size() > 1) return {Kind::kNumbers, &type_of<Float64MultiArray>()};
    if (!channel.values.front().words.empty()) return {Kind::kText, &type_of<String>()};
    if (is_switch(channel.values.front())) return {Kind::kSwitch, &type_of<Bool>()};
    return {Kind::kNumber, &type_of<Float64>()};
}

namespace {

std::vector<double> values_of(const TwistMessage& twist) {
    return {twist.linear.x,  twist.linear.y,  twist.linear.z,
            twist.angular.x, twist.angular.y, twist.angular.z};
}

/// The heading of a pose about the vertical, rad.
double heading(const Quaternion& q) {
    return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

Error wrong(const std::string& what, const std::string& remedy) {
    return {what, remedy, "bad-message"};
}

/// The number of a word of a command, from 1.
Result<std::vector<double>> word(const ChannelValue& value, const std::string& text) {
    const auto at = std::ranges::find(value.words, text);
    if (at != value.words.end())
        return std::vector<double>{1.0 + static_cast<double>(at - value.words.begin())};
    std::string all;
    for (const std::string& each : value.words) all += (all.empty() ? "" : ", ") + each;
    return wrong("there is no such word", "send one of: " + all);
}

/// Where the joint of each part of a channel's row stands in the message.
Result<std::vector<std::size_t>> places(const Channel& channel, const std::vector<std::string>& names) {
    std::vector<std::size_t> result;
    for (std::size_t v = 1; v + 2 < channel.values.size(); v += 3) {
        const std::string joint = channel.values[v].name.substr(channel.values[v].name.find('/') + 1);
        const auto at = std::ranges::find(names, joint);
        if (at == names.end())
            return wrong("it does not name the joint '" + joint + "'", "name all joints of the controller");
        result.push_back(static_cast<std::size_t>(at - names.begin()));
    }
    return result;
}

/// Rows of [time, then position, velocity, effort of each joint], as on-board controllers take them.
Result<std::vector<double>> rows(const Channel& channel, const JointTrajectory& trajectory) {
    const Result<std::vector<std::size_t>> joints = places(channel, trajectory.joint_names);
    if (!joints) return joints.error();
    std::vector<double> rows;
    double last_s = -1;
    for (const JointTrajectoryPoint& point : trajectory.points) {
        const double time_s = point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec;
        if (time_s <= last_s)
            return wrong("its times do not ascend", "let each point be later than the last");
        last_s = time_s;
        rows.push_back(time_s);
        if (point.positions.size() != trajectory.joint_names.size())
            return wrong("a point has not one position for each joint", "give all positions");
        const auto at = [](const std::vector<double>& all, std::size_t joint) {
            return joint < all.size() ? all[joint] : 0;
        };
        for (const std::size_t joint : joints.value()) {
            rows.push_back(point.positions[joint]);
            rows.push_back(at(point.velocities, joint));
            rows.push_back(at(point.effort, joint));
        }
    }
    return rows;
}

/// The values that `convert` makes of a message of this type.
template <Message M, class Convert>
Result<std::vector<double>> read(std::string_view cdr, Convert convert) {
    const Result<M> message = from_cdr<M>(cdr);
    if (!message) return message.error();
    return convert(message.value());
}

/// The command of a robot that is a velocity.
std::optional<std::uint32_t> velocity_channel(const RobotType& type) {
    for (std::size_t c = 0; c < type.channels.size(); ++c)
        if (is_velocity(type.channels[c].channel)) return static_cast<std::uint32_t>(c);
    return {};
}

/// The drive of the file whose velocity this is; null: it is that of none.
const DriveController* drive_with(const std::vector<RobotController>& controllers, const Channel& channel) {
    for (const RobotController& controller : controllers)
        if (controller.entry->drive && controller.entry->drive->command == channel.name)
            return controller.entry->drive.get();
    return nullptr;
}

/// The topic of a command in the namespace of its robot, `space`: "/scout_1/cmd_vel", also where the file
/// says so itself. A namespace that the file gives to a plugin of gazebo_ros_pkgs takes its place.
std::string command_topic(const Channel& channel, const std::string& space, std::set<std::string>& taken) {
    const bool has_own_space = !channel.topic.starts_with("/model/") && channel.topic != "/" + channel.name &&
                               !channel.topic.empty();
    const std::string given = "/" + ros_path(channel.topic);
    if (has_own_space && taken.insert(given).second) return given;
    const std::string path = "/" + ros_path(channel.name);
    return unique_name(path.starts_with(space) ? path : space + path.substr(1), taken);
}

}  // namespace

RobotCommands::RobotCommands(std::shared_ptr<const Model> model, const TopicOptions& options)
    : model_(std::move(model)), controllers_(options.controllers) {
    const std::vector<std::string> names = robot_names(*model_, options.root);
    std::set<std::string> taken;
    for (std::size_t r = 0; r < names.size(); ++r) add_robot(RobotId(r), names[r], options.stamped, taken);
    if (options.bridge) name_commands(match_bridge(*options.bridge, *model_), *model_, topics_);
    if (options.fleet) add_fleet();
}

void RobotCommands::add_fleet() {
    fleet_ = fleet_of(*model_);
    topics_.push_back({"/fleet/cmd_vel", &type_of<Float64MultiArray>(), Kind::kFleet, {}, 0, {}, {}});
}

bool RobotCommands::takes(std::size_t topic, const std::string& type) const {
    const Kind kind = topics_[topic].kind;
    if (kind != Kind::kTwist && kind != Kind::kTwistStamped) return false;
    return type == TwistMessage::kName || type == TwistStamped::kName;
}

void RobotCommands::change_type(std::size_t number) {
    CommandTopic& topic = topics_[number];
    const bool is_stamped = topic.kind == Kind::kTwistStamped;
    topic.kind = is_stamped ? Kind::kTwist : Kind::kTwistStamped;
    topic.type = is_stamped ? &type_of<TwistMessage>() : &type_of<TwistStamped>();
}

void RobotCommands::add_robot(RobotId robot, const std::string& name, bool stamped,
                              std::set<std::string>& taken) {
    const RobotType& type = model_->type_of(robot);
    const std::string space = below(name, "");
    std::vector<RobotController> own;
    if (controllers_) own = controllers_of(*controllers_, type, name);
    for (std::size_t c = 0; c < type.channels.size(); ++c) {
        const Channel& channel = type.channels[c].channel;
        const DriveController* drive = drive_with(own, channel);
        const auto [kind, message] = message_of(channel, stamped || (drive != nullptr && drive->stamped));
        topics_.push_back({drive != nullptr ? unique_name(below(name, drive->command), taken)
                                            : command_topic(channel, space, taken),
                           message,
                           kind,
                           robot,
                           static_cast<std::uint32_t>(c),
                           {},
                           {}});
    }
    add_setpoints(robot, name, own);
}

void RobotCommands::add_setpoints(RobotId robot, const std::string& name,
                                  const std::vector<RobotController>& own) {
    const RobotType& type = model_->type_of(robot);
    const auto add = [&](const std::string& controller, MotorMode mode, const std::vector<JointId>& joints) {
        topics_.push_back({below(name, controller + "/commands"), &type_of<Float64MultiArray>(),
                           Kind::kSetpoints, robot, 0, mode, joints});
    };
    for (const RobotController& controller : own)
        if (controller.entry->kind == ControllerEntry::Kind::kSetpoints)
            add(controller.entry->name, controller.entry->mode, controller.joints);
    if (!own.empty() || !type.channels.empty()) return;
    std::vector<JointId> driven;
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (is_driven(type, JointId(j))) driven.push_back(JointId(j));
    if (driven.empty()) return;
    add("position_controller", MotorMode::kPosition, driven);
    add("velocity_controller", MotorMode::kVelocity, driven);
    add("effort_controller", MotorMode::kEffort, driven);
}

Result<std::vector<RobotOrder>> RobotCommands::orders(std::size_t number, std::string_view cdr) const {
    const CommandTopic& topic = topics_[number];
    const auto refusal = [&](const Error& why) {
        return Error{topic.name + ": " + why.message, why.remedy, why.code};
    };
    if (topic.kind == Kind::kSetpoints || topic.kind == Kind::kFleet) {
        Result<std::vector<RobotOrder>> orders =
            topic.kind == Kind::kFleet ? fleet_orders(cdr) : setpoints(topic, cdr);
        if (!orders) return refusal(orders.error());
        return orders;
    }
    Result<std::vector<double>> found = values(topic, cdr);
    if (!found) return refusal(found.error());
    return std::vector{RobotOrder{topic.robot, Command{topic.channel, std::move(found).value()}}};
}

Result<std::vector<double>> RobotCommands::values(const CommandTopic& topic, std::string_view cdr) const {
    using Values = Result<std::vector<double>>;
    const Channel& channel = model_->type_of(topic.robot).channels[topic.channel].channel;
    switch (topic.kind) {
        case Kind::kTwist:
            return read<TwistMessage>(cdr, [](const auto& m) -> Values { return values_of(m); });
        case Kind::kTwistStamped:
            return read<TwistStamped>(cdr, [](const auto& m) -> Values { return values_of(m.twist); });
        case Kind::kNumber:
            return read<Float64>(cdr, [](const auto& m) -> Values { return std::vector{m.data}; });
        case Kind::kSwitch:
            return read<Bool>(cdr, [](const auto& m) -> Values { return std::vector{m.data ? 1.0 : 0.0}; });
        case Kind::kText:
            return read<String>(cdr, [&](const auto& m) { return word(channel.values.front(), m.data); });
        case Kind::kNumbers:
            return read<Float64MultiArray>(cdr, [](const auto& m) -> Values { return m.data; });
        case Kind::kPose:
            return read<PoseStamped>(cdr, [](const auto& m) -> Values {
                return std::vector{m.pose.position.x, m.pose.position.y, heading(m.pose.orientation)};
            });
        case Kind::kTrajectory:
            return read<JointTrajectory>(cdr, [&](const auto& m) { return rows(channel, m); });
        case Kind::kSignal:
        case Kind::kSetpoints:
        case Kind::kFleet:
            break;
    }
    return std::vector<double>{};
}

Result<std::vector<RobotOrder>> RobotCommands::setpoints(const CommandTopic& topic,
                                                         std::string_view cdr) const {
    const Result<Float64MultiArray> message = from_cdr<Float64MultiArray>(cdr);
    if (!message) return message.error();
    const RobotType& type = model_->type_of(topic.robot);
    const std::vector<JointId>& joints = topic.joints;
    if (message.value().data.size() != joints.size()) {
        std::string names;
        for (const JointId joint : joints)
            names += (names.empty() ? "" : ", ") + type.joints[joint.index()].name;
        return wrong("it has " + std::to_string(message.value().data.size()) + " numbers",
                     "send one for each of: " + names);
    }
    std::vector<RobotOrder> orders;
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (!follows(type, joints[j]))
            orders.push_back({topic.robot, SetJoint{joints[j], 0, topic.mode, message.value().data[j], -1}});
    return orders;
}

/// Rows of a Twist's six numbers, or of two: ahead and the turn. A robot whose row is NaN, or that takes no
/// velocity, gets no order.
Result<std::vector<RobotOrder>> RobotCommands::fleet_orders(std::string_view cdr) const {
    const Result<Float64MultiArray> message = from_cdr<Float64MultiArray>(cdr);
    if (!message) return message.error();
    const std::vector<double>& data = message.value().data;
    const std::size_t width = fleet_.empty() ? 0 : data.size() / fleet_.size();
    if ((width != 2 && width != 6) || data.size() != width * fleet_.size())
        return wrong("it has " + std::to_string(data.size()) + " numbers for " +
                         std::to_string(fleet_.size()) + " robots",
                     "send 2 or 6 for each line of /fleet/names");
    std::vector<RobotOrder> orders;
    for (std::size_t r = 0; r < fleet_.size(); ++r) {
        const auto* row = data.data() + r * width;
        const std::optional<std::uint32_t> channel = velocity_channel(model_->type_of(fleet_[r]));
        if (!channel || std::isnan(row[0])) continue;
        std::vector<double> values = width == 2 ? std::vector<double>{row[0], 0, 0, 0, 0, row[1]}
                                                : std::vector<double>(row, row + width);
        orders.push_back({fleet_[r], Command{*channel, std::move(values)}});
    }
    return orders;
}

}  // namespace roboss::ros2
