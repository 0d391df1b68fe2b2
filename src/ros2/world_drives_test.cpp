// Drives of a file of ros2_control in a World: what they become, whose they are, how they drive, and what
// nodes see of them.
#include "ros2/world_drives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <support/drives.h>

#include "ros2/drive_controller.h"
#include "ros2/robot_commands.h"
#include "ros2/robot_controllers.h"
#include "ros2/robot_names.h"
#include "ros2/robot_topics.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {
namespace {

/// A file with the drive of test::two_wheeler(). `space`: of its nodes; `more`: parameters; `left`: the
/// joint.
std::string base_text(const std::string& space = "", const std::string& more = "",
                      const std::string& left = "left_joint") {
    const std::string in = space.empty() ? "" : "/" + space + "/";
    return in +
           "controller_manager: {ros__parameters: {base: {type: "
           "diff_drive_controller/DiffDriveController}}}\n" +
           in + "base: {ros__parameters: {left_wheel_names: [" + left +
           "], right_wheel_names: [right_joint], wheel_separation: 0.5, wheel_radius: 0.1" + more + "}}\n";
}

TopicOptions with_controllers(const std::string& text) {
    Result<Controllers> read = parse_controllers("c.yaml", text);
    EXPECT_TRUE(read) << read.error().text();
    TopicOptions options;
    options.controllers = std::make_shared<const Controllers>(read ? read.value() : Controllers{});
    return options;
}

/// The World with the drives of the file.
World driven(World world, const TopicOptions& options) {
    add_drives(*options.controllers, options.root, "", world);
    return world;
}

std::vector<std::string> topic_names(const RobotCommands& commands) {
    std::vector<std::string> names;
    for (const CommandTopic& topic : commands.topics()) names.push_back(topic.name);
    return names;
}

std::size_t place_of(const RobotCommands& commands, const std::string& name) {
    const std::vector<std::string> names = topic_names(commands);
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return ADD_FAILURE() << "no topic " << name, 0;
    return static_cast<std::size_t>(at - names.begin());
}

/// Two robots of one prototype on a plane, 3 m apart.
World two_robots() {
    World world = test::on_plane(test::two_wheeler());
    world.instances.back().name = "left";
    world.instances.push_back({"right", world.prototypes.size() - 1, {{0, 3, 0}, {}}, {}});
    return world;
}

TEST(WorldDrives, AreOnBoardWithTimeoutAndOdometry) {
    const World world = driven(test::on_plane(test::two_wheeler()), with_controllers(base_text()));
    const ModelSpec& model = world.prototypes[world.instances.back().prototype];
    ASSERT_EQ(model.onboard.size(), 2u);
    const auto* timeout = std::get_if<CommandTimeoutSpec>(&model.onboard[0].parameters);
    ASSERT_NE(timeout, nullptr) << "it stands before the drive";
    EXPECT_EQ(timeout->timeout, 0.5);
    EXPECT_EQ(timeout->topic, "base/cmd_vel");
    const auto* drive = std::get_if<DiffDriveSpec>(&model.onboard[1].parameters);
    ASSERT_NE(drive, nullptr);
    EXPECT_EQ(drive->wheel_radius, 0.1);
    EXPECT_EQ(model.onboard[1].name, "base");
    EXPECT_EQ(model.onboard[1].where.file, "c.yaml");
    EXPECT_EQ(model.onboard[1].where.line, 1);
    ASSERT_EQ(model.links[0].sensors.size(), 1u);
    const SensorSpec& odometry = model.links[0].sensors[0];
    ASSERT_NE(odometry.as<WheelOdometrySpec>(), nullptr);
    EXPECT_EQ(odometry.as<WheelOdometrySpec>()->controller_kind,
              static_cast<int>(DiffDriveSpec::kKind.number));
    EXPECT_EQ(odometry.as<WheelOdometrySpec>()->controller, 0);
    EXPECT_EQ(odometry.update_rate_hz, 50);
    EXPECT_DOUBLE_EQ(odometry.X_LS.p.z, -test::kWheelRadius) << "in the frame of the model";
    const auto model_of = [](const World& of) { return test::compiled(of)->hash; };
    EXPECT_NE(model_of(world), model_of(test::on_plane(test::two_wheeler()))) << "the hash has it";
    const World untimed =
        driven(test::on_plane(test::two_wheeler()), with_controllers(base_text("", ", cmd_vel_timeout: 0")));
    EXPECT_EQ(untimed.prototypes[untimed.instances.back().prototype].onboard.size(), 1u);
}

TEST(WorldDrives, FollowAVelocityAndStopWhenItCeases) {
    const TopicOptions options = with_controllers(base_text());
    test::Simulation sim(driven(test::on_plane(test::two_wheeler()), options));
    const RobotCommands commands(sim.model, options);
    const std::size_t topic = place_of(commands, "/robot/base/cmd_vel");
    EXPECT_EQ(commands.topics()[topic].type->name, "geometry_msgs/msg/TwistStamped");
    sim.run(0.5);
    const double speed = 0.3, turn = 0.4;
    const auto orders = commands.orders(topic, to_cdr(TwistStamped{{}, {{speed, 0, 0}, {0, 0, turn}}}));
    ASSERT_TRUE(orders) << orders.error().text();
    ASSERT_EQ(orders.value().size(), 1u);
    const Order order{sim.tick, ClientId(std::size_t{0}), 0, RobotId(std::size_t{0}),
                      orders.value()[0].action};
    sim.step({&order, 1});
    sim.run(0.2);
    // v = (r / 2) (left + right), w = r / d (right - left)
    const double across = 0.5 * turn * test::kSeparation;
    EXPECT_NEAR(test::joint_velocity(sim, "left_joint"), (speed - across) / test::kWheelRadius, 1e-3);
    EXPECT_NEAR(test::joint_velocity(sim, "right_joint"), (speed + across) / test::kWheelRadius, 1e-3);
    const test::Stand from = test::stand(sim);
    sim.run(0.25);
    const test::Stand to = test::stand(sim);
    EXPECT_NEAR(to.heading - from.heading, turn * 0.25, 2e-3);
    EXPECT_NEAR(std::hypot(to.x - from.x, to.y - from.y), speed * 0.25, 2e-3);
    sim.run(0.5);
    EXPECT_NEAR(test::joint_velocity(sim, "left_joint"), 0, 1e-3) << "the command is older than 0.5 s";
    EXPECT_NEAR(test::joint_velocity(sim, "right_joint"), 0, 1e-3);
}

TEST(WorldDrives, BelongToEachRobotThatHasTheirWheels) {
    const TopicOptions options = with_controllers(base_text("", ", use_stamped_vel: false"));
    World world = driven(two_robots(), options);
    EXPECT_EQ(world.prototypes.size(), two_robots().prototypes.size()) << "they still share one";
    test::place(world, test::pendulum(), "swing", {{0, 6, 0}, {}});
    const auto model = test::compiled(driven(std::move(world), options));
    const RobotCommands commands(model, options);
    const std::vector<std::string> names = topic_names(commands);
    EXPECT_EQ(std::ranges::count(names, "/left/base/cmd_vel_unstamped"), 1) << "a second call adds nothing";
    EXPECT_EQ(std::ranges::count(names, "/right/base/cmd_vel_unstamped"), 1);
    EXPECT_EQ(std::ranges::count(names, "/swing/position_controller/commands"), 1);
    EXPECT_EQ(commands.topics()[place_of(commands, "/left/base/cmd_vel_unstamped")].type->name,
              "geometry_msgs/msg/Twist");
}

TEST(WorldDrives, OfANamespaceBelongToTheRobotOfThatName) {
    const TopicOptions options = with_controllers(base_text("right"));
    const auto model = test::compiled(driven(two_robots(), options));
    const std::vector<std::string> names = topic_names(RobotCommands(model, options));
    EXPECT_EQ(std::ranges::count(names, "/right/base/cmd_vel"), 1);
    EXPECT_EQ(std::ranges::count(names, "/left/base/cmd_vel"), 0);
    EXPECT_EQ(std::ranges::count(names, "/left/velocity_controller/commands"), 1) << "its usual ones";
    EXPECT_TRUE(controller_notices(*options.controllers, *model, robot_names(*model, "")).empty());
    const TopicOptions alike = with_controllers(base_text());
    World named = test::on_plane(test::two_wheeler());
    named.instances.back().name = "base";
    const RobotCommands commands(test::compiled(driven(named, alike)), alike);
    EXPECT_EQ(commands.topics()[0].name, "/base/base/cmd_vel") << "robot and controller have one name";
    World added = test::on_plane(test::two_wheeler());
    added.instances.erase(added.instances.begin());  // the plane
    add_drives(*options.controllers, "", "right", added);
    EXPECT_EQ(added.prototypes[added.instances[0].prototype].onboard.size(), 2u) << "by the name it gets";
}

TEST(WorldDrives, ThatNoRobotHasAreReported) {
    const auto notices = [](const TopicOptions& options, World world) {
        const auto model = test::compiled(world);
        return controller_notices(*options.controllers, *model, robot_names(*model, ""));
    };
    const World world = test::on_plane(test::two_wheeler());
    const TopicOptions misspelt = with_controllers(base_text("", "", "lfet_joint"));
    const World without = driven(world, misspelt);
    EXPECT_TRUE(without.prototypes[without.instances.back().prototype].onboard.empty());
    EXPECT_EQ(
        notices(misspelt, without),
        std::vector<std::string>{"c.yaml:1: the controller 'base' has no effect: no robot has the joint "
                                 "'lfet_joint'; did you mean 'left_joint'? [no-joint]"});
    const TopicOptions options = with_controllers(base_text("", ", base_frame_id: base_link"));
    const auto late = notices(options, world);
    ASSERT_EQ(late.size(), 1u);
    EXPECT_TRUE(
        late[0].starts_with("c.yaml:1: the controller 'base' has no effect: no robot has it on board"))
        << late[0];
    EXPECT_EQ(
        notices(options, driven(world, options)),
        std::vector<std::string>{"c.yaml:2: base_frame_id of 'base' has no effect: the base of the robot is "
                                 "its link 'chassis' [controller-parameter]"});
    const World own = test::on_plane(test::with_onboard(test::two_wheeler(), test::diff_drive()));
    const World kept = driven(own, options);
    EXPECT_EQ(kept.prototypes[kept.instances.back().prototype].onboard.size(), 1u)
        << "a plugin moves the wheels";
}

TEST(WorldDrives, LeaveOtherJointsToTheirControllers) {
    ModelSpec model = test::two_wheeler();
    model.links.push_back(test::link("arm", 1, test::box_inertia(1, {0.1, 0.1, 0.3}), {{0, 0, 0.4}, {}}));
    model.joints.push_back(
        test::joint(JointSpecKind::kRevolute, "shoulder", "chassis", "arm", {{0, 0, 0.3}, {}}, {0, 1, 0}));
    const TopicOptions options = with_controllers(base_text() + R"(
/**/controller_manager: {ros__parameters: {
  lift: {type: velocity_controllers/JointGroupVelocityController},
  wheels: {type: velocity_controllers/JointGroupVelocityController}}}
/**/lift: {ros__parameters: {joints: [shoulder]}}
/**/wheels: {ros__parameters: {joints: [left_joint, shoulder]}}
)");
    const auto compiled = test::compiled(driven(test::on_plane(model), options));
    const RobotCommands commands(compiled, options);
    EXPECT_EQ(topic_names(commands),
              (std::vector<std::string>{"/robot/base/cmd_vel", "/robot/enable", "/robot/lift/commands"}));
    const auto notices = controller_notices(*options.controllers, *compiled, robot_names(*compiled, ""));
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("'wheels' has no effect"), std::string::npos) << notices[0];
}

TEST(WorldDrives, HaveTheOdometryOfTheFile) {
    const auto said = [](TopicOptions options, bool plain) {
        options.plain_frames = plain;
        const auto model = test::compiled(driven(test::on_plane(test::two_wheeler()), options));
        RobotTopics topics(model, options);
        const std::vector<RobotState> states{initial_state(*model, RobotId(std::size_t{0}))};
        const auto measure = [](RobotId, std::size_t) -> Result<std::optional<Sample>> {
            WheelOdometryReading reading;
            reading.x = 1.5, reading.linear = 0.25;
            return std::optional<Sample>(reading);
        };
        const auto all = topics.messages(0, states, measure);
        EXPECT_TRUE(all);
        std::map<std::string, std::string> found;
        for (const RobotTopics::Message& message : all.value())
            found[topics.topics()[message.topic].name] = message.bytes;
        return found;
    };
    const std::string more =
        ", odom_frame_id: wheels, pose_covariance_diagonal: [1, 2, 3, 4, 5, 6], "
        "twist_covariance_diagonal: [7, 0, 0, 0, 0, 8]";
    const auto named = said(with_controllers(base_text("", more)), false);
    ASSERT_TRUE(named.contains("/robot/base/odom"));
    const auto odometry = from_cdr<Odometry>(named.at("/robot/base/odom")).value();
    EXPECT_EQ(odometry.header.frame_id, "robot/wheels");
    EXPECT_EQ(odometry.child_frame_id, "robot/chassis");
    EXPECT_EQ(odometry.pose.pose.position.x, 1.5);
    EXPECT_EQ(odometry.twist.twist.linear.x, 0.25);
    EXPECT_EQ(odometry.pose.covariance[0], 1);
    EXPECT_EQ(odometry.pose.covariance[35], 6);
    EXPECT_EQ(odometry.pose.covariance[1], 0);
    EXPECT_EQ(odometry.twist.covariance[0], 7);
    EXPECT_EQ(odometry.twist.covariance[35], 8);
    // Where the base stands in plain frames: in the odometry's, or nowhere.
    const auto parents_of_base = [&](const std::string& parameters) {
        const auto plain = said(with_controllers(base_text("", parameters)), true);
        const auto frames = from_cdr<TFMessage>(plain.at("/robot/tf")).value();
        std::vector<std::string> parents;
        for (const TransformStamped& frame : frames.transforms)
            if (frame.child_frame_id == "chassis") parents.push_back(frame.header.frame_id);
        return parents;
    };
    EXPECT_EQ(parents_of_base(more), std::vector<std::string>{"wheels"});
    EXPECT_EQ(parents_of_base(more + ", enable_odom_tf: false"), std::vector<std::string>{});
}

}  // namespace
}  // namespace roboss::ros2
