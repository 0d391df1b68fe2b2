// Messages become the orders that they ask for.
#include "ros2/robot_commands.h"

#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

#include "ros2/robot_controllers.h"
#include "ros2/robot_names.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {
namespace {

class Commands : public testing::Test {
  protected:
    void show(ModelSpec model, const TopicOptions& options = {}) {
        show(test::on_plane(std::move(model)), options);
    }
    void show(World world, const TopicOptions& options) {
        model_ = test::compiled(std::move(world));
        commands_.emplace(model_, options);
    }
    std::size_t find(const std::string& name) const {
        for (std::size_t t = 0; t < commands_->topics().size(); ++t)
            if (commands_->topics()[t].name == name) return t;
        ADD_FAILURE() << "no topic " << name;
        return 0;
    }
    std::string type_of_topic(const std::string& name) const {
        return commands_->topics()[find(name)].type->name;
    }
    template <Message M>
    Result<std::vector<RobotOrder>> orders(const std::string& name, const M& message) const {
        return commands_->orders(find(name), to_cdr(message));
    }
    /// The values of the only command that the message is.
    template <Message M>
    std::vector<double> values(const std::string& name, const M& message) const {
        const Result<std::vector<RobotOrder>> found = orders(name, message);
        if (!found || found.value().size() != 1)
            return ADD_FAILURE() << "not one order", std::vector<double>{};
        return std::get<Command>(found.value().front().action).values;
    }
    std::string refusal(const Result<std::vector<RobotOrder>>& orders) const {
        return orders ? "" : orders.error().text();
    }
    std::shared_ptr<const Model> model_;
    std::optional<RobotCommands> commands_;
};

TEST_F(Commands, ADriveTakesVelocitiesAndASwitch) {
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()));
    EXPECT_EQ(type_of_topic("/robot/cmd_vel"), "geometry_msgs/msg/Twist");
    EXPECT_EQ(values("/robot/cmd_vel", TwistMessage{{1, 2, 3}, {4, 5, 6}}),
              (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(type_of_topic("/robot/enable"), "std_msgs/msg/Bool");
    EXPECT_EQ(values("/robot/enable", Bool{true}), std::vector{1.0});
}

TEST_F(Commands, AreInTheNamespaceOfTheirRobotWhateverTheFileSays) {
    for (const auto& [written, name] :
         {std::pair{"/robot/go", "/robot/go"}, {"go", "/robot/go"}, {"/a/b", "/robot/a/b"}}) {
        DiffDriveSpec drive = test::diff_drive();
        drive.topic = written;
        show(test::with_onboard(test::two_wheeler(), drive));
        EXPECT_EQ(type_of_topic(name), "geometry_msgs/msg/Twist") << written;
    }
    RosDiffDriveSpec classic;
    classic.left = {"left_joint"}, classic.right = {"right_joint"};
    classic.separations = {0.5}, classic.diameters = {0.2};
    classic.ros.ros_namespace = "demo";
    show(test::with_onboard(test::two_wheeler(), classic));
    EXPECT_EQ(type_of_topic("/demo/cmd_vel"), "geometry_msgs/msg/Twist") << "a namespace of the file";
}

TEST_F(Commands, VelocitiesAreStampedWhereThatIsAsked) {
    TopicOptions options;
    options.stamped = true;
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()), options);
    EXPECT_EQ(type_of_topic("/robot/cmd_vel"), "geometry_msgs/msg/TwistStamped");
    EXPECT_EQ(values("/robot/cmd_vel", TwistStamped{{}, {{1, 0, 0}, {0, 0, 2}}}),
              (std::vector<double>{1, 0, 0, 0, 0, 2}));
}

TEST_F(Commands, AVelocityTakesTheOtherTypeWhenToldTo) {
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()));
    const std::size_t drive = find("/robot/cmd_vel");
    EXPECT_TRUE(commands_->takes(drive, TwistStamped::kName));
    EXPECT_FALSE(commands_->takes(drive, Bool::kName));
    EXPECT_FALSE(commands_->takes(find("/robot/enable"), TwistStamped::kName));
    commands_->change_type(drive);
    EXPECT_EQ(type_of_topic("/robot/cmd_vel"), "geometry_msgs/msg/TwistStamped");
    EXPECT_EQ(values("/robot/cmd_vel", TwistStamped{{}, {{1, 0, 0}, {0, 0, 2}}}),
              (std::vector<double>{1, 0, 0, 0, 0, 2}));
    commands_->change_type(drive);
    EXPECT_EQ(values("/robot/cmd_vel", TwistMessage{{3, 0, 0}, {}}), (std::vector<double>{3, 0, 0, 0, 0, 0}));
}

TEST_F(Commands, TheRobotAtTheRootHasNoNamespace) {
    TopicOptions options;
    options.root = "robot";
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()), options);
    EXPECT_EQ(type_of_topic("/cmd_vel"), "geometry_msgs/msg/Twist");
}

TEST_F(Commands, AFleetIsDrivenByRows) {
    TopicOptions options;
    options.fleet = true;
    World world = test::on_plane(test::with_onboard(test::two_wheeler(), test::diff_drive()));
    test::place(world, test::two_wheeler(), "idle", {{0, 3, 0}, {}});
    test::place(world, test::with_onboard(test::two_wheeler(), test::diff_drive()), "third", {{0, 6, 0}, {}});
    show(std::move(world), options);
    Float64MultiArray rows;
    rows.data = {1, 2, 3, 4, 5, 6};
    auto found = orders("/fleet/cmd_vel", rows);
    ASSERT_TRUE(found) << found.error().text();
    ASSERT_EQ(found.value().size(), 2u) << "the second robot takes no velocity";
    EXPECT_EQ(found.value()[1].robot, RobotId(2u));
    EXPECT_EQ(std::get<Command>(found.value()[1].action).values, (std::vector<double>{5, 0, 0, 0, 0, 6}));
    rows.data = std::vector<double>(18, 7);
    rows.data[12] = std::numeric_limits<double>::quiet_NaN();
    found = orders("/fleet/cmd_vel", rows);
    ASSERT_TRUE(found);
    ASSERT_EQ(found.value().size(), 1u) << "NaN: no order";
    EXPECT_EQ(std::get<Command>(found.value()[0].action).values, std::vector<double>(6, 7));
    rows.data.pop_back();
    EXPECT_NE(refusal(orders("/fleet/cmd_vel", rows)).find("17 numbers for 3 robots"), std::string::npos);
}

TEST_F(Commands, ATrajectoryNamesItsJointsInAnyOrder) {
    JointTrajectoryControllerSpec controller;
    controller.joints = {"left_joint", "right_joint"};
    show(test::with_onboard(test::two_wheeler(), controller));
    JointTrajectory trajectory;
    trajectory.joint_names = {"right_joint", "left_joint"};
    trajectory.points = {{{1, 2}, {3, 4}, {}, {}, {0, 500'000'000}}, {{5, 6}, {}, {}, {}, {1, 0}}};
    EXPECT_EQ(values("/robot/joint_trajectory", trajectory),
              (std::vector<double>{0.5, 2, 4, 0, 1, 3, 0, 1, 6, 0, 0, 5, 0, 0}));

    trajectory.points[1].time_from_start = {0, 500'000'000};
    EXPECT_NE(refusal(orders("/robot/joint_trajectory", trajectory)).find("ascend"), std::string::npos);
    trajectory.joint_names[1] = "arm";
    EXPECT_NE(refusal(orders("/robot/joint_trajectory", trajectory)).find("left_joint"), std::string::npos);
}

TEST_F(Commands, RobotsWithoutControllersTakeSetpointsOfTheirJoints) {
    show(test::two_wheeler());
    Float64MultiArray message;
    message.data = {0.5, -1};
    const auto found = orders("/robot/velocity_controller/commands", message);
    ASSERT_TRUE(found) << found.error().text();
    ASSERT_EQ(found.value().size(), 2u);
    EXPECT_EQ(found.value()[1].action, Action(SetJoint{JointId(1u), 0, MotorMode::kVelocity, -1, -1}));
    message.data = {1};
    EXPECT_NE(refusal(orders("/robot/effort_controller/commands", message)).find("left_joint, right_joint"),
              std::string::npos);
}

TEST_F(Commands, AFileOfControllersNamesTheTopicsOfSetpoints) {
    constexpr const char* kFile = R"(
controller_manager: {ros__parameters: {
  left_only: {type: velocity_controllers/JointGroupVelocityController},
  path: {type: joint_trajectory_controller/JointTrajectoryController},
  elsewhere: {type: effort_controllers/JointGroupEffortController}}}
left_only: {ros__parameters: {joints: [left_joint]}}
path: {ros__parameters: {joints: [left_joint, right_joint]}}
elsewhere: {ros__parameters: {joints: [rihgt_joint]}}
)";
    TopicOptions options;
    options.controllers = std::make_shared<const Controllers>(parse_controllers("c.yaml", kFile).value());
    show(test::two_wheeler(), options);
    ASSERT_EQ(commands_->topics().size(), 1u) << "instead of the usual ones";
    Float64MultiArray message;
    message.data = {0.5};
    const auto found = orders("/robot/left_only/commands", message);
    ASSERT_TRUE(found) << found.error().text();
    ASSERT_EQ(found.value().size(), 1u);
    EXPECT_EQ(found.value()[0].action, Action(SetJoint{JointId(0u), 0, MotorMode::kVelocity, 0.5, -1}));
    const std::vector<std::string> notices =
        controller_notices(*options.controllers, *model_, robot_names(*model_, ""));
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0],
              "c.yaml:5: the controller 'elsewhere' has no effect: no robot has the joint 'rihgt_joint'; did "
              "you mean 'right_joint'? [no-joint]");
}

TEST_F(Commands, APoseIsAPlaceOnTheGround) {
    show(test::with_onboard(test::two_wheeler(), DriveToPoseSpec{}));
    PoseStamped pose;
    pose.pose.position = {1, 2, 3};
    pose.pose.orientation = {0, 0, std::sin(0.25), std::cos(0.25)};
    for (const CommandTopic& topic : commands_->topics()) {
        if (topic.kind != CommandTopic::Kind::kPose) continue;
        const std::vector<double> place = values(topic.name, pose);
        ASSERT_EQ(place.size(), 3u);
        EXPECT_NEAR(place[2], 0.5, 1e-12);
        return;
    }
    GTEST_SKIP() << "the controller needs a drive";
}

TEST_F(Commands, BytesThatAreNoMessageAreRefusedByName) {
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()));
    const auto found = commands_->orders(find("/robot/cmd_vel"), std::string("\0\1\0\0abc", 7));
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, "bad-message");
    EXPECT_NE(found.error().message.find("/robot/cmd_vel: these bytes are no geometry_msgs/msg/Twist"),
              std::string::npos)
        << found.error().message;
}

}  // namespace
}  // namespace roboss::ros2
