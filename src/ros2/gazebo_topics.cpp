// See gazebo_topics.h. TopicNames are those of gz-sim 8 and gz-sensors 8.
#include "ros2/gazebo_topics.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "model/topics.h"
#include "ros2/bridge_file.h"
#include "ros2/robot_commands.h"
#include "ros2/robot_names.h"
#include "ros2/sensor_messages.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

namespace {

using TopicNames = std::vector<std::string>;

/// "a::b" as a path: "/model/a/link/b". All parts but the last are models.
std::string scoped(const std::string& name, const std::string& last) {
    std::string path;
    std::size_t begin = 0;
    for (std::size_t at; (at = name.find("::", begin)) != std::string::npos; begin = at + 2)
        path += "/model/" + name.substr(begin, at - begin);
    return path + "/" + last + "/" + name.substr(begin);
}

/// The end that gz-sim gives to the topic of a sensor without <topic>.
const char* usual_end(const SensorSpec& sensor) {
    if (sensor.as<LaserSpec>()) return "/scan";
    if (sensor.as<RgbdCameraSpec>()) return "";
    if (sensor.as<DepthCameraSpec>()) return "/depth_image";
    if (sensor.as<SegmentationCameraSpec>()) return "/segmentation";
    if (sensor.as<ImuSpec>()) return "/imu";
    if (sensor.as<MagnetometerSpec>()) return "/magnetometer";
    if (sensor.as<AirPressureSpec>()) return "/air_pressure";
    if (sensor.as<GpsSpec>()) return "/navsat";
    if (sensor.as<ForceTorqueSpec>()) return "/forcetorque";
    if (sensor.as<AltimeterSpec>()) return "/altimeter";
    if (sensor.as<ContactSpec>()) return "/contact";
    if (sensor.as<LogicalCameraSpec>()) return "/logical_camera";
    if (sensor.as<AirSpeedSpec>()) return "/air_speed";
    if (sensor.as<BoxCameraSpec>()) return "/boundingbox";
    return "/image";
}

/// The topics of one message of a sensor whose own topic is `topic`; `suffix`: as publish() says it.
TopicNames names_of(const SensorSpec& sensor, const std::string& topic, const std::string& suffix) {
    const bool is_info = suffix.ends_with("camera_info"), is_depth = suffix.starts_with("depth/");
    if (sensor.as<LaserSpec>()) return {topic, topic + "/points"};
    if (sensor.as<RgbdCameraSpec>()) {
        if (is_info) return is_depth ? TopicNames{} : TopicNames{topic + "/camera_info"};
        return {topic + (is_depth ? "/depth_image" : "/image")};
    }
    if (sensor.as<SegmentationCameraSpec>())
        return is_info ? TopicNames{topic + "/camera_info", beside(topic, "camera_info")}
                       : TopicNames{topic + "/labels_map"};
    return {is_info ? beside(topic, "camera_info") : topic};
}

/// The types of a sensor's message. Lasers have two, whatever their rows.
std::vector<const MessageType*> types_of(const SensorSpec& sensor, const MessageType& usual) {
    const auto* laser = sensor.as<LaserSpec>();
    if (laser == nullptr) return {&usual};
    const MessageType *scan = &type_of<LaserScan>(), *cloud = &type_of<PointCloud2>();
    if (!laser->angles.empty()) return {cloud};  // a scan has even angles
    return &usual == scan ? std::vector{scan, cloud} : std::vector{cloud, scan};
}

class GazeboTopicList {
  public:
    explicit GazeboTopicList(const Model& model) : model_(model), world_("/world/" + model.name) {}

    std::vector<GazeboTopic> collect() {
        for (const std::string& name : {std::string("/clock"), world_ + "/clock"})
            add({name, GazeboTopic::Kind::kClock, {}, 0, 0, {&type_of<Clock>()}});
        const std::vector<const MessageType*> frames{&type_of<TFMessage>()};
        for (const std::string& name :
             {std::string("/tf"), world_ + "/pose/info", world_ + "/dynamic_pose/info"})
            add({name, GazeboTopic::Kind::kFrames, {}, 0, 0, frames});
        add({"/tf_static", GazeboTopic::Kind::kFixedFrames, {}, 0, 0, frames});
        for (std::size_t r = 0; r < model_.robots.size(); ++r) add_robot(RobotId(r));
        return std::move(topics_);
    }

  private:
    void add(GazeboTopic topic) {
        topic.name = gazebo_name(topic.name);
        topics_.push_back(std::move(topic));
    }

    void add_robot(RobotId robot) {
        const RobotType& type = model_.type_of(robot);
        const std::string& name = model_.robots[robot.index()].name;
        own_ = "/model/" + name, scope_ = world_ + scoped(name, "model");
        const std::vector<const MessageType*> frames{&type_of<TFMessage>()};
        for (const std::string& topic : frame_topics(type))
            add({topic, GazeboTopic::Kind::kFrames, robot, 0, 0, frames});
        add({own_ + "/pose_static", GazeboTopic::Kind::kFixedFrames, robot, 0, 0, frames});
        if (std::ranges::any_of(type.joints, [](const Joint& joint) { return joint.nv == 1; }))
            for (const std::string& topic : joint_topics(type))
                add({topic, GazeboTopic::Kind::kJointStates, robot, 0, 0, {&type_of<JointStateMessage>()}});
        for (std::size_t s = 0; s < type.sensors.size(); ++s) add_sensor(robot, s);
        for (std::uint32_t c = 0; c < type.channels.size(); ++c) {
            std::vector<const MessageType*> types{message_of(type.channels[c].channel, false).second};
            const MessageType* stamped = message_of(type.channels[c].channel, true).second;
            if (stamped != types.front()) types.push_back(stamped);
            add({topic_of(model_, {robot, c}), GazeboTopic::Kind::kCommand, robot, c, 0, std::move(types)});
        }
    }

    /// Where drives and pose publishers send frames: also the <tf_topic> of the file.
    TopicNames frame_topics(const RobotType& type) const {
        TopicNames names{own_ + "/tf", own_ + "/pose"};
        for (const OnboardInfo& info : type.onboard)
            visit_parameters(info.spec.parameters,
                             [&]<class Value>(const Parameter& parameter, const Value& v) {
                                 if constexpr (std::is_same_v<Value, std::string>)
                                     if (std::string_view(parameter.name) == "tf_topic" && !v.empty())
                                         names.push_back(v);
                             });
        return names;
    }

    TopicNames joint_topics(const RobotType& type) const {
        TopicNames names{scope_ + "/joint_state"};
        for (const SensorInfo& info : type.sensors)
            if (info.spec.as<JointStatesSpec>() && !info.spec.ros_topic.empty())
                names.push_back(info.spec.ros_topic);
        return names;
    }

    /// The topics of a plugin that sends readings; empty: it is a sensor with a place.
    TopicNames plugin_topics(const SensorSpec& sensor) const {
        const std::string& written = sensor.ros_topic;
        if (sensor.as<BatterySensorSpec>()) return {own_ + "/battery/" + written + "/state"};
        const std::string odometry = written.empty() ? own_ + "/odometry" : written;
        if (sensor.as<WheelOdometrySpec>()) return {odometry};
        if (sensor.as<OdometrySpec>()) return {odometry, own_ + "/odometry_with_covariance"};
        return {};
    }

    void add_sensor(RobotId robot, std::size_t number) {
        const RobotType& type = model_.type_of(robot);
        const SensorInfo& info = type.sensors[number];
        const TopicNames of_plugin = plugin_topics(info.spec);
        const auto* joint = info.spec.as<ForceTorqueSpec>();
        const std::string place = joint != nullptr ? scoped(joint->joint, "joint")
                                                   : scoped(type.links[info.link.index()].name, "link");
        const std::string topic = !info.spec.ros_topic.empty()
                                      ? gazebo_name(info.spec.ros_topic)
                                      : scope_ + place + "/sensor/" + info.spec.name + usual_end(info.spec);
        std::size_t message = 0;
        for_each_topic(model_, info, [&]<class M>(const char* suffix, const M&) {
            for (const std::string& name : of_plugin.empty() ? names_of(info.spec, topic, suffix) : of_plugin)
                add({name, GazeboTopic::Kind::kReading, robot, number, message,
                     types_of(info.spec, type_of<M>())});
            ++message;
        });
    }

    const Model& model_;
    const std::string world_;  // "/world/default"
    std::string own_, scope_;  // of the robot: "/model/car", "/world/default/model/car"
    std::vector<GazeboTopic> topics_;
};

}  // namespace

std::vector<GazeboTopic> gazebo_topics(const Model& model) {
    return GazeboTopicList(model).collect();
}

}  // namespace roboss::ros2
