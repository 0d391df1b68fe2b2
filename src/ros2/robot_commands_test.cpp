// Messages become the orders that they ask for.
#include "ros2/robot_commands.h"

#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {
namespace {

class Commands : public testing::Test {
  protected:
    void show(ModelSpec model, bool stamped = false) {
        model_ = test::compiled(test::on_plane(std::move(model)));
        commands_.emplace(model_, TopicOptions{stamped, {}});
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
    Result<std::vector<Action>> actions(const std::string& name, const M& message) const {
        return commands_->actions(find(name), to_cdr(message));
    }
    /// The values of the only command that the message is.
    template <Message M>
    std::vector<double> values(const std::string& name, const M& message) const {
        const Result<std::vector<Action>> orders = actions(name, message);
        if (!orders || orders.value().size() != 1)
            return ADD_FAILURE() << "not one order", std::vector<double>{};
        return std::get<Command>(orders.value().front()).values;
    }
    std::string refusal(const Result<std::vector<Action>>& orders) const {
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
    show(test::with_onboard(test::two_wheeler(), test::diff_drive()), true);
    EXPECT_EQ(type_of_topic("/robot/cmd_vel"), "geometry_msgs/msg/TwistStamped");
    EXPECT_EQ(values("/robot/cmd_vel", TwistStamped{{}, {{1, 0, 0}, {0, 0, 2}}}),
              (std::vector<double>{1, 0, 0, 0, 0, 2}));
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
    EXPECT_NE(refusal(actions("/robot/joint_trajectory", trajectory)).find("ascend"), std::string::npos);
    trajectory.joint_names[1] = "arm";
    EXPECT_NE(refusal(actions("/robot/joint_trajectory", trajectory)).find("left_joint"), std::string::npos);
}

TEST_F(Commands, RobotsWithoutControllersTakeSetpointsOfTheirJoints) {
    show(test::two_wheeler());
    Float64MultiArray message;
    message.data = {0.5, -1};
    const auto orders = actions("/robot/velocity_controller/commands", message);
    ASSERT_TRUE(orders) << orders.error().text();
    ASSERT_EQ(orders.value().size(), 2u);
    EXPECT_EQ(orders.value()[1], Action(SetJoint{JointId(1u), 0, MotorMode::kVelocity, -1, -1}));
    message.data = {1};
    EXPECT_NE(refusal(actions("/robot/effort_controller/commands", message)).find("left_joint, right_joint"),
              std::string::npos);
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
    const auto orders = commands_->actions(find("/robot/cmd_vel"), std::string("\0\1\0\0abc", 7));
    ASSERT_FALSE(orders);
    EXPECT_EQ(orders.error().code, "bad-message");
    EXPECT_NE(orders.error().message.find("/robot/cmd_vel: these bytes are no geometry_msgs/msg/Twist"),
              std::string::npos)
        << orders.error().message;
}

}  // namespace
}  // namespace roboss::ros2
