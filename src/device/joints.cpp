// See joints.h and docs/devices.md.
#include "device/joints.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "device/sample_json.h"

namespace roboss {
namespace {

using nlohmann::json;

constexpr double kRepeat_s = 0.02;    // between packets that say nothing new
constexpr double kWatchdog_s = 0.5;   // after which a device that hears nothing stops
constexpr double kBetween_s = 0.002;  // at least
constexpr double kAnew_s = 1;         // of old numbers only
constexpr double kFilter_s = 0.05;    // of velocities that are made from poses
constexpr std::size_t kNotedMost = 20;
constexpr std::size_t kBootsMost = 100;  // that are remembered

const char* name_of(MotorMode mode) {
    switch (mode) {
        case MotorMode::kVelocity:
            return "velocity";
        case MotorMode::kPosition:
            return "position";
        case MotorMode::kEffort:
            return "effort";
        case MotorMode::kPassive:
            break;
    }
    return "passive";
}

/// A member of a packet; throws if it has none.
const json& member(const json& packet, const char* name) {
    const auto found = packet.find(name);
    if (found != packet.end()) return *found;
    throw std::runtime_error("it has no member \"" + std::string(name) + "\" (docs/devices.md)");
}

/// A number that is one; throws else.
double finite(const json& value) {
    const double number = value.get<double>();
    if (!std::isfinite(number)) throw std::invalid_argument("a number is not finite");
    return number;
}

Vec3 vector_of(const json& value) {
    return {finite(value.at(0)), finite(value.at(1)), finite(value.at(2))};
}

Pose pose_of(const json& value) {
    const json& q = value.at("quat_xyzw");
    const Quat turn{finite(q.at(3)), finite(q.at(0)), finite(q.at(1)), finite(q.at(2))};
    const double size = turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
    if (!(size > 0.5 && size < 2)) throw std::invalid_argument("\"quat_xyzw\" is no unit quaternion");
    return {vector_of(value.at("position")), normalized(turn)};
}

JointReading joint_of(const json& value) {
    JointReading reading{finite(value.at("position")), finite(value.at("velocity")), {}};
    if (const auto effort = value.find("effort"); effort != value.end()) reading.effort = finite(*effort);
    return reading;
}

}  // namespace

JointsAdapter::JointsAdapter(const Model& model, RobotId robot, std::uint32_t session)
    : model_(model), robot_(robot), session_(session) {}

Result<> JointsAdapter::order(const Action& action) {
    const RobotType& type = model_.type_of(robot_);
    if (const auto* set = std::get_if<SetJoint>(&action)) {
        if (!readings_.joints.contains(set->joint)) {
            std::string names;
            for (const auto& [joint, reading] : readings_.joints)
                names += (names.empty() ? "" : ", ") + type.joints[joint.index()].name;
            return Error{"the device has no joint '" + type.joints[set->joint.index()].name + "'",
                         names.empty() ? "it reports no joints at all" : "it has " + names, "no-ability"};
        }
        Setpoint& now = setpoints_[set->joint];
        is_changed_ = is_changed_ || now != Setpoint{set->mode, set->target, set->max_effort};
        now = {set->mode, set->target, set->max_effort};
        return Ok{};
    }
    if (const auto* command = std::get_if<Command>(&action)) {
        const std::string& name = type.channels[command->channel].channel.name;
        if (std::ranges::find(taken_commands_, name) == taken_commands_.end())
            return Error{"the device takes no command '" + name + "'",
                         "drive its joints, or list the command in \"commands\" of its readings",
                         "no-ability"};
        std::vector<double>& now = commands_[command->channel];
        is_changed_ = is_changed_ || now != command->values;
        now = command->values;
        return Ok{};
    }
    return Error{"a device takes no such order", "give set_joint() or command(): what motors can do",
                 "no-ability"};
}

void JointsAdapter::rest(bool resting) {
    is_changed_ = is_changed_ || resting != resting_;
    resting_ = resting;
}

std::vector<std::string> JointsAdapter::due(double now_s) {
    const double wait_s = is_changed_ ? kBetween_s : kRepeat_s;
    if (now_s - sent_s_ < wait_s) return {};
    sent_s_ = now_s;
    ++sent_;
    if (std::exchange(is_changed_, false)) changed_ = sent_;
    return {packet()};
}

std::string JointsAdapter::packet() {
    json text = {
        {"roboss", kJointsVersion}, {"session", session_}, {"seq", sent_}, {"watchdog_s", kWatchdog_s}};
    text["type"] = resting_ ? "stop" : "command";
    if (robot_.valid()) text["robot"] = model_.robots[robot_.index()].name;
    if (!robot_.valid() || resting_) return text.dump();
    const RobotType& type = model_.type_of(robot_);
    json& joints = text["joints"] = json::object();
    for (const auto& [joint, setpoint] : setpoints_) {
        json& each = joints[type.joints[joint.index()].name] = {{"mode", name_of(setpoint.mode)},
                                                                {"target", setpoint.target}};
        if (setpoint.max_effort >= 0) each["max_effort"] = setpoint.max_effort;
    }
    for (const auto& [channel, values] : commands_)
        text["commands"][type.channels[channel].channel.name] = values;
    return text.dump();
}

void JointsAdapter::receive(std::string_view bytes, double now_s) {
    Packet packet;
    if (const auto wrong = read(bytes, packet)) {
        ++count_.damaged;
        note_once("a packet was dropped: " + *wrong);
        return;
    }
    if (!is_new(packet, now_s)) {
        ++count_.stale;
        return;
    }
    ++count_.taken;
    take(std::move(packet), now_s);
}

std::optional<std::string> JointsAdapter::read(std::string_view bytes, Packet& packet) const {
    const RobotType* type = robot_.valid() ? &model_.type_of(robot_) : nullptr;
    try {
        const json text = json::parse(bytes);
        if (member(text, "roboss") != kJointsVersion)
            return "it is of version " + text.at("roboss").dump() + ", this is " +
                   std::to_string(kJointsVersion);
        if (member(text, "type") != "readings") return "its type is " + text.at("type").dump();
        packet.boot = member(text, "boot").get<std::uint64_t>();
        packet.number = member(text, "seq").get<std::uint64_t>();
        packet.stamp_s = finite(member(text, "stamp_s"));
        if (text.value("session", std::uint64_t{0}) == session_)
            packet.acknowledged = text.value("ack", std::uint64_t{0});
        const json joints = text.value("joints", json::object());
        const json sensors = text.value("sensors", json::object());
        const json poses = text.value("poses", json::object());
        if (type != nullptr) {
            for (const auto& [name, value] : joints.items()) {
                const auto joint = type->find_joint(name);
                if (!joint || type->joints[joint->index()].nv != 1)
                    return "the robot has no joint \"" + name + "\" with one axis";
                packet.readings.joints[*joint] = joint_of(value);
            }
            for (const auto& [name, value] : sensors.items()) {
                const auto sensor = type->find_sensor(name);
                if (!sensor) return "the robot has no sensor \"" + name + "\"";
                Result<Sample> sample = sample_of(type->sensors[*sensor].spec, value);
                if (!sample) return sample.error().message;
                packet.readings.sensors[*sensor] = std::move(sample).value();
            }
            if (text.contains("commands"))
                packet.commands = text.at("commands").get<std::vector<std::string>>();
        }
        for (const auto& [name, value] : poses.items()) {
            const auto robot = model_.find_robot(name);
            if (!robot) return "the world has no robot \"" + name + "\"";
            PoseReading& pose = packet.readings.poses[*robot] = {pose_of(value), {}, {}, false};
            packet.has_velocity[*robot] = value.contains("linear") && value.contains("angular");
            if (!packet.has_velocity[*robot]) continue;
            pose.linear = vector_of(value.at("linear")), pose.angular = vector_of(value.at("angular"));
        }
    } catch (const std::exception& e) {
        return e.what();
    }
    return std::nullopt;
}

bool JointsAdapter::is_new(const Packet& packet, double now_s) {
    const bool same = !boots_.empty() && boots_.back() == packet.boot;
    // Nothing but old numbers for so long: it started again, and has no clock or chance for another boot
    // number.
    const bool anew = same && packet.number <= heard_ && now_s - readings_.fresh_s > kAnew_s;
    if (same && !anew) {
        if (packet.number <= heard_) return false;
        count_.lost += packet.number - heard_ - 1;
        heard_ = packet.number;
        return true;
    }
    if (!same && std::ranges::find(boots_, packet.boot) != boots_.end()) return false;  // of before a reboot
    if (!boots_.empty()) {
        ++count_.reboots;
        if (now_s - std::exchange(rebooted_s_, now_s) > kAnew_s)
            notices_.push_back("the device started again");
    }
    if (!same) boots_.push_back(packet.boot);
    if (boots_.size() > kBootsMost) boots_.erase(boots_.begin());
    stamp_s_ = packet.stamp_s;
    acknowledged_ = 0;
    heard_ = packet.number;
    return true;
}

void JointsAdapter::take(Packet packet, double now_s) {
    const double elapsed_s = packet.stamp_s - stamp_s_;
    stamp_s_ = packet.stamp_s;
    acknowledged_ = std::max(acknowledged_, packet.acknowledged);
    for (auto& [joint, reading] : packet.readings.joints) readings_.joints[joint] = reading;
    for (auto& [sensor, sample] : packet.readings.sensors) readings_.sensors[sensor] = std::move(sample);
    for (auto& [robot, pose] : packet.readings.poses) {
        const auto before = readings_.poses.find(robot);
        if (!packet.has_velocity[robot] && before != readings_.poses.end() && elapsed_s > 0) {
            const PoseReading& old = before->second;
            const double share = std::min(1.0, elapsed_s / kFilter_s);
            const Vec3 turned = logarithm(pose.X_WR.q * conjugate(old.X_WR.q));
            pose.linear = old.linear + share * ((pose.X_WR.p - old.X_WR.p) / elapsed_s - old.linear);
            pose.angular = old.angular + share * (turned / elapsed_s - old.angular);
            if (!is_finite(pose.linear) || !is_finite(pose.angular)) pose.linear = pose.angular = {};
        }
        readings_.poses[robot] = pose;
    }
    if (packet.commands) taken_commands_ = std::move(*packet.commands);
    readings_.fresh_s = now_s;
}

void JointsAdapter::note_once(const std::string& text) {
    if (noted_.size() >= kNotedMost || std::ranges::find(noted_, text) != noted_.end()) return;
    noted_.push_back(text);
    notices_.push_back(text);
}

}  // namespace roboss
