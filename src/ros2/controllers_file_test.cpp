// Files of ros2_control: what they name, what has no effect, and what is wrong with them.
#include "ros2/controllers_file.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss::ros2 {
namespace {

using Kind = ControllerEntry::Kind;

constexpr const char* kArmAndHand = R"(
controller_manager:
  ros__parameters:
    update_rate: 100
    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController
    hand_controller:
      type: position_controllers/GripperActionController
    joint_state_broadcaster:
      type: joint_state_broadcaster/JointStateBroadcaster
    base_controller:
      type: omni_wheel_drive_controller/OmniWheelDriveController
arm_controller:
  ros__parameters:
    joints: [shoulder, elbow]
    command_interfaces: [position]
hand_controller:
  ros__parameters:
    joint: finger
    goal_tolerance: 0.002
    allow_stalling: true
)";

Controllers parsed(const std::string& text) {
    Result<Controllers> read = parse_controllers("c.yaml", text);
    EXPECT_TRUE(read) << read.error().text();
    return read ? read.value() : Controllers{};
}
std::string error(const std::string& text) {
    const Result<Controllers> read = parse_controllers("c.yaml", text);
    return read ? "" : read.error().message;
}

TEST(ControllersFile, NamesTypesAndJointsAreRead) {
    const Controllers file = parsed(kArmAndHand);
    ASSERT_EQ(file.entries.size(), 2u);
    EXPECT_EQ(file.entries[0].name, "arm_controller");
    EXPECT_EQ(file.entries[0].kind, Kind::kTrajectory);
    EXPECT_EQ(file.entries[0].joints, (std::vector<std::string>{"shoulder", "elbow"}));
    EXPECT_EQ(file.entries[0].line, 5);
    EXPECT_EQ(file.entries[1].kind, Kind::kGripper);
    EXPECT_EQ(file.entries[1].joints, std::vector<std::string>{"finger"});
    EXPECT_EQ(file.entries[1].goal_tolerance, 0.002);
    EXPECT_TRUE(file.entries[1].allow_stalling);
    ASSERT_EQ(file.notices.size(), 1u) << "broadcasters are no news";
    EXPECT_TRUE(file.notices[0].starts_with("c.yaml:12: the controller 'base_controller' has no effect"))
        << file.notices[0];
}

TEST(ControllersFile, SetpointsHaveTheModeOfTheirTypeOrInterface) {
    const auto mode = [](const std::string& type, const std::string& more) {
        const Controllers file = parsed("controller_manager: {ros__parameters: {c: {type: " + type +
                                        "}}}\nc: {ros__parameters: {joints: [a]" + more + "}}");
        EXPECT_EQ(file.entries.at(0).kind, Kind::kSetpoints);
        return file.entries.at(0).mode;
    };
    EXPECT_EQ(mode("position_controllers/JointGroupPositionController", ""), MotorMode::kPosition);
    EXPECT_EQ(mode("velocity_controllers/JointGroupVelocityController", ""), MotorMode::kVelocity);
    EXPECT_EQ(mode("effort_controllers/JointGroupEffortController", ""), MotorMode::kEffort);
    const std::string forward = "forward_command_controller/ForwardCommandController";
    EXPECT_EQ(mode(forward, ", interface_name: velocity"), MotorMode::kVelocity);
    EXPECT_EQ(mode(forward, ", interface_name: effort"), MotorMode::kEffort);
}

TEST(ControllersFile, NamespacesAreOfRobotsAndWildcardsAreOfAll) {
    const Controllers file = parsed(R"(
left:
  controller_manager: {ros__parameters: {c: {type: joint_trajectory_controller/JointTrajectoryController}}}
  c: {ros__parameters: {joints: [a]}}
/right/controller_manager: {ros__parameters: {c: {type: joint_trajectory_controller/JointTrajectoryController}}}
/right/c: {ros__parameters: {joints: [b]}}
/**/controller_manager: {ros__parameters: {d: {type: joint_trajectory_controller/JointTrajectoryController}}}
/**/d: {ros__parameters: {joints: [c]}}
)");
    ASSERT_EQ(file.entries.size(), 3u);
    EXPECT_EQ(file.entries[0].space, "left");
    EXPECT_EQ(file.entries[0].joints.at(0), "a");
    EXPECT_EQ(file.entries[1].space, "right");
    EXPECT_EQ(file.entries[1].joints.at(0), "b");
    EXPECT_EQ(file.entries[2].space, "");
}

TEST(ControllersFile, WhatIsWrongIsNamedWithItsLine) {
    EXPECT_EQ(error("- a\n"), "c.yaml: it has no parameters of a controller_manager");
    EXPECT_TRUE(error("a: [\n").starts_with("c.yaml:2: it is no YAML")) << error("a: [\n");
    const std::string manager =
        "controller_manager: {ros__parameters: {c: {type: "
        "joint_trajectory_controller/JointTrajectoryController}}}\n";
    EXPECT_EQ(error(manager), "c.yaml:1: the controller 'c' has no parameters");
    EXPECT_EQ(error(manager + "c: {ros__parameters: {joint: a}}"), "c.yaml:2: 'c' names no joints");
    EXPECT_EQ(error(manager + "c: {ros__parameters: {joints: []}}"), "c.yaml:2: 'c' names no joints");
    EXPECT_EQ(error(manager + "c: {ros__parameters: {joints: [[a]]}}"), "c.yaml:2: 'c' names no joints");
    EXPECT_EQ(error("controller_manager: {ros__parameters: {a b: {type: x/Y}}}"),
              "c.yaml:1: the name 'a b' has other characters than letters, digits, _ and /");
    EXPECT_EQ(error(std::string(kArmAndHand) + "    stall_timeout: soon\n"),
              "c.yaml:22: stall_timeout is no number from 0 on");
    EXPECT_EQ(error(std::string(kArmAndHand) + "    stall_timeout: .nan\n"),
              "c.yaml:22: stall_timeout is no number from 0 on");
    EXPECT_FALSE(read_controllers("/no/such/file.yaml"));
}

TEST(ControllersFile, NothingInItCrashesOrStalls) {
    EXPECT_EQ(error("a: &a {b: *a, c: *a}\n"), "c.yaml: it has no parameters of a controller_manager");
    std::string laughs = "l0: &l0 {x: 1}\n";
    for (int i = 1; i < 9; ++i) {
        const std::string one = "*l" + std::to_string(i - 1);
        laughs += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " {";
        for (int k = 0; k < 10; ++k) laughs += std::string(1, static_cast<char>('a' + k)) + ": " + one + ", ";
        laughs += "}\n";
    }
    EXPECT_EQ(error(laughs), "c.yaml: it is too large");
    std::mt19937 random(7);
    for (int round = 0; round < 2'000; ++round) {
        std::string text = kArmAndHand;
        for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 128);
        (void)parse_controllers("c.yaml", text);
    }
}

}  // namespace
}  // namespace roboss::ros2
