// libgazebo_ros_ackermann_drive.so of classic Gazebo: a car whose rear wheels and steering are driven by
// PIDs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/ros_drive.h"
#include "onboard_kinds/speed_limits.h"

namespace roboss {

/// Gains are p, i, d; the range bounds the integral term: lower, upper, no third value.
struct RosAckermannSpec {
    JointNames front_left,           ///< wheel joint, measured for the geometry
        front_right,                 ///< wheel joint, measured for the geometry
        rear_left,                   ///< driven wheel joint
        rear_right,                  ///< driven wheel joint, whose speed and radius are measured
        left_steering,               ///< steering joint
        right_steering,              ///< steering joint
        steering_wheel;              ///< in the driver's hands; may be missing
    double max_speed = 20,           ///< m/s
        max_steer = 0.6,             ///< rad
        max_steering_angle = 7.85;   ///< rad, of the steering wheel
    std::vector<double> left_gain,   ///< N m/rad, N m/(rad s), N m s/rad
        right_gain,                  ///< likewise
        speed_gain;                  ///< N m s/rad, N m/rad, N m s^2/rad
    std::vector<double> left_range,  ///< N m, of the integral term
        right_range,                 ///< N m
        speed_range;                 ///< N m
    RosDrive ros;                    ///< topics, odometry, rate of the PIDs

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 16,
                                       .name = "ros-ackermann-drive",
                                       .phrase = "an Ackermann drive",
                                       .classes = "",
                                       .files = "gazebo_ros_ackermann_drive",
                                       .ignored = kRosIgnored,
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"front_left", "front_left_joint"}, s.front_left);
        visit({"front_right", "front_right_joint"}, s.front_right);
        visit({"rear_left", "rear_left_joint"}, s.rear_left);
        visit({"rear_right", "rear_right_joint"}, s.rear_right);
        visit({"left_steering", "left_steering_joint"}, s.left_steering);
        visit({"right_steering", "right_steering_joint"}, s.right_steering);
        visit({"steering_wheel", "steering_wheel_joint"}, s.steering_wheel);
        visit({"max_speed", "max_speed", "m/s"}, s.max_speed);
        visit({"max_steer", "max_steer", "rad"}, s.max_steer);
        visit({"max_steering_angle", "max_steering_angle", "rad"}, s.max_steering_angle);
        visit({"left_gain", "left_steering_pid_gain"}, s.left_gain);
        visit({"right_gain", "right_steering_pid_gain"}, s.right_gain);
        visit({"speed_gain", "linear_velocity_pid_gain"}, s.speed_gain);
        visit({"left_range", "left_steering_i_range"}, s.left_range);
        visit({"right_range", "right_steering_i_range"}, s.right_range);
        visit({"speed_range", "linear_velocity_i_range"}, s.speed_range);
        RosDrive::parameters(visit, s.ros);
    }
    /// The commands that it takes: angular_z is the steering angle, rad.
    std::vector<Channel> channels() const { return {ros.command()}; }
    /// Places in its memory; it begins with the odometry (OnboardKind::odometry).
    enum Memory : std::size_t {
        kOdometry = 0,
        kNextUpdate = 5,   ///< s: when the PIDs act again
        kSpeedError = 6,   ///< rad/s: integral, last error of the speed
        kLeftError = 8,    ///< rad: integral, last error of the left steering
        kRightError = 10,  ///< rad: of the right steering
        kMemorySize = 12
    };
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// Its PIDs run on while the robot is at rest.
    bool rests(std::span<const double>) const { return false; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        expect_wheels(front_left.size() != 1 || front_right.size() != 1 || rear_left.size() != 1 ||
                          rear_right.size() != 1,
                      problems);
        if (left_steering.size() != 1 || right_steering.size() != 1)
            problems.push_back({"names no steering joint on one of its sides", "Name both steering joints."});
        for (const std::vector<double>* gain : {&left_gain, &right_gain, &speed_gain})
            if (!gain->empty() && gain->size() != 3)
                problems.push_back({"has a gain that is not three numbers", "Write p, i and d."});
        for (const std::vector<double>* range : {&left_range, &right_range, &speed_range})
            if (!range->empty() && range->size() != 2)
                problems.push_back(
                    {"has a range that is not two numbers", "Write the lower and the upper bound."});
        expect_positive("max_steer", max_steer, problems);
        expect_positive("max_steering_angle", max_steering_angle, problems);
    }
    /// Compares all members.
    friend bool operator==(const RosAckermannSpec&, const RosAckermannSpec&) = default;
};

}  // namespace roboss
