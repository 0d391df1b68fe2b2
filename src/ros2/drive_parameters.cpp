// See drive_parameters.h.
#include "ros2/drive_parameters.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace roboss::ros2 {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// 1/s: how fast a steering joint follows. ros2_control commands its position and leaves this to the
/// hardware.
constexpr double kSteeringGain = 10;
constexpr double kNoTrack = 1e-6;  // m, of an axle with one wheel

/// The odometry, by parameters that all drives have.
void read_odometry(ControllerParameters& p, const std::string& topic, DriveController& drive) {
    drive.odometry = p.name() + "/" + topic;
    drive.odometry_frame = p.text("odom_frame_id", "odom");
    drive.base_frame = p.text("base_frame_id", "");
    if (!drive.base_frame.empty()) drive.base_frame_line = p.line("base_frame_id");
    drive.publishes_base = p.flag("enable_odom_tf", true);
    drive.pose_covariance = p.diagonal("pose_covariance_diagonal");
    drive.twist_covariance = p.diagonal("twist_covariance_diagonal");
    p.leave("position_feedback");  // either way it counts the turns of the wheels
    if (p.flag("open_loop", false))
        p.has_no_effect("open_loop", "the odometry counts the turns of the wheels");
    constexpr double kUsualWindow = 10;
    if (p.number("velocity_rolling_window_size", kUsualWindow) != kUsualWindow)
        p.has_no_effect("velocity_rolling_window_size", "velocities of the odometry are those of one tick");
}

/// The topic of the velocity and its type.
void read_command(ControllerParameters& p, const std::string& topic, DriveController& drive) {
    drive.stamped = p.flag("use_stamped_vel", true);
    drive.command = p.name() + "/" + topic + (drive.stamped ? "" : "_unstamped");
}

/// Puts topics and frames into the on-board controller.
template <class Spec>
void finish_drive(Spec spec, DriveController& drive) {
    spec.topic = drive.command;
    spec.output.rate = drive.odometry_rate_hz, spec.output.topic = drive.odometry;
    spec.output.frame = drive.odometry_frame, spec.output.child_frame = drive.base_frame;
    drive.parameters = std::move(spec);
}

void expect_different(ControllerParameters& p, const std::string& key, const JointNames& first,
                      const JointNames& second) {
    std::set<std::string> seen;
    for (const JointNames* names : {&first, &second})
        for (const std::string& name : *names)
            if (!seen.insert(name).second)
                p.fail(key, "has the joint '" + name + "', which is named twice", "name each wheel once");
}

JointNames joint_names(const std::vector<std::string>& names) {
    return JointNames(names.begin(), names.end());
}

JointNames both(JointNames first, const JointNames& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// The bounds of a limit and of the one of the other sign, whose default is the first one's negative. Without
/// the first there are none.
std::pair<double, double> pair_of_limits(ControllerParameters& p, const std::string& most,
                                         const std::string& least) {
    const std::optional<double> high = p.limit(most, 1), low = p.limit(least, -1);
    if (high) return {low.value_or(-*high), *high};
    if (low) p.has_no_effect(least, "there is no " + most);
    return {-kInfinite, kInfinite};
}

/// Two bounds of acceleration: of a velocity that grows, and of one that falls, ahead and in reverse alike.
void read_accelerations(ControllerParameters& p, const std::string& group, SpeedLimits& limits) {
    const std::string ahead = group + ".max_acceleration", brake = group + ".max_deceleration",
                      ahead_reverse = group + ".max_acceleration_reverse",
                      brake_reverse = group + ".max_deceleration_reverse";
    const bool has_brake = p.limit(brake, -1).has_value();
    if (has_brake) p.has_no_effect(group + ".min_acceleration", "max_deceleration counts");
    const auto [low, high] = pair_of_limits(p, ahead, has_brake ? brake : group + ".min_acceleration");
    limits.min_acceleration = low, limits.max_acceleration = high;
    const double backwards = p.limit(ahead_reverse, -1).value_or(-high),
                 braking = p.limit(brake_reverse, 1).value_or(-low);
    const bool says_otherwise = has_brake || p.has(ahead_reverse) || p.has(brake_reverse);
    if (!says_otherwise || (backwards == low && braking == high)) return;
    const std::string& key = p.has(ahead_reverse)   ? ahead_reverse
                             : p.has(brake_reverse) ? brake_reverse
                                                    : brake;
    p.notice(key, "has no effect in reverse: the velocity changes by " + std::to_string(low) + " to " +
                      std::to_string(high) + " in a second, ahead and in reverse");
}

/// Limits of a group such as "linear.x". Those that it switches off may have any values.
SpeedLimits read_limits(ControllerParameters& p, const std::string& group) {
    SpeedLimits limits;
    if (p.flag(group + ".has_velocity_limits", true))
        std::tie(limits.min_velocity, limits.max_velocity) =
            pair_of_limits(p, group + ".max_velocity", group + ".min_velocity");
    if (p.flag(group + ".has_acceleration_limits", true)) read_accelerations(p, group, limits);
    if (p.flag(group + ".has_jerk_limits", true))
        std::tie(limits.min_jerk, limits.max_jerk) =
            pair_of_limits(p, group + ".max_jerk", group + ".min_jerk");
    for (const char* name :
         {".max_velocity", ".min_velocity", ".max_acceleration", ".min_acceleration", ".max_deceleration",
          ".max_acceleration_reverse", ".max_deceleration_reverse", ".max_jerk", ".min_jerk"})
        p.leave(group + name);
    return limits;
}

/// Separation and radius with their multipliers; wheels of both sides have one radius here.
void read_wheels(ControllerParameters& p, DiffDriveSpec& spec) {
    spec.left = joint_names(p.names("left_wheel_names"));
    spec.right = joint_names(p.names("right_wheel_names"));
    if (spec.left.size() != spec.right.size())
        p.fail("right_wheel_names",
               "has " + std::to_string(spec.right.size()) + " names, left_wheel_names " +
                   std::to_string(spec.left.size()),
               "name as many wheels on each side");
    expect_different(p, "right_wheel_names", spec.left, spec.right);
    const double count = p.number("wheels_per_side", 0);
    if (count != 0 && count != static_cast<double>(spec.left.size()))
        p.has_no_effect("wheels_per_side", "the wheels are those that are named");
    spec.wheel_separation = p.length("wheel_separation") * p.above_zero("wheel_separation_multiplier", 1);
    const char* const of_right = "right_wheel_radius_multiplier";
    const double left = p.above_zero("left_wheel_radius_multiplier", 1), right = p.above_zero(of_right, 1);
    spec.wheel_radius = p.length("wheel_radius") * 0.5 * (left + right);
    if (left != right)
        p.notice(p.has(of_right) ? of_right : "left_wheel_radius_multiplier",
                 "acts by the mean of both sides, " + std::to_string(0.5 * (left + right)));
}

DriveController read_diff_drive(ControllerParameters& p) {
    DriveController drive;
    DiffDriveSpec spec;
    read_wheels(p, spec);
    spec.linear = read_limits(p, "linear.x"), spec.angular = read_limits(p, "angular.z");
    read_command(p, "cmd_vel", drive);
    read_odometry(p, "odom", drive);
    drive.timeout_s = p.at_least_zero("cmd_vel_timeout", 0.5);
    drive.odometry_rate_hz = p.above_zero("publish_rate", 50);
    if (p.flag("publish_limited_velocity", false))
        p.has_no_effect("publish_limited_velocity", "there is no topic cmd_vel_out");
    if (!p.flag("tf_frame_prefix_enable", true) || !p.text("tf_frame_prefix", "").empty())
        p.has_no_effect(p.has("tf_frame_prefix") ? "tf_frame_prefix" : "tf_frame_prefix_enable",
                        "frames have the robot's name in front, and none with --ros2-plain-frames");
    finish_drive(std::move(spec), drive);
    return drive;
}

DriveController read_mecanum_drive(ControllerParameters& p) {
    DriveController drive;
    MecanumDriveSpec spec;
    const auto wheel = [&](const std::string& corner) {
        const std::string name = p.joint(corner + "_wheel_command_joint_name");
        const std::string state = corner + "_wheel_state_joint_name";
        if (const std::string read = p.text(state, ""); !read.empty() && read != name)
            p.has_no_effect(state, "the odometry reads the joints that are driven");
        return JointNames{name};
    };
    spec.front_left = wheel("front_left"), spec.front_right = wheel("front_right");
    spec.back_left = wheel("rear_left"), spec.back_right = wheel("rear_right");
    expect_different(p, "rear_right_wheel_command_joint_name", both(spec.front_left, spec.front_right),
                     both(spec.back_left, spec.back_right));
    // Both lengths act by half their sum alone, which is this.
    spec.wheel_separation = spec.wheelbase =
        p.length("kinematics.sum_of_robot_center_projection_on_X_Y_axis");
    spec.wheel_radius = p.length("kinematics.wheels_radius");
    for (const char* name : {"x", "y", "theta"})
        if (const std::string key = std::string("kinematics.base_frame_offset.") + name;
            p.number(key, 0) != 0)
            p.has_no_effect(key, "velocities are those of the middle between the wheels");
    read_command(p, "reference", drive);
    read_odometry(p, "odometry", drive);
    drive.timeout_s = p.at_least_zero("reference_timeout", 0);
    finish_drive(std::move(spec), drive);
    return drive;
}

/// The joints of an axle, right one first, as the file has them; an axle with one wheel has it on both sides.
/// `key` is what the parameter is called now, `old_key` what it was called before.
void read_axle(ControllerParameters& p, const std::string& key, const std::string& old_key,
               std::size_t wheels, JointNames& left, JointNames& right) {
    const std::string& given = p.has(key) ? key : old_key;
    const std::vector<std::string> names = p.names(given);
    if (names.size() != wheels) {
        p.fail(given, "has " + std::to_string(names.size()) + " names",
               "name " + std::to_string(wheels) + (wheels == 1 ? " joint" : " joints, the right one first"));
        return;
    }
    right = {names.front()}, left = {names.back()};
}

double length_of(ControllerParameters& p, const std::string& key, const std::string& old_key) {
    return p.length(p.has(key) ? key : old_key);
}

/// Drives at the rear axle and steers at the front one. `traction`, `steering`: joints of each.
DriveController read_steering(ControllerParameters& p, std::size_t traction, std::size_t steering) {
    DriveController drive;
    AckermannSteeringSpec spec;
    if (!p.flag("front_steering", true))
        p.refuse("front_steering", "a robot that steers at its rear is not known here");
    read_axle(p, "traction_joints_names", "rear_wheels_names", traction, spec.left, spec.right);
    read_axle(p, "steering_joints_names", "front_wheels_names", steering, spec.left_steering,
              spec.right_steering);
    // An axle with one wheel has it on both sides.
    expect_different(p, p.has("steering_joints_names") ? "steering_joints_names" : "front_wheels_names",
                     traction == 1 ? spec.left : both(spec.left, spec.right),
                     steering == 1 ? spec.left_steering : both(spec.left_steering, spec.right_steering));
    for (const char* key : {"traction_joints_state_names", "steering_joints_state_names",
                            "rear_wheels_state_names", "front_wheels_state_names"})
        p.has_no_effect(key, "the odometry reads the joints that are driven");
    spec.wheel_base = p.length("wheelbase");
    if (steering == 2) {
        spec.wheel_separation = length_of(p, "traction_track_width", "rear_wheel_track");
        const bool has_own = p.has("steering_track_width") || p.has("front_wheel_track");
        spec.kingpin_width =
            has_own ? length_of(p, "steering_track_width", "front_wheel_track") : spec.wheel_separation;
    } else {
        spec.wheel_separation =
            traction == 1 ? kNoTrack : length_of(p, "traction_track_width", "wheel_track");
        spec.kingpin_width = 0;
    }
    const bool is_bicycle = traction == 1;
    spec.wheel_radius = p.has("traction_wheels_radius") ? p.length("traction_wheels_radius")
                        : p.has("traction_wheel_radius")
                            ? p.length("traction_wheel_radius")
                            : p.length(is_bicycle ? "rear_wheel_radius" : "rear_wheels_radius");
    for (const char* undriven : {"front_wheel_radius", "front_wheels_radius"}) p.leave(undriven);
    spec.speed_gain = kSteeringGain;
    read_command(p, "reference", drive);
    read_odometry(p, "odometry", drive);
    drive.timeout_s = p.at_least_zero("reference_timeout", 1);
    finish_drive(std::move(spec), drive);
    return drive;
}

struct KnownDrive {
    const char* type;
    DriveReader read;
};
constexpr std::array kDrives{
    KnownDrive{"diff_drive_controller/DiffDriveController", read_diff_drive},
    KnownDrive{"mecanum_drive_controller/MecanumDriveController", read_mecanum_drive},
    KnownDrive{"ackermann_steering_controller/AckermannSteeringController",
               [](ControllerParameters& p) { return read_steering(p, 2, 2); }},
    KnownDrive{"tricycle_steering_controller/TricycleSteeringController",
               [](ControllerParameters& p) { return read_steering(p, 2, 1); }},
    KnownDrive{"bicycle_steering_controller/BicycleSteeringController",
               [](ControllerParameters& p) { return read_steering(p, 1, 1); }}};

}  // namespace

DriveReader drive_reader(const std::string& type) {
    for (const KnownDrive& known : kDrives)
        if (type == known.type) return known.read;
    return nullptr;
}

}  // namespace roboss::ros2
