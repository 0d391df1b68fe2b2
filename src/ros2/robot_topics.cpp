// See robot_topics.h.
#include "ros2/robot_topics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "client/held_samples.h"
#include "ros2/fleet_topics.h"
#include "ros2/robot_description.h"
#include "ros2/robot_messages.h"
#include "ros2/robot_names.h"
#include "ros2/sensor_messages.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"
#include "ros2_types/type_description.h"

namespace roboss::ros2 {

namespace {

/// The topic of a sensor's messages: `usual` in the namespace of its robot, or by the file's <topic>. Of a
/// camera that is the topic of its images; camera_info stands beside it, as with Gazebo.
std::string topic_name(const std::string& robot, const SensorSpec& sensor, const std::string& suffix,
                       const std::string& usual) {
    if (sensor.ros_topic.empty()) return below(robot, usual);
    std::string given = ros_path(sensor.ros_topic);
    if (sensor.as<RgbdCameraSpec>())
        given += "/" + suffix;
    else if (suffix.ends_with("camera_info"))
        given = given.substr(0, given.rfind('/') + 1) + "camera_info";
    return sensor.ros_topic.starts_with('/') ? "/" + given : below(robot, given);
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

}  // namespace

/// A sensor with messages.
struct RobotTopics::Source {
    RobotId robot;
    std::size_t sensor = 0;
    std::size_t first = 0, count = 0;  // its topics
    std::string frame, optical_frame, odometry_frame;
    Transform X_WO;  // of an odometry: its frame in the world
};

/// The names of a robot.
struct RobotTopics::RobotPart {
    std::string name;                             // in ROS 2
    std::string prefix;                           // of its frames
    bool is_plain = false;                        // its frames have no prefix
    std::vector<std::string> frames;              // by LinkId; the first is the base
    std::vector<JointId> joints;                  // of one axis, that move
    std::size_t joint_states = 0;                 // its topic; 0: none
    std::size_t ground_truth = 0;                 // its topic; 0: none
    std::size_t description = 0;                  // its topic
    std::size_t tf = kTf, tf_static = kTfStatic;  // topics of its frames
    std::size_t odometry = kNone;                 // its first odometry, in sources_
};

/// Names that are in use.
struct RobotTopics::Taken {
    std::set<std::string> topics, frames;

    /// The topic; one that another robot has, too, stands in the namespace of its robot.
    std::string topic(const std::string& wanted, const std::string& robot) {
        if (topics.insert(wanted).second) return wanted;
        const std::string space = below(robot, "");
        return unique_name(wanted.starts_with(space) ? wanted : space + wanted.substr(1), topics);
    }
    /// The frame that the file names, if no other has it, else the usual one.
    std::string frame(const SensorSpec& sensor, const std::string& robot, const std::string& usual) {
        if (sensor.ros_frame.empty()) return unique_name(usual, frames);
        const std::string wanted = ros_path(sensor.ros_frame);
        return frames.insert(wanted).second ? wanted : unique_name(robot + wanted, frames);
    }
};

RobotTopics::~RobotTopics() = default;
RobotTopics::RobotTopics(RobotTopics&&) noexcept = default;
RobotTopics& RobotTopics::operator=(RobotTopics&&) noexcept = default;

RobotTopics::RobotTopics(std::shared_ptr<const Model> model, const TopicOptions& options)
    : model_(std::move(model)) {
    topics_ = {{"/clock", &type_of<Clock>(), false, {}},
               {"/tf", &type_of<TFMessage>(), false, {}},
               {"/tf_static", &type_of<TFMessage>(), true, {}}};
    const std::vector<std::string> names = robot_names(*model_, options.root);
    if (options.fleet) fleet_ = std::make_unique<FleetTopics>(model_, names, topics_);
    Taken taken;
    for (const Topic& topic : topics_) taken.topics.insert(topic.name);
    for (std::size_t r = 0; r < names.size(); ++r) add_robot(RobotId(r), names[r], options, taken);
    wanted_.assign(topics_.size(), true);
}

std::size_t RobotTopics::add_topic(const std::string& name, const MessageType& type, bool is_latched,
                                   RobotId robot) {
    topics_.push_back({name, &type, is_latched, robot});
    return topics_.size() - 1;
}

void RobotTopics::add_robot(RobotId robot, const std::string& name, const TopicOptions& options,
                            Taken& taken) {
    const RobotType& type = model_->type_of(robot);
    RobotPart part;
    part.name = name, part.is_plain = options.plain_frames || name.empty();
    part.prefix = part.is_plain ? "" : name + "/";
    if (part.is_plain) taken.frames = {"world", "odom"};  // only frames of one robot must differ
    for (const Link& link : type.links)
        part.frames.push_back(unique_name(part.prefix + ros_name(link.name), taken.frames));
    const auto add = [&](const char* usual, const MessageType& message, bool is_latched) {
        return add_topic(unique_name(below(name, usual), taken.topics), message, is_latched, robot);
    };
    if (part.is_plain && !name.empty()) {  // those of the robot at the root are the world's
        part.tf = add("tf", type_of<TFMessage>(), false);
        part.tf_static = add("tf_static", type_of<TFMessage>(), true);
    }
    part.joints = single_axis_joints(type);
    if (!part.joints.empty()) part.joint_states = add("joint_states", type_of<JointStateMessage>(), false);
    part.description = add("robot_description", type_of<String>(), true);
    if (options.ground_truth && !type.is_static && !type.links.empty())
        part.ground_truth = add("ground_truth", type_of<Odometry>(), false);
    robots_.push_back(std::move(part));
    add_sensors(robot, taken);
}

void RobotTopics::add_sensors(RobotId robot, Taken& taken) {
    const RobotType& type = model_->type_of(robot);
    RobotPart& part = robots_[robot.index()];
    // Topics that several sensors have get the sensor's name in front.
    std::map<std::string, int> uses;
    for (const SensorInfo& info : type.sensors)
        publish(SensorPlace{*model_, info, {}, {}, {}, {}, {}, {}}, nullptr,
                [&](const char* suffix, const auto&) { ++uses[suffix]; });
    for (std::size_t s = 0; s < type.sensors.size(); ++s) {
        const SensorInfo& info = type.sensors[s];
        const std::string sensor_name = ros_name(info.spec.name);
        const bool is_camera = sensor_messages::optics_of(info.spec) != nullptr;
        Source source{robot, s, topics_.size(), 0, "", "", "", {}};
        publish(SensorPlace{*model_, info, {}, {}, {}, {}, {}, {}}, nullptr,
                [&]<class M>(const char* suffix, const M&) {
                    const bool is_named = is_camera || uses[suffix] > 1;
                    const std::string usual = (is_named ? sensor_name + "/" : "") + suffix;
                    const std::string topic = topic_name(part.name, info.spec, suffix, usual);
                    add_topic(taken.topic(topic, part.name), type_of<M>(), false, robot);
                });
        source.count = topics_.size() - source.first;
        if (source.count == 0) {
            if (!info.spec.as<JointStatesSpec>())
                left_out_.push_back(model_->robots[robot.index()].name + "." + info.spec.name);
            continue;
        }
        if (sensor_messages::is_odometry(info.spec)) {
            const std::string& given = info.spec.ros_frame;
            source.odometry_frame = part.prefix + (given.empty() ? "odom" : ros_path(given));
            if (info.spec.as<WheelOdometrySpec>())
                source.X_WO = to_transform(model_->robots[robot.index()].X_WR);
            if (part.odometry == kNone) part.odometry = sources_.size();
        } else {
            source.frame =
                taken.frame(info.spec, part.prefix, part.frames[info.link.index()] + "/" + sensor_name);
        }
        if (is_camera) source.optical_frame = unique_name(source.frame + "_optical_frame", taken.frames);
        sources_.push_back(std::move(source));
    }
}

void RobotTopics::select(std::vector<bool> wanted) {
    wanted_ = std::move(wanted);
    wanted_.resize(topics_.size(), false);
}

std::vector<RobotTopics::Message> RobotTopics::latched(Tick tick) const {
    std::vector<Message> out;
    add_fixed_frames(tick, out);
    if (fleet_) fleet_->add_latched(wanted_, out);
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotPart& part = robots_[r];
        if (wanted_[part.description])
            out.push_back(
                {part.description, to_cdr(String{urdf_of(*model_, RobotId(r), part.name, part.frames)})});
    }
    return out;
}

void RobotTopics::add_fixed_frames(Tick tick, std::vector<Message>& out) const {
    const Time stamp = stamp_of(*model_, tick);
    std::map<std::size_t, TFMessage> fixed;  // by topic
    for (std::size_t r = 0; r < robots_.size(); ++r)
        add_fixed_links(model_->type_of(RobotId(r)), robots_[r].frames, stamp, fixed[robots_[r].tf_static]);
    std::set<std::string> odometry_frames;
    for (const Source& source : sources_) {
        const SensorInfo& info = model_->type_of(source.robot).sensors[source.sensor];
        const RobotPart& part = robots_[source.robot.index()];
        const auto add = [&](const std::string& parent, const std::string& child, const Transform& X) {
            fixed[part.tf_static].transforms.push_back(transform(stamp, parent, child, X));
        };
        if (!source.frame.empty())
            add(part.frames[info.link.index()], source.frame, to_transform(info.spec.X_LS));
        if (const CameraOptics* optics = sensor_messages::optics_of(info.spec))
            add(source.frame, source.optical_frame, sensor_messages::X_optical(*optics));
        // With plain frames, others say where the odometry's frame is: a localization.
        if (sensor_messages::is_odometry(info.spec) && !part.is_plain &&
            odometry_frames.insert(source.odometry_frame).second)
            add("world", source.odometry_frame, source.X_WO);
    }
    for (const auto& [topic, frames] : fixed)
        if (wanted_[topic]) out.push_back({topic, to_cdr(frames)});
}

Result<> RobotTopics::add_moving_frames(Tick tick, std::span<const RobotState> states, const Measure& measure,
                                        std::vector<Message>& out) const {
    const Time stamp = stamp_of(*model_, tick);
    std::map<std::size_t, TFMessage> moving;  // by topic
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotPart& part = robots_[r];
        if (!wanted_[part.tf]) continue;
        std::optional<SeenBase> seen;
        if (part.is_plain && part.odometry != kNone) {
            const Source& source = sources_[part.odometry];
            const Result<std::optional<Sample>> sample = measure(source.robot, source.sensor);
            if (!sample) return sample.error();
            if (!sample.value()) continue;
            seen = {source.odometry_frame, to_transform(sensor_messages::odometry_pose(*sample.value()))};
        }
        add_moving_links(model_->type_of(RobotId(r)), states[r], part.frames, seen, stamp, moving[part.tf]);
    }
    for (const auto& [topic, frames] : moving) out.push_back({topic, to_cdr(frames)});
    return Ok{};
}

void RobotTopics::add_robot_messages(Tick tick, RobotId robot, const RobotState& state,
                                     std::vector<Message>& out) const {
    const RobotPart& part = robots_[robot.index()];
    const Time stamp = stamp_of(*model_, tick);
    if (part.joint_states != 0 && wanted_[part.joint_states]) {
        JointStateMessage joints;
        joints.header.stamp = stamp;
        add_joint_states(*model_, robot, state, part.joints, "", joints);
        out.push_back({part.joint_states, to_cdr(joints)});
    }
    if (part.ground_truth != 0 && wanted_[part.ground_truth])
        out.push_back({part.ground_truth,
                       to_cdr(true_odometry(model_->type_of(robot), state, part.frames.front(), stamp))});
}

bool RobotTopics::is_due(const Source& source, Tick tick) const {
    const auto begin = wanted_.begin() + static_cast<std::ptrdiff_t>(source.first);
    if (std::find(begin, begin + static_cast<std::ptrdiff_t>(source.count), true) ==
        begin + static_cast<std::ptrdiff_t>(source.count))
        return false;
    const double rate = model_->type_of(source.robot).sensors[source.sensor].spec.update_rate_hz;
    return rate <= 0 || last_ < 0 || sample_is_due(rate, model_->dt_s, last_, tick);
}

void RobotTopics::add_readings(const Source& source, Tick tick, const Sample& sample,
                               std::vector<Message>& out) const {
    const SensorInfo& info = model_->type_of(source.robot).sensors[source.sensor];
    const SensorPlace place{*model_,
                            info,
                            source.frame,
                            robots_[source.robot.index()].frames[info.link.index()],
                            source.optical_frame,
                            robots_[source.robot.index()].frames.front(),
                            source.odometry_frame,
                            stamp_of(*model_, tick)};
    std::size_t topic = source.first;
    publish(place, &sample, [&](const char*, const auto& message) {
        if (wanted_[topic]) out.push_back({topic, to_cdr(message)});
        ++topic;
    });
}

Result<std::vector<RobotTopics::Message>> RobotTopics::messages(Tick tick, std::span<const RobotState> states,
                                                                const Measure& measure) {
    std::vector<Message> out;
    if (wanted_[kClock]) out.push_back({kClock, to_cdr(Clock{stamp_of(*model_, tick)})});
    if (Result<> added = add_moving_frames(tick, states, measure, out); !added) return added.error();
    for (std::size_t r = 0; r < robots_.size(); ++r) add_robot_messages(tick, RobotId(r), states[r], out);
    if (fleet_)
        if (Result<> added = fleet_->add_messages(tick, last_, states, wanted_, measure, out); !added)
            return added.error();
    for (const Source& source : sources_) {
        if (!is_due(source, tick)) continue;
        const Result<std::optional<Sample>> sample = measure(source.robot, source.sensor);
        if (!sample) return sample.error();
        if (sample.value()) add_readings(source, tick, *sample.value(), out);
    }
    before_ = std::exchange(last_, tick);
    return out;
}

}  // namespace roboss::ros2
