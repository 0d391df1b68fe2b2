// See robot_topics.h.
#include "ros2/robot_topics.h"

#include <map>
#include <utility>

#include "ros2/bridged_topics.h"
#include "ros2/fleet_topics.h"
#include "ros2/robot_controllers.h"
#include "ros2/robot_messages.h"
#include "ros2/robot_names.h"
#include "ros2/sensor_messages.h"
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
        given = beside(given, "camera_info");
    return sensor.ros_topic.starts_with('/') ? "/" + given : below(robot, given);
}

}  // namespace

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
    : model_(std::move(model)), controllers_(options.controllers) {
    topics_ = {{"/clock", &type_of<Clock>(), false, {}},
               {"/tf", &type_of<TFMessage>(), false, {}},
               {"/tf_static", &type_of<TFMessage>(), true, {}}};
    const std::vector<std::string> names = robot_names(*model_, options.root);
    if (options.fleet) fleet_ = std::make_unique<FleetTopics>(model_, names, topics_);
    Taken taken;
    for (const Topic& topic : topics_) taken.topics.insert(topic.name);
    for (std::size_t r = 0; r < names.size(); ++r) add_robot(RobotId(r), names[r], options, taken);
    if (options.bridge) use(*options.bridge);
    wanted_.assign(topics_.size(), true);
}

/// Gives topics the names and types of a bridge's file.
void RobotTopics::use(const Bridge& bridge) {
    std::map<std::pair<RobotId, std::size_t>, std::size_t> firsts;  // topics of sensors
    for (const Source& source : sources_) firsts[{source.robot, source.sensor}] = source.first;
    const auto usual = [&](const GazeboTopic& topic) -> std::optional<std::size_t> {
        switch (topic.kind) {
            case GazeboTopic::Kind::kClock:
                return kClock;
            case GazeboTopic::Kind::kFrames:
                return topic.robot.valid() ? robots_[topic.robot.index()].tf.front() : kTf;
            case GazeboTopic::Kind::kFixedFrames:
                return topic.robot.valid() ? robots_[topic.robot.index()].tf_static.front() : kTfStatic;
            case GazeboTopic::Kind::kJointStates:
                return robots_[topic.robot.index()].joint_states;
            case GazeboTopic::Kind::kReading:
                return firsts.at({topic.robot, topic.number}) + topic.message;
            case GazeboTopic::Kind::kCommand:
                break;
        }
        return {};
    };
    BridgeMatch match = match_bridge(bridge, *model_);
    bridge_notices_ = std::move(match.notices);
    bridged_ = std::make_shared<BridgedTopics>(match, topics_, usual);
    for (const auto& [robot, topic] : bridged_->frames_of_robots()) {
        RobotPart& part = robots_[robot.index()];
        (topics_[topic].is_latched ? part.tf_static : part.tf).push_back(topic);
    }
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
        part.tf = {add("tf", type_of<TFMessage>(), false)};
        part.tf_static = {add("tf_static", type_of<TFMessage>(), true)};
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
        for_each_topic(*model_, info, [&](const char* suffix, const auto&) { ++uses[suffix]; });
    for (std::size_t s = 0; s < type.sensors.size(); ++s) {
        const SensorInfo& info = type.sensors[s];
        const std::string sensor_name = ros_name(info.spec.name);
        const bool is_camera = sensor_messages::optics_of(info.spec) != nullptr;
        Source source{robot, s, topics_.size(), 0, "", "", "", {}, nullptr};
        for_each_topic(*model_, info, [&]<class M>(const char* suffix, const M&) {
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
            if (controllers_) source.drive = drive_of(*controllers_, type, part.name, info.spec);
            if (part.odometry == kNone) {
                part.odometry = sources_.size();
                part.publishes_base = source.drive == nullptr || source.drive->publishes_base;
            }
        } else if (const std::string given = ros_path(info.spec.ros_frame); part.is_link(given)) {
            source.frame = given;  // as with Gazebo: the file has a link for it
        } else {
            source.frame =
                taken.frame(info.spec, part.prefix, part.frames[info.link.index()] + "/" + sensor_name);
        }
        if (is_camera)
            source.optical_frame = part.is_link(source.frame)
                                       ? source.frame
                                       : unique_name(source.frame + "_optical_frame", taken.frames);
        sources_.push_back(std::move(source));
    }
}

void RobotTopics::select(std::vector<bool> wanted) {
    wanted_ = std::move(wanted);
    wanted_.resize(topics_.size(), false);
    if (bridged_) wanted_ = bridged_->needed(std::move(wanted_));
}

}  // namespace roboss::ros2
