// DiffDrive of Gazebo: drives the wheels of two sides so that the robot follows a commanded velocity.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/speed_limits.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// All wheels of a side turn equally fast. Before the first command the wheels are held at zero.
struct DiffDriveSpec {
    JointNames left,                ///< wheel joints of the left side; the first one is the odometer
        right;                      ///< wheel joints of the right side
    double wheel_separation = 1.0,  ///< m, between the sides
        wheel_radius = 0.2;         ///< m
    SpeedLimits linear,             ///< m/s
        angular;                    ///< rad/s
    std::string topic;              ///< of the command; empty: /model/NAME/cmd_vel
    OdometryOutput output;          ///< of the odometry

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 10,
                                       .name = "diff-drive",
                                       .phrase = "a differential drive",
                                       .classes = "DiffDrive",
                                       .files = "diff-drive-system",
                                       .odometry = 0};
    /// Names and elements of the limits that count for one of the two.
    static constexpr SpeedLimitElements kLinear{
        {{"min_linear_velocity", "min_linear_velocity", "m/s", true},
         {"max_linear_velocity", "max_linear_velocity", "m/s", true},
         {"min_linear_acceleration", "min_linear_acceleration", "m/s^2", true},
         {"max_linear_acceleration", "max_linear_acceleration", "m/s^2", true},
         {"min_linear_jerk", "min_linear_jerk", "m/s^3", true},
         {"max_linear_jerk", "max_linear_jerk", "m/s^3", true}}};
    /// The same of the turn.
    static constexpr SpeedLimitElements kAngular{
        {{"min_angular_velocity", "min_angular_velocity", "rad/s", true},
         {"max_angular_velocity", "max_angular_velocity", "rad/s", true},
         {"min_angular_acceleration", "min_angular_acceleration", "rad/s^2", true},
         {"max_angular_acceleration", "max_angular_acceleration", "rad/s^2", true},
         {"min_angular_jerk", "min_angular_jerk", "rad/s^3", true},
         {"max_angular_jerk", "max_angular_jerk", "rad/s^3", true}}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order: what counts for both
    /// first, so that a limit of one of them replaces it.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"left", "left_joint"}, s.left);
        visit({"right", "right_joint"}, s.right);
        visit({"wheel_separation", "wheel_separation", "m"}, s.wheel_separation);
        visit({"wheel_radius", "wheel_radius", "m"}, s.wheel_radius);
        visit_limits(visit, s.linear, kLinearOfBoth);
        visit_limits(visit, s.angular, kAngularOfBoth);
        visit_limits(visit, s.linear, kLinear);
        visit_limits(visit, s.angular, kAngular);
        visit({"topic", "topic"}, s.topic);
        visit_odometry(visit, s.output);
    }
    /// The commands that it takes. `enable` 0: commands are ignored from now on, the robot brakes.
    std::vector<Channel> channels() const {
        return {twist_channel(topic, "cmd_vel"), channel_of("", "enable", {{"enable", ""}})};
    }
    /// Places in its memory; it begins with the odometry (OnboardKind::odometry).
    enum Memory : std::size_t {
        kOdometry = 0,
        kStarted = 5,        ///< 1: the angles below are known
        kLeftAngle = 6,      ///< rad, of the first left wheel at the last tick
        kRightAngle = 7,     ///< rad
        kSpeed = 8,          ///< m/s, the last two commands after the limits
        kTurnRate = 10,      ///< rad/s, likewise
        kIgnoredUntil = 12,  ///< tick of the last command that came while it was not enabled
        kMemorySize = 13
    };
    /// Its memory at the start.
    std::vector<double> memory() const {
        std::vector<double> start(kMemorySize, 0.0);
        start[kIgnoredUntil] = -1;
        return start;
    }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const {
        return m[kSpeed] == 0 && m[kSpeed + 1] == 0 && m[kTurnRate] == 0 && m[kTurnRate + 1] == 0;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        expect_wheels(left.empty() || right.empty(), problems);
        expect_positive("wheel_separation", wheel_separation, problems);
        expect_positive("wheel_radius", wheel_radius, problems);
    }
    /// Compares all members.
    friend bool operator==(const DiffDriveSpec&, const DiffDriveSpec&) = default;
};

}  // namespace roboss
