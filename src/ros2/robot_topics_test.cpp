// The topics of a world's robots, and what their messages say of a state.
#include "ros2/robot_topics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "physics/dynamics/kinematics.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/sensor_messages.h"
#include "sensors/test_model.h"

namespace roboss::ros2 {
namespace {

using sensors_test::cart_type;
using sensors_test::sensor;

/// Two carts with a laser on the mast, two sonars, a camera, an odometer, which has no messages.
std::shared_ptr<Model> carts() {
    auto model = std::make_shared<Model>();
    RobotType type = cart_type();
    type.links[1].parent = 0, type.links[1].carrier = 0;
    type.links[2].parent = 0, type.links[2].carrier = 1;
    LaserSpec laser;
    laser.samples = 3, laser.min_angle = -1, laser.max_angle = 1, laser.range_max = 5;
    ColorCameraSpec camera;
    camera.optics.width = 2, camera.optics.height = 1;
    const auto mount = [&](const SensorSpec& spec, std::size_t link) {
        type.sensors.push_back({spec, LinkId(link)});
    };
    mount(sensor("laser", laser, {{0, 0, 0.1}, {}}), 1);
    type.sensors.back().spec.update_rate_hz = 10;
    mount(sensor("left sonar", SonarSpec{}), 0);
    mount(sensor("right", SonarSpec{}), 0);
    mount(sensor("eye", camera), 1);
    mount(sensor("steps", OdometerSpec{}), 0);
    model->dt_s = 0.01;
    model->types = {type};
    model->robots = {{"cart 1", TypeId(std::size_t{0}), {}}, {"inner::cart", TypeId(std::size_t{0}), {}}};
    return model;
}

/// Both at the same place, their wheels turning.
std::vector<RobotState> moving_states() {
    std::vector<RobotState> states(2);
    for (RobotState& state : states)
        state.q = {1, 2, 3, 1, 0, 0, 0, 0.25}, state.v = {0, 0, 0, 0, 0, 0, 4}, state.motors.resize(1);
    return states;
}

Result<std::optional<Sample>> measured(RobotId, std::size_t number) {
    LaserReading laser;
    laser.samples = 3, laser.vertical_samples = 1;
    laser.ranges = {1, std::numeric_limits<double>::infinity(), 2.5};
    CameraReading camera;
    camera.color = Image<std::uint8_t>(1, 2, 3, 7), camera.intrinsics = {1.5, 1.6, 1, 0.5};
    SonarReading sonar;
    sonar.range = 0.5;
    if (number == 0) return std::optional<Sample>(laser);
    if (number == 3) return std::optional<Sample>(camera);
    return std::optional<Sample>(sonar);
}

std::map<std::string, std::string> by_topic(const RobotTopics& topics,
                                            const std::vector<RobotTopics::Message>& messages) {
    std::map<std::string, std::string> found;
    for (const RobotTopics::Message& message : messages)
        found[topics.topics()[message.topic].name] = message.bytes;
    return found;
}

TEST(RobotTopics, NamesAreThoseThatRosAllows) {
    const RobotTopics topics(carts());
    std::vector<std::string> names;
    for (const Topic& topic : topics.topics()) names.push_back(topic.name);
    EXPECT_EQ(names,
              (std::vector<std::string>{
                  "/clock", "/tf", "/tf_static", "/cart_1/joint_states", "/cart_1/robot_description",
                  "/cart_1/scan", "/cart_1/left_sonar/range", "/cart_1/right/range", "/cart_1/eye/image_raw",
                  "/cart_1/eye/camera_info", "/inner/cart/joint_states", "/inner/cart/robot_description",
                  "/inner/cart/scan", "/inner/cart/left_sonar/range", "/inner/cart/right/range",
                  "/inner/cart/eye/image_raw", "/inner/cart/eye/camera_info"}));
    EXPECT_EQ(topics.left_out(), (std::vector<std::string>{"cart 1.steps", "inner::cart.steps"}));
}

TEST(RobotTopics, MessagesSayWhatTheStateAndTheReadingsSay) {
    const std::shared_ptr<Model> model = carts();
    RobotTopics topics(model);
    const auto all = topics.messages(150, moving_states(), measured);
    ASSERT_TRUE(all);
    auto found = by_topic(topics, all.value());
    EXPECT_EQ(from_cdr<Clock>(found["/clock"]).value().clock.sec, 1);
    EXPECT_EQ(from_cdr<Clock>(found["/clock"]).value().clock.nanosec, 500'000'000u);

    const auto joints = from_cdr<JointStateMessage>(found["/cart_1/joint_states"]).value();
    EXPECT_EQ(joints.name, std::vector<std::string>{"axle"});
    EXPECT_EQ(joints.position, std::vector<double>{0.25});
    EXPECT_EQ(joints.velocity, std::vector<double>{4});

    const auto scan = from_cdr<LaserScan>(found["/cart_1/scan"]).value();
    EXPECT_EQ(scan.header.frame_id, "cart_1/mast/laser");
    EXPECT_EQ(scan.ranges, (std::vector<float>{1, std::numeric_limits<float>::infinity(), 2.5f}));
    EXPECT_FLOAT_EQ(scan.angle_increment, 1);
    EXPECT_FLOAT_EQ(scan.scan_time, 0.1f);

    const auto image = from_cdr<ImageMessage>(found["/inner/cart/eye/image_raw"]).value();
    EXPECT_EQ(image.encoding, "rgb8");
    EXPECT_EQ(image.step, 6u);
    EXPECT_EQ(image.data.size(), 6u);
    EXPECT_EQ(image.header.frame_id, "inner/cart/mast/eye_optical_frame");
    const auto info = from_cdr<CameraInfo>(found["/inner/cart/eye/camera_info"]).value();
    EXPECT_EQ(info.k, (std::array<double, 9>{1.5, 0, 1, 0, 1.6, 0.5, 0, 0, 1}));

    const auto frames = from_cdr<TFMessage>(found["/tf"]).value();
    ASSERT_EQ(frames.transforms.size(), 4u);  // of each cart its base in the world, its wheel on the base
    EXPECT_EQ(frames.transforms[0].header.frame_id, "world");
    EXPECT_EQ(frames.transforms[0].child_frame_id, "cart_1/cart");
    EXPECT_EQ(frames.transforms[0].transform.translation.z, 3);
    EXPECT_EQ(frames.transforms[1].child_frame_id, "cart_1/wheel");
    EXPECT_NEAR(frames.transforms[1].transform.rotation.y, std::sin(0.125), 1e-15);
}

TEST(RobotTopics, ADescriptionNamesTheLinksAsTheFramesDo) {
    const RobotTopics topics(carts());
    const std::string urdf =
        from_cdr<String>(by_topic(topics, topics.latched(0))["/cart_1/robot_description"]).value().data;
    for (const char* part :
         {R"(<robot name="cart_1">)", R"(<link name="cart_1/wheel">)", R"(<box size="0.4 0.2 0.1"/>)",
          R"(<joint name="axle" type="continuous"><parent link="cart_1/cart"/><child link="cart_1/wheel"/>)",
          R"(<origin xyz="0.5 0 0" rpy="0 0 0"/><axis xyz="0 1 0"/>)",
          R"(<joint name="mast_joint" type="fixed">)"})
        EXPECT_NE(urdf.find(part), std::string::npos) << part << "\n" << urdf;
}

TEST(RobotTopics, ImagesHaveAFrameThatLooksAlongZ) {
    const RobotTopics topics(carts());
    const auto frames = from_cdr<TFMessage>(topics.latched(0).at(0).bytes).value();
    const auto& all = frames.transforms;
    const auto eye = std::find_if(all.begin(), all.end(), [](const TransformStamped& frame) {
        return frame.child_frame_id == "cart_1/mast/eye_optical_frame";
    });
    ASSERT_NE(eye, all.end());
    const auto& q = eye->transform.rotation;
    const Vec3 ahead = to_matrix(Quat{q.w, q.x, q.y, q.z}) * Vec3{0, 0, 1};
    const Vec3 right = to_matrix(Quat{q.w, q.x, q.y, q.z}) * Vec3{1, 0, 0};
    EXPECT_NEAR(ahead.x, 1, 1e-15);
    EXPECT_NEAR(right.y, -1, 1e-15);
}

TEST(RobotTopics, SensorsWithARateHaveMessagesWhenASampleIsDue) {
    const std::shared_ptr<Model> model = carts();
    RobotTopics topics(model);
    int scans = 0, ranges = 0;
    for (Tick tick = 0; tick < 100; tick += 2) {  // 10 samples a second are due in a second of 50 calls
        const auto messages = topics.messages(tick, moving_states(), measured);
        ASSERT_TRUE(messages);
        const auto found = by_topic(topics, messages.value());
        scans += static_cast<int>(found.count("/cart_1/scan"));
        ranges += static_cast<int>(found.count("/cart_1/right/range"));
    }
    EXPECT_EQ(scans, 10);
    EXPECT_EQ(ranges, 50);
}

/// A cart that drives by an odometry, too.
std::shared_ptr<Model> odometric_carts() {
    const std::shared_ptr<Model> model = carts();
    model->types[0].sensors.push_back({sensor("wheels", WheelOdometrySpec{}), LinkId(std::size_t{0})});
    return model;
}

Result<std::optional<Sample>> with_odometry(RobotId robot, std::size_t number) {
    if (number != 5) return measured(robot, number);
    WheelOdometryReading wheels;
    wheels.x = 4, wheels.y = 5, wheels.heading = 1;
    return std::optional<Sample>(wheels);
}

TEST(RobotTopics, PlainFramesStandWhereTheOdometrySeesThem) {
    TopicOptions options;
    options.plain_frames = true;
    RobotTopics topics(odometric_carts(), options);
    const auto all = topics.messages(0, moving_states(), with_odometry);
    ASSERT_TRUE(all);
    auto found = by_topic(topics, all.value());
    EXPECT_FALSE(found.contains("/tf"));
    const auto frames = from_cdr<TFMessage>(found["/inner/cart/tf"]).value().transforms;
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].header.frame_id, "odom");
    EXPECT_EQ(frames[0].child_frame_id, "cart");
    EXPECT_EQ(frames[0].transform.translation.x, 4);
    EXPECT_NEAR(frames[0].transform.rotation.z, std::sin(0.5), 1e-15);
    EXPECT_EQ(frames[1].header.frame_id, "cart");
    EXPECT_EQ(frames[1].child_frame_id, "wheel");
    const auto odometry = from_cdr<Odometry>(found["/cart_1/odom"]).value();
    EXPECT_EQ(odometry.header.frame_id, "odom");
    EXPECT_EQ(odometry.child_frame_id, "cart");
    EXPECT_EQ(odometry.pose.pose.position.y, 5);

    auto latched = by_topic(topics, topics.latched(0));
    const std::string urdf = from_cdr<String>(latched["/cart_1/robot_description"]).value().data;
    EXPECT_NE(urdf.find(R"(<link name="wheel">)"), std::string::npos);
    const TFMessage fixed = from_cdr<TFMessage>(latched["/cart_1/tf_static"]).value();
    for (const TransformStamped& frame : fixed.transforms) {
        EXPECT_NE(frame.header.frame_id, "world") << "a localization says where odom is";
        EXPECT_EQ(frame.child_frame_id.find("cart_1"), std::string::npos);
    }
}

TEST(RobotTopics, AFrameThatTheFileGivesMayBeThatOfALink) {
    const std::shared_ptr<Model> model = carts();
    model->types[0].sensors[0].spec.ros_frame = "wheel", model->types[0].sensors[3].spec.ros_frame = "mast";
    TopicOptions options;
    options.plain_frames = true;
    RobotTopics topics(model, options);
    const auto all = topics.messages(0, moving_states(), measured);
    ASSERT_TRUE(all);
    auto found = by_topic(topics, all.value());
    EXPECT_EQ(from_cdr<LaserScan>(found["/cart_1/scan"]).value().header.frame_id, "wheel");
    EXPECT_EQ(from_cdr<ImageMessage>(found["/cart_1/eye/image_raw"]).value().header.frame_id, "mast");
    auto latched = by_topic(topics, topics.latched(0));
    const TFMessage fixed = from_cdr<TFMessage>(latched["/cart_1/tf_static"]).value();
    for (const TransformStamped& frame : fixed.transforms) EXPECT_NE(frame.child_frame_id, "wheel");
}

TEST(RobotTopics, TheRobotAtTheRootHasNoNamespace) {
    TopicOptions options;
    options.root = "inner::cart";
    RobotTopics topics(odometric_carts(), options);
    const auto all = topics.messages(0, moving_states(), with_odometry);
    ASSERT_TRUE(all);
    auto found = by_topic(topics, all.value());
    EXPECT_TRUE(found.contains("/scan") && found.contains("/joint_states") && found.contains("/cart_1/scan"));
    std::vector<std::string> children;
    const TFMessage moving = from_cdr<TFMessage>(found["/tf"]).value();
    for (const TransformStamped& frame : moving.transforms)
        children.push_back(frame.header.frame_id + ">" + frame.child_frame_id);
    EXPECT_EQ(children, (std::vector<std::string>{"world>cart_1/cart", "cart_1/cart>cart_1/wheel",
                                                  "odom>cart", "cart>wheel"}));
}

TEST(RobotTopics, GroundTruthIsInTheWorldAndItsVelocityInTheBase) {
    TopicOptions options;
    options.ground_truth = true;
    RobotTopics topics(carts(), options);
    std::vector<RobotState> states = moving_states();
    const double half = std::sqrt(0.5);
    states[0].q[3] = half, states[0].q[6] = half;  // turned by 90 degrees about z
    states[0].v = {0, 0, 0.5, 1, 2, 0, 0};
    const Twist twist = link_twist(cart_type(), states[0], LinkId(std::size_t{0}));
    const auto all = topics.messages(0, states, measured);
    ASSERT_TRUE(all);
    const auto truth = from_cdr<Odometry>(by_topic(topics, all.value())["/cart_1/ground_truth"]).value();
    EXPECT_EQ(truth.header.frame_id, "world");
    EXPECT_EQ(truth.child_frame_id, "cart_1/cart");
    EXPECT_EQ(truth.pose.pose.position.z, 3);
    EXPECT_NEAR(truth.twist.twist.linear.x, twist.linear.y, 1e-12) << "its x is the world's y";
    EXPECT_NEAR(truth.twist.twist.linear.y, -twist.linear.x, 1e-12);
    EXPECT_NEAR(truth.twist.twist.angular.z, twist.angular.z, 1e-12);
    EXPECT_GT(norm(twist.linear), 1) << "the test needs a motion";
}

TEST(RobotTopics, AFleetIsOneMessage) {
    TopicOptions options;
    options.fleet = true;
    RobotTopics topics(carts(), options);
    EXPECT_EQ(from_cdr<String>(by_topic(topics, topics.latched(0))["/fleet/names"]).value().data,
              "cart_1\ninner/cart");
    const auto all = topics.messages(0, moving_states(), measured);
    ASSERT_TRUE(all);
    auto found = by_topic(topics, all.value());
    const auto states = from_cdr<Float64MultiArray>(found["/fleet/states"]).value();
    ASSERT_EQ(states.data.size(), 26u);
    EXPECT_EQ(states.layout.dim[1].size, 13u);
    EXPECT_EQ(states.data[13], 1);  // x of the second
    EXPECT_EQ(states.data[15], 3);
    EXPECT_EQ(from_cdr<PoseArray>(found["/fleet/poses"]).value().poses.size(), 2u);
    EXPECT_EQ(from_cdr<JointStateMessage>(found["/fleet/joint_states"]).value().name,
              (std::vector<std::string>{"cart_1/axle", "inner/cart/axle"}));
    const auto scans = from_cdr<Float32MultiArray>(found["/fleet/scans"]).value();
    ASSERT_EQ(scans.data.size(), 6u);
    EXPECT_EQ(scans.data[5], 2.5f);
    const auto later = topics.messages(1, moving_states(), measured);  // no scan is due after 10 ms
    ASSERT_TRUE(later);
    EXPECT_FALSE(by_topic(topics, later.value()).contains("/fleet/scans"));
}

TEST(RobotTopics, WhatIsNotWantedIsNotMeasured) {
    const std::shared_ptr<Model> model = carts();
    RobotTopics topics(model);
    std::vector<bool> wanted(topics.topics().size(), false);
    wanted[3] = true;
    topics.select(wanted);
    const auto messages =
        topics.messages(0, moving_states(), [](RobotId, std::size_t) -> Result<std::optional<Sample>> {
            ADD_FAILURE() << "a sensor was measured";
            return Error{"no", ""};
        });
    ASSERT_TRUE(messages);
    ASSERT_EQ(messages.value().size(), 1u);
    EXPECT_EQ(messages.value().front().topic, 3u);
}

}  // namespace
}  // namespace roboss::ros2
