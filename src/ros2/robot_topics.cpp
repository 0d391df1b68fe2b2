// See robot_topics.h.
#include "ros2/robot_topics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "client/held_samples.h"
#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "ros2/bridged_topics.h"
#include "ros2/robot_description.h"
#include "ros2/robot_names.h"
#include "ros2/sensor_messages.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"
#include "ros2_types/type_description.h"

namespace roboss::ros2 {

namespace {

TransformStamped transform(const Time& stamp, std::string parent, std::string child, const Transform& X) {
    const Pose pose = to_pose(X);
    return {{stamp, std::move(parent)},
            std::move(child),
            {{pose.p.x, pose.p.y, pose.p.z}, sensor_messages::quaternion(pose.q)}};
}

/// A camera's optical frame in the frame of the sensor: z ahead, x right, y down.
Transform optical(const CameraOptics& optics) {
    const Transform ahead{to_matrix(Quat{0.5, -0.5, 0.5, -0.5}), {}};  // w x y z
    return to_transform(optics.X_SC) * ahead;
}

const CameraOptics* optics_of(const SensorSpec& sensor) {
    const CameraOptics* optics = nullptr;
    std::visit(
        [&](const auto& spec) {
            if constexpr (requires { spec.optics; }) optics = &spec.optics;
        },
        sensor.parameters);
    return optics;
}

/// The topic of a sensor's messages: `usual` in the namespace of its robot, or by the file's <topic>. Of a
/// camera that is the topic of its images; camera_info stands beside it, as with Gazebo.
std::string topic_name(const std::string& robot, const SensorSpec& sensor, const std::string& suffix,
                       const std::string& usual) {
    if (sensor.ros_topic.empty()) return "/" + robot + "/" + usual;
    std::string given = ros_path(sensor.ros_topic);
    if (sensor.as<RgbdCameraSpec>())
        given += "/" + suffix;
    else if (suffix.ends_with("camera_info"))
        given = given.substr(0, given.rfind('/') + 1) + "camera_info";
    return (sensor.ros_topic.starts_with('/') ? "/" : "/" + robot + "/") + given;
}

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
    std::string name;                 // in ROS 2
    std::vector<std::string> frames;  // by LinkId; the first is the base
    std::vector<JointId> joints;      // of one axis, that move
    std::size_t joint_states = 0;     // its topic; 0: none
    std::size_t description = 0;      // its topic
};

/// Names that are in use.
struct RobotTopics::Taken {
    std::set<std::string> topics, frames;

    /// The topic; one that another robot has, too, stands in the namespace of its robot.
    std::string topic(const std::string& wanted, const std::string& robot) {
        if (topics.insert(wanted).second) return wanted;
        const std::string space = "/" + robot + "/";
        return unique_name(wanted.starts_with(space) ? wanted : "/" + robot + wanted, topics);
    }
    /// The frame that the file names, if no other has it, else the usual one.
    std::string frame(const SensorSpec& sensor, const std::string& robot, const std::string& usual) {
        if (sensor.ros_frame.empty()) return unique_name(usual, frames);
        const std::string wanted = ros_path(sensor.ros_frame);
        return frames.insert(wanted).second ? wanted : unique_name(robot + "/" + wanted, frames);
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
    Taken taken;
    const std::vector<std::string> names = robot_names(*model_);
    for (std::size_t r = 0; r < names.size(); ++r) add_robot(RobotId(r), names[r], taken);
    if (options.bridge) use(*options.bridge);
    wanted_.assign(topics_.size(), true);
}

/// Gives topics the names and types of a bridge's file.
void RobotTopics::use(const Bridge& bridge) {
    std::map<std::pair<RobotId, std::size_t>, std::size_t> firsts;  // topics of sensors
    std::map<std::string, RobotId> frames;
    for (std::size_t r = 0; r < robots_.size(); ++r)
        for (const std::string& frame : robots_[r].frames) frames.emplace(frame, RobotId(r));
    for (const Source& source : sources_) {
        firsts[{source.robot, source.sensor}] = source.first;
        for (const std::string& frame : {source.frame, source.optical_frame, source.odometry_frame})
            frames.emplace(frame, source.robot);
    }
    const auto usual = [&](const GazeboTopic& topic) -> std::optional<std::size_t> {
        switch (topic.kind) {
            case GazeboTopic::Kind::kClock:
                return kClock;
            case GazeboTopic::Kind::kFrames:
                return kTf;
            case GazeboTopic::Kind::kFixedFrames:
                return kTfStatic;
            case GazeboTopic::Kind::kJointStates:
                return robots_[topic.robot.index()].joint_states;
            case GazeboTopic::Kind::kReading:
                return firsts.at({topic.robot, topic.number}) + topic.message;
            case GazeboTopic::Kind::kCommand:
                break;
        }
        return {};
    };
    bridged_ =
        std::make_shared<BridgedTopics>(match_bridge(bridge, *model_), topics_, usual, std::move(frames));
}

void RobotTopics::add_robot(RobotId robot, const std::string& name, Taken& taken) {
    const RobotType& type = model_->type_of(robot);
    RobotPart part;
    for (const Link& link : type.links)
        part.frames.push_back(unique_name(name + "/" + ros_name(link.name), taken.frames));
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (type.joints[j].nv == 1) part.joints.push_back(JointId(j));
    if (!part.joints.empty()) {
        part.joint_states = topics_.size();
        topics_.push_back({unique_name("/" + name + "/joint_states", taken.topics),
                           &type_of<JointStateMessage>(), false, robot});
    }
    part.name = name, part.description = topics_.size();
    topics_.push_back(
        {unique_name("/" + name + "/robot_description", taken.topics), &type_of<String>(), true, robot});
    robots_.push_back(std::move(part));

    add_sensors(robot, name, taken);
}

void RobotTopics::add_sensors(RobotId robot, const std::string& name, Taken& taken) {
    const RobotType& type = model_->type_of(robot);
    // Topics that several sensors have get the sensor's name in front.
    std::map<std::string, int> uses;
    for (const SensorInfo& info : type.sensors)
        publish(SensorPlace{*model_, info, "", "", "", "", {}}, nullptr,
                [&](const char* suffix, const auto&) { ++uses[suffix]; });
    for (std::size_t s = 0; s < type.sensors.size(); ++s) {
        const SensorInfo& info = type.sensors[s];
        const std::string sensor_name = ros_name(info.spec.name);
        const bool is_camera = optics_of(info.spec) != nullptr;
        Source source{robot, s, topics_.size(), 0, "", "", name + "/odom", {}};
        publish(SensorPlace{*model_, info, "", "", "", "", {}}, nullptr,
                [&]<class M>(const char* suffix, const M&) {
                    const bool is_named = is_camera || uses[suffix] > 1;
                    const std::string usual = (is_named ? sensor_name + "/" : "") + suffix;
                    const std::string topic = topic_name(name, info.spec, suffix, usual);
                    topics_.push_back({taken.topic(topic, name), &type_of<M>(), false, robot});
                });
        source.count = topics_.size() - source.first;
        if (source.count == 0) {
            if (!info.spec.as<JointStatesSpec>())
                left_out_.push_back(model_->robots[robot.index()].name + "." + info.spec.name);
            continue;
        }
        source.frame =
            taken.frame(info.spec, name, robots_.back().frames[info.link.index()] + "/" + sensor_name);
        if (is_camera) source.optical_frame = unique_name(source.frame + "_optical_frame", taken.frames);
        if (info.spec.as<WheelOdometrySpec>()) source.X_WO = to_transform(model_->robots[robot.index()].X_WR);
        sources_.push_back(std::move(source));
    }
}

void RobotTopics::select(std::vector<bool> wanted) {
    wanted_ = std::move(wanted);
    wanted_.resize(topics_.size(), false);
    if (bridged_) wanted_ = bridged_->needed(std::move(wanted_));
}

std::vector<RobotTopics::Message> RobotTopics::latched(Tick tick) const {
    std::vector<Message> out;
    if (wanted_[kTfStatic]) out.push_back({kTfStatic, fixed_frames(tick)});
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotPart& part = robots_[r];
        if (wanted_[part.description])
            out.push_back(
                {part.description, to_cdr(String{urdf_of(*model_, RobotId(r), part.name, part.frames)})});
    }
    if (bridged_) bridged_->finish(out);
    return out;
}

std::string RobotTopics::fixed_frames(Tick tick) const {
    const Time stamp = stamp_of(*model_, tick);
    TFMessage frames;
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotType& type = model_->type_of(RobotId(r));
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            const Link& link = type.links[l];
            if (link.parent < 0) continue;
            const Link& parent = type.links[static_cast<std::size_t>(link.parent)];
            if (link.body != parent.body) continue;  // it moves: messages() has it
            frames.transforms.push_back(transform(stamp,
                                                  robots_[r].frames[static_cast<std::size_t>(link.parent)],
                                                  robots_[r].frames[l], inverse(parent.X_BL) * link.X_BL));
        }
    }
    std::set<std::string> odometry_frames;
    for (const Source& source : sources_) {
        const SensorInfo& info = model_->type_of(source.robot).sensors[source.sensor];
        const std::string& link = robots_[source.robot.index()].frames[info.link.index()];
        frames.transforms.push_back(transform(stamp, link, source.frame, to_transform(info.spec.X_LS)));
        if (const CameraOptics* optics = optics_of(info.spec))
            frames.transforms.push_back(
                transform(stamp, source.frame, source.optical_frame, optical(*optics)));
        const bool is_odometry = info.spec.as<OdometrySpec>() || info.spec.as<WheelOdometrySpec>();
        if (is_odometry && odometry_frames.insert(source.odometry_frame).second)
            frames.transforms.push_back(transform(stamp, "world", source.odometry_frame, source.X_WO));
    }
    return to_cdr(frames);
}

std::string RobotTopics::moving_frames(Tick tick, std::span<const RobotState> states) const {
    const Time stamp = stamp_of(*model_, tick);
    TFMessage frames;
    std::vector<Transform> bodies;
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotType& type = model_->type_of(RobotId(r));
        const std::vector<std::string>& names = robots_[r].frames;
        bodies.resize(type.bodies.size());
        body_poses(type, states[r], bodies);
        const auto pose_of = [&](const Link& link) {
            return (link.body < 0 ? to_transform(base_pose(states[r]))
                                  : bodies[static_cast<std::size_t>(link.body)]) *
                   link.X_BL;
        };
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            const Link& link = type.links[l];
            if (link.parent < 0) {
                frames.transforms.push_back(transform(stamp, "world", names[l], pose_of(link)));
                continue;
            }
            const auto parent = static_cast<std::size_t>(link.parent);
            if (link.body != type.links[parent].body)  // else latched() has it
                frames.transforms.push_back(transform(stamp, names[parent], names[l],
                                                      inverse(pose_of(type.links[parent])) * pose_of(link)));
        }
    }
    return to_cdr(frames);
}

std::string RobotTopics::joint_states(Tick tick, RobotId robot, const RobotState& state) const {
    const RobotType& type = model_->type_of(robot);
    JointStateMessage joints;
    joints.header.stamp = stamp_of(*model_, tick);
    for (const JointId joint : robots_[robot.index()].joints) {
        const JointState at = joint_state(type, state, joint);
        joints.name.push_back(type.joints[joint.index()].name);
        joints.position.push_back(at.position), joints.velocity.push_back(at.velocity);
        joints.effort.push_back(motor_effort(*model_, type, state, joint));
    }
    return to_cdr(joints);
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
                            source.optical_frame,
                            robots_[source.robot.index()].frames.front(),
                            source.odometry_frame,
                            stamp_of(*model_, tick)};
    std::size_t topic = source.first;
    publish(place, &sample, [&](const char*, const auto& message) {
        if (wanted_[topic]) out.push_back({topic, to_cdr(message)});
        ++topic;
    });
    if (bridged_) bridged_->add_forms(place, source.robot, source.sensor, sample, out);
}

Result<std::vector<RobotTopics::Message>> RobotTopics::messages(Tick tick, std::span<const RobotState> states,
                                                                const Measure& measure) {
    std::vector<Message> out;
    if (wanted_[kClock]) out.push_back({kClock, to_cdr(Clock{stamp_of(*model_, tick)})});
    if (wanted_[kTf]) out.push_back({kTf, moving_frames(tick, states)});
    for (std::size_t r = 0; r < robots_.size(); ++r)
        if (const std::size_t topic = robots_[r].joint_states; topic != 0 && wanted_[topic])
            out.push_back({topic, joint_states(tick, RobotId(r), states[r])});
    for (const Source& source : sources_) {
        if (!is_due(source, tick)) continue;
        const Result<std::optional<Sample>> sample = measure(source.robot, source.sensor);
        if (!sample) return sample.error();
        if (sample.value()) add_readings(source, tick, *sample.value(), out);
    }
    if (bridged_) bridged_->finish(out);
    before_ = std::exchange(last_, tick);
    return out;
}

}  // namespace roboss::ros2
