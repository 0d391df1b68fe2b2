// A world made for ros_gz_bridge has the names and types of its bridge's file.
#include "ros2/bridge.h"

#include <gtest/gtest.h>

#include <support/drives.h>

#include <map>

#include "ros2/robot_commands.h"
#include "ros2/robot_topics.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/sensor_messages.h"
#include "sensors/test_model.h"

namespace roboss::ros2 {
namespace {

constexpr const char *kTwist = "geometry_msgs/msg/Twist", *kStamped = "geometry_msgs/msg/TwistStamped",
                     *kScan = "sensor_msgs/msg/LaserScan", *kCloud = "sensor_msgs/msg/PointCloud2",
                     *kOdometry = "nav_msgs/msg/Odometry", *kFrames = "tf2_msgs/msg/TFMessage",
                     *kJoints = "sensor_msgs/msg/JointState", *kClock = "rosgraph_msgs/msg/Clock";

SensorSpec sensor(const std::string& name, SensorParameters parameters, const std::string& topic = "") {
    SensorSpec spec;
    spec.name = name, spec.parameters = std::move(parameters), spec.ros_topic = topic;
    return spec;
}

LaserSpec laser(int rows) {
    LaserSpec spec;
    spec.samples = 3, spec.min_angle = -1, spec.max_angle = 1, spec.range_max = 5;
    spec.vertical_samples = rows, spec.vertical_min_angle = rows > 1 ? -0.5 : 0;
    spec.vertical_max_angle = rows > 1 ? 0.5 : 0;
    return spec;
}

/// The drive of the examples of Gazebo with a level lidar, one of three rows, a camera and an odometry.
ModelSpec vehicle() {
    ModelSpec vehicle = test::with_onboard(test::two_wheeler(), test::diff_drive());
    ColorCameraSpec camera;
    camera.optics.width = 2, camera.optics.height = 1;
    vehicle.links[0].sensors = {sensor("gpu_lidar", laser(1)), sensor("rows", laser(3), "lidar"),
                                sensor("eye", camera, "/front/image"), sensor("imu", ImuSpec{}),
                                sensor("odometry", OdometrySpec{})};
    return vehicle;
}

/// Two of them in the world "test".
World two_vehicles() {
    World world = test::empty_world(0.01);
    test::place(world, test::ground(test::surface(1)), "ground");
    test::place(world, vehicle(), "vehicle_blue");
    test::place(world, vehicle(), "vehicle_green", {{0, 3, 0}, {}});
    return world;
}

constexpr const char* kLidar = "/world/test/model/vehicle_blue/link/chassis/sensor/gpu_lidar/scan";

/// Ranges 1 2 3 of a single row; 1 ... 9 of three.
Result<std::optional<Sample>> measured(RobotId, std::size_t number) {
    LaserReading reading;
    reading.samples = 3, reading.vertical_samples = number == 0 ? 1 : 3;
    for (int i = 0; i < 3 * reading.vertical_samples; ++i) reading.ranges.push_back(1.0 + i);
    if (number < 2) return std::optional<Sample>(reading);
    if (number == 2) return std::optional<Sample>(CameraReading{});
    if (number == 3) return std::optional<Sample>(ImuReading{});
    return std::optional<Sample>(OdometryReading{});
}

class BridgeTest : public testing::Test {
  protected:
    /// An entry of the file, in two lines; the first is line 1.
    void entry(const std::string& gz, const std::string& ros, const std::string& type,
               const std::string& direction = "BIDIRECTIONAL") {
        text_ += "- {gz_topic_name: " + gz + ", ros_topic_name: " + ros + ", gz_type_name: any,\n";
        text_ += "   ros_type_name: " + type + ", direction: " + direction + "}\n";
    }
    void service(const std::string& name, const std::string& type) {
        text_ += "- {service_name: " + name + ",\n   ros_type_name: " + type + "}\n";
    }
    void show() {
        Result<Bridge> bridge = parse_bridge("b.yaml", text_);
        ASSERT_TRUE(bridge) << bridge.error().text();
        TopicOptions options;
        options.bridge = std::make_shared<const Bridge>(std::move(bridge).value());
        notices_ = match_bridge(*options.bridge, *simulation_.model).notices;
        topics_.emplace(simulation_.model, options);
        commands_.emplace(simulation_.model, options);
    }
    /// The types of the topics with this name that robots send on.
    std::vector<std::string> sent(const std::string& name) const {
        std::vector<std::string> types;
        for (const Topic& topic : topics_->topics())
            if (topic.name == name) types.push_back(topic.type->name);
        return types;
    }
    /// The same of those that drive robots.
    std::vector<std::string> taken(const std::string& name) const {
        std::vector<std::string> types;
        for (const CommandTopic& topic : commands_->topics())
            if (topic.name == name) types.push_back(topic.type->name);
        return types;
    }
    /// The only message on a topic, if only that one is wanted.
    template <Message M>
    M message(const std::string& name, bool is_latched = false) {
        std::vector<bool> wanted;
        for (const Topic& topic : topics_->topics()) wanted.push_back(topic.name == name);
        topics_->select(wanted);
        const auto messages =
            is_latched ? topics_->latched(0) : topics_->messages(0, simulation_.states, measured).value();
        if (messages.size() != 1 || topics_->topics()[messages[0].topic].name != name)
            return ADD_FAILURE() << messages.size() << " messages on " << name, M{};
        return from_cdr<M>(messages[0].bytes).value();
    }
    /// The only notice has all these parts.
    void expect_notice(const std::vector<std::string>& parts) const {
        ASSERT_EQ(notices_.size(), 1u);
        for (const std::string& part : parts)
            EXPECT_NE(notices_[0].find(part), std::string::npos) << part << "\n" << notices_[0];
    }

    using Types = std::vector<std::string>;
    std::string text_;
    test::Simulation simulation_{two_vehicles()};
    std::vector<std::string> notices_;
    std::optional<RobotTopics> topics_;
    std::optional<RobotCommands> commands_;
};

TEST_F(BridgeTest, TopicsHaveTheNamesOfTheFileInsteadOfTheUsualOnes) {
    entry(kLidar, "/scan", kScan, "GZ_TO_ROS");
    entry("/model/vehicle_blue/cmd_vel", "/cmd_vel", kTwist, "ROS_TO_GZ");
    entry("/model/vehicle_blue/odometry", "/odom", kOdometry, "GZ_TO_ROS");
    entry("/world/test/model/vehicle_blue/joint_state", "/joint_states", kJoints, "GZ_TO_ROS");
    entry("/front/image", "/image", "sensor_msgs/msg/Image");
    entry("/front/camera_info", "/info", "sensor_msgs/msg/CameraInfo");
    entry("/world/test/model/vehicle_blue/link/chassis/sensor/imu/imu", "/imu", "sensor_msgs/msg/Imu");
    show();
    EXPECT_EQ(notices_, Types{});
    EXPECT_EQ(sent("/scan"), Types{kScan});
    EXPECT_EQ(taken("/cmd_vel"), Types{kTwist});
    EXPECT_EQ(sent("/odom"), Types{kOdometry});
    EXPECT_EQ(sent("/joint_states"), Types{kJoints});
    EXPECT_EQ(sent("/image").size(), 2u) << "both vehicles send on Gazebo's topic";
    EXPECT_EQ(sent("/info").size(), 2u);
    EXPECT_EQ(sent("/imu"), Types{"sensor_msgs/msg/Imu"});
    for (const char* usual : {"/vehicle_blue/scan", "/vehicle_blue/odom", "/vehicle_blue/joint_states",
                              "/vehicle_blue/imu", "/front/image", "/front/camera_info"})
        EXPECT_EQ(sent(usual), Types{}) << usual;
    EXPECT_EQ(taken("/vehicle_blue/cmd_vel"), Types{});
    EXPECT_EQ(message<LaserScan>("/scan").ranges, (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(message<JointStateMessage>("/joint_states").name.size(), 2u);
}

TEST_F(BridgeTest, WhatTheFileDoesNotNameKeepsItsUsualName) {
    entry("/model/vehicle_blue/odometry", "/vehicle_green/odom", kOdometry);
    show();
    EXPECT_EQ(sent("/vehicle_blue/scan"), Types{kScan});
    EXPECT_EQ(taken("/vehicle_blue/cmd_vel"), Types{kTwist});
    EXPECT_EQ(sent("/clock"), Types{kClock});
    EXPECT_EQ(sent("/vehicle_green/odom"), Types{kOdometry}) << "the name belongs to the file";
    EXPECT_EQ(sent("/vehicle_green/odom_2"), Types{kOdometry});
}

TEST_F(BridgeTest, ALaserIsAScanOrACloud) {
    entry(kLidar + std::string("/points"), "/cloud", kCloud);
    entry("/lidar", "/middle", kScan);
    entry("/lidar/points", "/rows", kCloud);
    show();
    EXPECT_EQ(notices_, Types{});
    EXPECT_EQ(sent("/vehicle_blue/scan"), Types{kScan}) << "the file does not name it";
    EXPECT_EQ(message<PointCloud2>("/cloud").width, 3u);
    EXPECT_EQ(sent("/middle"), (Types{kScan, kScan})) << "of each vehicle";
    EXPECT_EQ(sent("/rows"), (Types{kCloud, kCloud}));
    topics_->select(std::vector<bool>(topics_->topics().size(), true));
    const auto messages = topics_->messages(0, simulation_.states, measured);
    ASSERT_TRUE(messages);
    std::size_t scans = 0;
    for (const RobotTopics::Message& message : messages.value()) {
        if (topics_->topics()[message.topic].name != "/middle") continue;
        ++scans;
        EXPECT_EQ(from_cdr<LaserScan>(message.bytes).value().ranges, (std::vector<float>{4, 5, 6}));
    }
    EXPECT_EQ(scans, 2u);
}

TEST_F(BridgeTest, ATopicMayHaveSeveralNames) {
    entry("/model/vehicle_blue/odometry", "/odom", kOdometry);
    entry("/model/vehicle_blue/odometry", "/wheel/odom", kOdometry);
    entry("/model/vehicle_blue/odometry", "/odom", kOdometry);
    entry("/model/vehicle_blue/cmd_vel", "/cmd_vel", kTwist);
    entry("/model/vehicle_blue/cmd_vel", "/nav/cmd_vel", kStamped);
    show();
    EXPECT_EQ(notices_, Types{});
    EXPECT_EQ(sent("/odom"), Types{kOdometry}) << "an entry that is there twice counts once";
    EXPECT_EQ(message<Odometry>("/odom").header.frame_id, message<Odometry>("/wheel/odom").header.frame_id);
    EXPECT_EQ(taken("/cmd_vel"), Types{kTwist});
    EXPECT_EQ(taken("/nav/cmd_vel"), Types{kStamped});
}

TEST_F(BridgeTest, AVelocityMayBeStampedAndDriveSeveralRobots) {
    entry("/model/vehicle_blue/cmd_vel", "/cmd_vel", kStamped);
    entry("/model/vehicle_green/cmd_vel", "/cmd_vel", kStamped);
    show();
    EXPECT_EQ(notices_, Types{});
    EXPECT_EQ(taken("/cmd_vel"), (Types{kStamped, kStamped}));
    std::vector<std::size_t> robots;
    for (std::size_t t = 0; t < commands_->topics().size(); ++t) {
        if (commands_->topics()[t].name != "/cmd_vel") continue;
        robots.push_back(commands_->topics()[t].robot.index());
        const auto orders = commands_->orders(t, to_cdr(TwistStamped{{}, {{1, 0, 0}, {0, 0, 2}}}));
        ASSERT_TRUE(orders) << orders.error().text();
        EXPECT_EQ(std::get<Command>(orders.value().at(0).action).values,
                  (std::vector<double>{1, 0, 0, 0, 0, 2}));
    }
    EXPECT_EQ(robots, (std::vector<std::size_t>{0, 1}));
}

TEST_F(BridgeTest, ClockAndFramesStayAndMayHaveOtherNamesToo) {
    entry("/world/test/clock", "/clock", kClock, "GZ_TO_ROS");
    entry("/clock", "/sim/clock", kClock, "GZ_TO_ROS");
    entry("/model/vehicle_blue/tf", "/tf", kFrames, "GZ_TO_ROS");
    entry("/model/vehicle_blue/pose", "/vehicle_blue/tf", kFrames, "GZ_TO_ROS");
    entry("/model/vehicle_green/pose_static", "/vehicle_green/tf_static", kFrames, "GZ_TO_ROS");
    entry("/world/test/dynamic_pose/info", "/poses", kFrames, "GZ_TO_ROS");
    show();
    EXPECT_EQ(notices_, Types{});
    EXPECT_EQ(sent("/clock"), Types{kClock});
    EXPECT_EQ(sent("/tf"), Types{kFrames});
    EXPECT_EQ(message<Clock>("/sim/clock").clock.sec, 0);
    const auto all = message<TFMessage>("/poses").transforms;
    const auto own = message<TFMessage>("/vehicle_blue/tf").transforms;
    EXPECT_EQ(all.size(), message<TFMessage>("/tf").transforms.size());
    ASSERT_EQ(own.size(), 3u);  // the base and its wheels
    EXPECT_EQ(all.size(), 2 * own.size());
    for (const TransformStamped& frame : own) EXPECT_TRUE(frame.child_frame_id.starts_with("vehicle_blue/"));
    const auto fixed = message<TFMessage>("/vehicle_green/tf_static", true).transforms;
    EXPECT_FALSE(fixed.empty());
    for (const TransformStamped& frame : fixed)
        EXPECT_TRUE(frame.child_frame_id.starts_with("vehicle_green/")) << frame.child_frame_id;
}

TEST_F(BridgeTest, ATypeThatCannotBeMadeIsReportedWithThoseThatCan) {
    entry("/clock", "/clock", kClock);
    entry("/model/vehicle_blue/odometry", "/odom", kTwist);
    show();
    expect_notice({"b.yaml:3: /model/vehicle_blue/odometry", kTwist, kOdometry});
    EXPECT_EQ(sent("/vehicle_blue/odom"), Types{kOdometry});
}

TEST_F(BridgeTest, ATopicThatIsNotThereIsReportedWithItsNearest) {
    entry("/model/vehicle_blu/cmd_vel", "/cmd_vel", kTwist);
    show();
    expect_notice({"b.yaml:1: /model/vehicle_blu/cmd_vel", "/model/vehicle_blue/cmd_vel"});
    EXPECT_EQ(taken("/cmd_vel"), Types{});
}

TEST_F(BridgeTest, ManyUnknownTopicsAreReportedOnceEach) {
    for (int i = 0; i < 25; ++i) entry("/x" + std::to_string(i), "/y" + std::to_string(i), kTwist);
    show();
    ASSERT_EQ(notices_.size(), 21u);
    EXPECT_NE(notices_.back().find("5 more"), std::string::npos) << notices_.back();
}

TEST_F(BridgeTest, ADirectionWithoutEffectIsReported) {
    entry("/model/vehicle_blue/cmd_vel", "/cmd_vel", kTwist, "GZ_TO_ROS");
    show();
    expect_notice({"b.yaml:1: ", "ROS_TO_GZ"});
    EXPECT_EQ(taken("/vehicle_blue/cmd_vel"), Types{kTwist});
    text_.clear();
    entry("/model/vehicle_blue/odometry", "/odom", kOdometry, "ROS_TO_GZ");
    show();
    expect_notice({"b.yaml:1: ", "GZ_TO_ROS"});
    EXPECT_EQ(sent("/odom"), Types{});
}

TEST_F(BridgeTest, ANameWithTwoTypesIsReported) {
    entry("/model/vehicle_blue/odometry", "/out", kOdometry);
    entry(kLidar, "/out", kScan);
    show();
    expect_notice({"b.yaml:3: ", "/out", kOdometry});
    EXPECT_EQ(sent("/out"), Types{kOdometry});
    EXPECT_EQ(sent("/vehicle_blue/scan"), Types{kScan});
}

TEST_F(BridgeTest, ServicesThatAreNotServedAreReported) {
    service("/world/test/control", "ros_gz_interfaces/srv/ControlWorld");
    service("/world/test/set_pose", "ros_gz_interfaces/srv/SetEntityPose");
    service("/world/test/light_config", "ros_gz_interfaces/srv/ControlWorld");
    show();
    expect_notice({"b.yaml:5: /world/test/light_config", "/world/test/create"});
    text_.clear();
    service("/world/test/create", "ros_gz_interfaces/srv/ControlWorld");
    show();
    expect_notice({"ros_gz_interfaces/srv/SpawnEntity"});
}

TEST_F(BridgeTest, NothingIsMeasuredForTopicsThatNobodyWants) {
    entry("/lidar", "/middle", kScan);
    entry("/model/vehicle_blue/odometry", "/a", kOdometry);
    entry("/model/vehicle_blue/odometry", "/b", kOdometry);
    show();
    topics_->select(std::vector<bool>(topics_->topics().size(), false));
    const auto messages =
        topics_->messages(0, simulation_.states, [](RobotId, std::size_t) -> Result<std::optional<Sample>> {
            ADD_FAILURE() << "a sensor was measured";
            return Error{"no", ""};
        });
    ASSERT_TRUE(messages);
    EXPECT_TRUE(messages.value().empty());
}

TEST(GazeboTopics, NamesAreThoseOfGazebo) {
    ModelSpec model = vehicle();
    DiffDriveSpec drive = test::diff_drive();
    drive.topic = "cmd_vel", drive.output.tf_topic = "/frames";
    model.onboard[0].parameters = drive;
    ForceTorqueSpec joint;
    joint.joint = "left_joint";
    model.links[0].sensors = {sensor("publisher", OdometrySpec{}, "odom"),
                              sensor("states", JointStatesSpec{}, "joints")};
    model.links[1].sensors = {sensor("ft", joint)};
    World world = test::on_plane(model);
    world.instances.back().name = "outer car";
    std::map<std::string, GazeboTopic> topics;
    for (const GazeboTopic& topic : gazebo_topics(*test::compiled(world))) topics[topic.name] = topic;
    const auto kind = [&](const std::string& name) { return topics.at(name).kind; };
    EXPECT_EQ(kind("/cmd_vel"), GazeboTopic::Kind::kCommand);
    EXPECT_EQ(kind("/frames"), GazeboTopic::Kind::kFrames);
    EXPECT_EQ(kind("/odom"), GazeboTopic::Kind::kReading);
    EXPECT_EQ(kind("/model/outer_car/odometry_with_covariance"), GazeboTopic::Kind::kReading);
    EXPECT_EQ(kind("/world/test/model/outer_car/joint_state"), GazeboTopic::Kind::kJointStates);
    EXPECT_EQ(kind("/joints"), GazeboTopic::Kind::kJointStates);
    EXPECT_EQ(kind("/world/test/model/outer_car/joint/left_joint/sensor/ft/forcetorque"),
              GazeboTopic::Kind::kReading);
}

/// The cart of the sensors' tests, in a model within a model.
TEST(GazeboTopics, NestedModelsAndBatteriesHaveTheirPlaces) {
    Model model;
    RobotType type = sensors_test::cart_type();
    type.links[1].name = "tower::mast";
    type.sensors = {{sensor("cell", BatterySensorSpec{}, "cell_1"), LinkId(0U)},
                    {sensor("imu", ImuSpec{}), LinkId(1U)},
                    {sensor("rgbd", RgbdCameraSpec{}), LinkId(1U)}};
    model.name = "w", model.types = {type};
    model.robots = {{"train::cart", TypeId(0U), {}}};
    std::set<std::string> names;
    for (const GazeboTopic& topic : gazebo_topics(model)) names.insert(topic.name);
    const std::string place = "/world/w/model/train/model/cart/model/tower/link/mast/sensor/";
    for (const std::string& name :
         {std::string("/model/train::cart/battery/cell_1/state"), place + "imu/imu", place + "rgbd/image",
          place + "rgbd/depth_image", place + "rgbd/camera_info"})
        EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace roboss::ros2
