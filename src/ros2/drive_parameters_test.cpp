// Parameters of ros2_control's drives: what they mean, what has no effect, and what is wrong with them.
#include "ros2/drive_parameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

#include "ros2/controllers_file.h"

namespace roboss::ros2 {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

std::string typed(const std::string& type) {
    return "controller_manager: {ros__parameters: {base: {type: " + type + "}}}\n";
}
/// A drive of one wheel on each side; `more` begins in line 3.
std::string one_drive(const std::string& more) {
    return typed("diff_drive_controller/DiffDriveController") +
           "base: {ros__parameters: {left_wheel_names: [left_joint], right_wheel_names: [right_joint],\n" +
           more + "}}\n";
}
/// The same with its sizes; `more` begins in line 3.
std::string sized_drive(const std::string& more) {
    return one_drive("wheel_separation: 0.5, wheel_radius: 0.1" + (more.empty() ? "" : ", " + more));
}

Controllers parsed_drives(const std::string& text) {
    Result<Controllers> read = parse_controllers("c.yaml", text);
    EXPECT_TRUE(read) << read.error().text();
    return read ? read.value() : Controllers{};
}
/// The drive of the only controller.
DriveController only_drive(const std::string& text) {
    const Controllers file = parsed_drives(text);
    if (file.entries.size() != 1 || !file.entries[0].drive) return ADD_FAILURE() << text, DriveController{};
    return *file.entries[0].drive;
}
template <class Spec>
Spec only_spec(const std::string& text) {
    const DriveController drive = only_drive(text);
    const auto* spec = std::get_if<Spec>(&drive.parameters);
    if (spec == nullptr) return ADD_FAILURE() << "another kind of drive", Spec{};
    return *spec;
}
std::string drive_error(const std::string& text) {
    const Result<Controllers> read = parse_controllers("c.yaml", text);
    return read ? "" : read.error().message;
}

TEST(DriveParameters, OfADiffDriveHaveTheDefaultsOfRos) {
    const Controllers file = parsed_drives(sized_drive(""));
    ASSERT_EQ(file.entries.size(), 1u);
    EXPECT_TRUE(file.notices.empty());
    EXPECT_EQ(file.entries[0].kind, ControllerEntry::Kind::kDrive);
    EXPECT_EQ(file.entries[0].joints, (std::vector<std::string>{"left_joint", "right_joint"}));
    EXPECT_EQ(file.entries[0].line, 1);
    const DriveController drive = only_drive(sized_drive(""));
    EXPECT_EQ(drive.command, "base/cmd_vel");
    EXPECT_EQ(drive.odometry, "base/odom");
    EXPECT_EQ(drive.odometry_frame, "odom");
    EXPECT_EQ(drive.base_frame, "");
    EXPECT_TRUE(drive.stamped);
    EXPECT_TRUE(drive.publishes_base);
    EXPECT_EQ(drive.timeout_s, 0.5);
    EXPECT_EQ(drive.odometry_rate_hz, 50);
    EXPECT_EQ(drive.pose_covariance, CovarianceDiagonal{});
    const auto spec = only_spec<DiffDriveSpec>(sized_drive(""));
    EXPECT_EQ(spec.left, JointNames{"left_joint"});
    EXPECT_EQ(spec.right, JointNames{"right_joint"});
    EXPECT_EQ(spec.wheel_separation, 0.5);
    EXPECT_EQ(spec.wheel_radius, 0.1);
    EXPECT_EQ(spec.linear, SpeedLimits{});
    EXPECT_EQ(spec.angular, SpeedLimits{});
    EXPECT_EQ(spec.topic, "base/cmd_vel");
    EXPECT_TRUE(problems_of({"base", spec, {}}).empty());
}

TEST(DriveParameters, ActByTheirNamesInGroupsOrWithDots) {
    const std::string text = sized_drive(
        "wheel_separation_multiplier: 1.5, left_wheel_radius_multiplier: 2, right_wheel_radius_multiplier: "
        "2, "
        "linear.x.max_velocity: 1.5, linear.x.max_acceleration: 2, linear: {x: {max_jerk: 8, min_jerk: "
        ".nan}}, "
        "angular.z: {max_velocity: 1, min_velocity: -0.5, max_acceleration: .nan}, publish_rate: 20, "
        "cmd_vel_timeout: 0.25, odom_frame_id: wheel_odom, base_frame_id: chassis, enable_odom_tf: false, "
        "pose_covariance_diagonal: [1, 2, 3, 4, 5, 6], twist_covariance_diagonal: [0.5, 0, 0, 0, 0, 0.25]");
    EXPECT_TRUE(parsed_drives(text).notices.empty());
    const auto spec = only_spec<DiffDriveSpec>(text);
    EXPECT_DOUBLE_EQ(spec.wheel_separation, 0.75);
    EXPECT_DOUBLE_EQ(spec.wheel_radius, 0.2);
    EXPECT_EQ(spec.linear, (SpeedLimits{-1.5, 1.5, -2, 2, -8, 8}));
    EXPECT_EQ(spec.angular, (SpeedLimits{-0.5, 1, -kNone, kNone, -kNone, kNone}));
    const DriveController drive = only_drive(text);
    EXPECT_EQ(drive.timeout_s, 0.25);
    EXPECT_EQ(drive.odometry_rate_hz, 20);
    EXPECT_EQ(drive.odometry_frame, "wheel_odom");
    EXPECT_EQ(drive.base_frame, "chassis");
    EXPECT_EQ(drive.base_frame_line, 3);
    EXPECT_FALSE(drive.publishes_base);
    EXPECT_EQ(drive.pose_covariance, (CovarianceDiagonal{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(drive.twist_covariance, (CovarianceDiagonal{0.5, 0, 0, 0, 0, 0.25}));
}

TEST(DriveParameters, LimitsThatAreSwitchedOffMayBeAnything) {
    const std::string text = sized_drive(
        "linear.x.has_velocity_limits: false, linear.x.max_velocity: -1, linear.x.has_acceleration_limits: "
        "false, "
        "linear.x.max_acceleration: fast, linear.x.has_jerk_limits: false, linear.x.min_jerk: 1");
    EXPECT_EQ(only_spec<DiffDriveSpec>(text).linear, SpeedLimits{});
    EXPECT_TRUE(parsed_drives(text).notices.empty());
}

TEST(DriveParameters, BrakingIsBoundedAheadAsTheFileSays) {
    const std::string text = sized_drive(
        "\nlinear.x.max_acceleration: 2,\nlinear.x.max_deceleration: -3, angular.z.max_acceleration: "
        "1, angular.z.min_acceleration: -4");
    const auto spec = only_spec<DiffDriveSpec>(text);
    EXPECT_EQ(spec.linear.max_acceleration, 2);
    EXPECT_EQ(spec.linear.min_acceleration, -3);
    EXPECT_EQ(spec.angular.max_acceleration, 1);
    EXPECT_EQ(spec.angular.min_acceleration, -4);
    const Controllers file = parsed_drives(text);
    ASSERT_EQ(file.notices.size(), 1u) << "min_acceleration is of the change, as here";
    EXPECT_TRUE(
        file.notices[0].starts_with("c.yaml:5: linear.x.max_deceleration of 'base' has no effect in reverse: "
                                    "the velocity changes by -3.0"))
        << file.notices[0];
    const std::string same = sized_drive(
        "linear.x.max_acceleration: 2, linear.x.max_deceleration: -2, linear.x.max_acceleration_reverse: -2, "
        "linear.x.max_deceleration_reverse: 2");
    EXPECT_TRUE(parsed_drives(same).notices.empty());
}

TEST(DriveParameters, WithoutStampsTheTopicIsThatOfHumble) {
    const DriveController drive = only_drive(sized_drive("use_stamped_vel: false"));
    EXPECT_EQ(drive.command, "base/cmd_vel_unstamped");
    EXPECT_FALSE(drive.stamped);
}

TEST(DriveParameters, ThatHaveNoEffectAreNamedWithTheirLine) {
    const Controllers file =
        parsed_drives(sized_drive("\nopen_loop: true,\nvelocity_rolling_window_size: 5,\n"
                                  "publish_limited_velocity: true, wheels_per_side: 2,\n"
                                  "tf_frame_prefix: a, wheel_seperation: 1"));
    const std::vector<std::string> expected{
        "c.yaml:6: wheels_per_side of 'base' has no effect: the wheels are those that are named",
        "c.yaml:4: open_loop of 'base' has no effect: the odometry counts the turns of the wheels",
        "c.yaml:5: velocity_rolling_window_size of 'base' has no effect: velocities of the odometry are "
        "those of "
        "one tick",
        "c.yaml:6: publish_limited_velocity of 'base' has no effect: there is no topic cmd_vel_out",
        "c.yaml:7: tf_frame_prefix of 'base' has no effect: frames have the robot's name in front, and none "
        "with "
        "--ros2-plain-frames",
        "c.yaml:7: wheel_seperation of 'base' has no effect: it is not known here"};
    ASSERT_EQ(file.notices.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(file.notices[i], expected[i] + " [controller-parameter]");
    const Controllers defaults = parsed_drives(
        sized_drive("open_loop: false, velocity_rolling_window_size: 10, publish_limited_velocity: false, "
                    "wheels_per_side: 1, tf_frame_prefix_enable: true, use_sim_time: true, "
                    "position_feedback: false"));
    EXPECT_TRUE(defaults.notices.empty()) << defaults.notices.front();
    const Controllers uneven = parsed_drives(sized_drive("right_wheel_radius_multiplier: 1.5"));
    ASSERT_EQ(uneven.notices.size(), 1u);
    EXPECT_TRUE(uneven.notices[0].starts_with(
        "c.yaml:3: right_wheel_radius_multiplier of 'base' acts by the mean of both sides, 1.25"))
        << uneven.notices[0];
}

TEST(DriveParameters, ThatAreWrongAreNamedWithTheirLine) {
    for (const auto& [parameters, error] :
         {std::pair{"wheel_separation: 0, wheel_radius: 0.1",
                    "3: the wheel_separation of 'base' is not above 0"},
          {"wheel_radius: 0.1", "2: the wheel_separation of 'base' is missing"},
          {"wheel_separation: wide, wheel_radius: 0.1",
           "3: the wheel_separation of 'base' is no finite number"},
          {"wheel_separation: 0.5,\nwheel_radius: -0.1", "4: the wheel_radius of 'base' is not above 0"}})
        EXPECT_EQ(drive_error(one_drive(parameters)), std::string("c.yaml:") + error);
    for (const auto& [parameter, error] :
         {std::pair{"open_loop: maybe", "open_loop of 'base' is neither true nor false"},
          {"odom_frame_id: [a]", "odom_frame_id of 'base' is no text of at most 200 characters"},
          {"pose_covariance_diagonal: [1, 2]",
           "pose_covariance_diagonal of 'base' is no list of six numbers from 0 on"},
          {"cmd_vel_timeout: -1", "cmd_vel_timeout of 'base' is below 0"},
          {"publish_rate: 0", "publish_rate of 'base' is not above 0"},
          {"linear.x.max_velocity: -1", "linear.x.max_velocity of 'base' is below 0"},
          {"linear: {x: {max_velocity: 1, min_velocity: 1}}", "linear.x.min_velocity of 'base' is above 0"},
          {"angular.z.max_jerk: [1]", "angular.z.max_jerk of 'base' is no number"}})
        EXPECT_EQ(drive_error(sized_drive(parameter)), std::string("c.yaml:3: the ") + error);
    const std::string manager = typed("diff_drive_controller/DiffDriveController");
    EXPECT_EQ(drive_error(manager), "c.yaml:1: the controller 'base' has no parameters");
    const auto wheels = [&](const std::string& names) {
        return drive_error(manager + "base: {ros__parameters: {wheel_separation: 1, wheel_radius: 1,\n" +
                           names + "}}");
    };
    EXPECT_EQ(wheels("left_wheel_names: [a, b], right_wheel_names: [c]"),
              "c.yaml:3: the right_wheel_names of 'base' has 1 names, left_wheel_names 2");
    EXPECT_EQ(wheels("left_wheel_names: [a], right_wheel_names: [a]"),
              "c.yaml:3: the right_wheel_names of 'base' has the joint 'a', which is named twice");
    EXPECT_EQ(wheels("left_wheel_names: a, right_wheel_names: [b]"),
              "c.yaml:3: the left_wheel_names of 'base' is no list of at most 100 names");
    EXPECT_EQ(wheels("right_wheel_names: [b]"), "c.yaml:2: the left_wheel_names of 'base' is missing");
}

TEST(DriveParameters, OfOtherDrivesBecomeTheirOwnKinds) {
    const auto mecanum = only_spec<MecanumDriveSpec>(
        typed("mecanum_drive_controller/MecanumDriveController") +
        "base: {ros__parameters: {front_left_wheel_command_joint_name: fl, "
        "front_right_wheel_command_joint_name: "
        "fr, rear_left_wheel_command_joint_name: rl, rear_right_wheel_command_joint_name: rr, kinematics: "
        "{wheels_radius: 0.1, sum_of_robot_center_projection_on_X_Y_axis: 0.4}}}");
    EXPECT_EQ(mecanum.front_left, JointNames{"fl"});
    EXPECT_EQ(mecanum.back_right, JointNames{"rr"});
    EXPECT_EQ(0.5 * (mecanum.wheelbase + mecanum.wheel_separation), 0.4);
    EXPECT_EQ(mecanum.topic, "base/reference");
    const std::string axles = "rear_wheels_names: [rr, rl], front_wheels_names: [fr, fl], wheelbase: 1.2, ";
    const auto car = only_spec<AckermannSteeringSpec>(
        typed("ackermann_steering_controller/AckermannSteeringController") + "base: {ros__parameters: {" +
        axles +
        "rear_wheel_track: 0.8, front_wheel_track: 0.7, rear_wheels_radius: 0.3, front_wheels_radius: 0.2}}");
    EXPECT_EQ(car.left, JointNames{"rl"}) << "the right one is named first";
    EXPECT_EQ(car.right, JointNames{"rr"});
    EXPECT_EQ(car.left_steering, JointNames{"fl"});
    EXPECT_EQ(car.right_steering, JointNames{"fr"});
    EXPECT_EQ(car.wheel_base, 1.2);
    EXPECT_EQ(car.wheel_separation, 0.8);
    EXPECT_EQ(car.kingpin_width, 0.7);
    EXPECT_EQ(car.wheel_radius, 0.3);
    const auto bicycle =
        only_spec<AckermannSteeringSpec>(typed("bicycle_steering_controller/BicycleSteeringController") +
                                         "base: {ros__parameters: {traction_joints_names: [rear], "
                                         "steering_joints_names: [front], wheelbase: 1, "
                                         "rear_wheel_radius: 0.3}}");
    EXPECT_EQ(bicycle.left, bicycle.right);
    EXPECT_EQ(bicycle.left_steering, JointNames{"front"});
    EXPECT_EQ(bicycle.kingpin_width, 0);
    for (const OnboardParameters& parameters :
         {OnboardParameters(mecanum), OnboardParameters(car), OnboardParameters(bicycle)})
        EXPECT_TRUE(problems_of({"base", parameters, {}}).empty());
}

TEST(DriveParameters, AJointThatIsNamedTwiceIsAnErrorOfEachDrive) {
    EXPECT_EQ(drive_error(typed("mecanum_drive_controller/MecanumDriveController") +
                          "base: {ros__parameters: {front_left_wheel_command_joint_name: a, "
                          "front_right_wheel_command_joint_name: b, rear_left_wheel_command_joint_name: a, "
                          "rear_right_wheel_command_joint_name: c, kinematics: {wheels_radius: 0.1, "
                          "sum_of_robot_center_projection_on_X_Y_axis: 0.4}}}"),
              "c.yaml:2: the rear_right_wheel_command_joint_name of 'base' has the joint 'a', which is named "
              "twice");
    const auto steering = [](const std::string& type, const std::string& names) {
        return drive_error(typed(type) + "base: {ros__parameters: {wheelbase: 1, rear_wheel_track: 1, " +
                           "front_wheel_track: 1, traction_track_width: 1, rear_wheels_radius: 0.3, " +
                           names + "}}");
    };
    EXPECT_EQ(steering("ackermann_steering_controller/AckermannSteeringController",
                       "traction_joints_names: [a, a], steering_joints_names: [b, c]"),
              "c.yaml:2: the steering_joints_names of 'base' has the joint 'a', which is named twice");
    EXPECT_EQ(steering("tricycle_steering_controller/TricycleSteeringController",
                       "traction_joints_names: [a, b], steering_joints_names: [b]"),
              "c.yaml:2: the steering_joints_names of 'base' has the joint 'b', which is named twice");
}

TEST(DriveParameters, ARobotThatSteersAtItsRearIsReported) {
    const Controllers file =
        parsed_drives(typed("ackermann_steering_controller/AckermannSteeringController") +
                      "base: {ros__parameters: {front_steering: false}}");
    EXPECT_TRUE(file.entries.empty());
    ASSERT_EQ(file.notices.size(), 1u);
    EXPECT_EQ(
        file.notices[0],
        "c.yaml:2: the controller 'base' has no effect: a robot that steers at its rear is not known here "
        "[controller-type]");
}

TEST(DriveParameters, NothingInThemCrashesOrStalls) {
    std::string laughs = "l0: &l0 {x: 1}\n";
    for (int i = 1; i < 5; ++i) {
        const std::string one = "*l" + std::to_string(i - 1);
        laughs += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " {";
        for (int k = 0; k < 10; ++k) laughs += std::string(1, static_cast<char>('a' + k)) + ": " + one + ", ";
        laughs += "}\n";
    }
    const std::string error = drive_error(laughs + sized_drive("linear: *l4"));
    EXPECT_TRUE(error.ends_with("'base' has more than 1000 parameters")) << error;
    std::mt19937 random(7);
    for (int round = 0; round < 2'000; ++round) {
        std::string text =
            sized_drive("linear: {x: {max_velocity: 1}}, cmd_vel_timeout: 0.5, open_loop: true");
        for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 128);
        (void)parse_controllers("c.yaml", text);
    }
}

}  // namespace
}  // namespace roboss::ros2
