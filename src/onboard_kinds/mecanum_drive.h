// MecanumDrive of Gazebo: drives four wheels so that the robot follows a commanded velocity, sideways too.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/speed_limits.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// The rollers are friction directions of the wheels (`<fdir1>` in the axes of the chassis): the wheels roll
/// along them without resistance. Before the first command the wheels are held at zero.
struct MecanumDriveSpec {
    JointNames front_left,       ///< wheel joints; the first of each corner is an odometer
        front_right,             ///< see front_left
        back_left,               ///< see front_left
        back_right;              ///< see front_left
    double wheelbase = 1.0,      ///< m, between front and back axle
        wheel_separation = 1.0,  ///< m, between left and right
        wheel_radius = 0.2;      ///< m
    SpeedLimits linear,          ///< m/s, of x and y, each by itself
        angular;                 ///< rad/s
    std::string topic;           ///< of the command; empty: /model/NAME/cmd_vel
    OdometryOutput output;       ///< of the odometry

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 12,
                                       .name = "mecanum-drive",
                                       .phrase = "a mecanum drive",
                                       .classes = "MecanumDrive",
                                       .files = "mecanum-drive-system",
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"front_left", "front_left_joint"}, s.front_left);
        visit({"front_right", "front_right_joint"}, s.front_right);
        visit({"back_left", "back_left_joint"}, s.back_left);
        visit({"back_right", "back_right_joint"}, s.back_right);
        visit({"wheelbase", "wheelbase", "m"}, s.wheelbase);
        visit({"wheel_separation", "wheel_separation", "m"}, s.wheel_separation);
        visit({"wheel_radius", "wheel_radius", "m"}, s.wheel_radius);
        visit_limits(visit, s.linear, kLinearOfBoth);
        visit_limits(visit, s.angular, kAngularOfBoth);
        visit({"topic", "topic"}, s.topic);
        visit_odometry(visit, s.output);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const { return {twist_channel(topic, "cmd_vel")}; }
    /// Places in its memory; it begins with the odometry (OnboardKind::odometry).
    enum Memory : std::size_t {
        kOdometry = 0,
        kSideways = 5,  ///< m/s, velocity to the left of the tick before
        kStarted = 6,   ///< 1: the angles below are known
        kAngles =
            7,  ///< rad, of the first wheels at the last tick: front left, front right, back left, back right
        kSpeed = 11,      ///< m/s, the last two commands after the limits
        kSideSpeed = 13,  ///< m/s, likewise
        kTurnRate = 15,   ///< rad/s, likewise
        kMemorySize = 17
    };
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const {
        bool still = true;
        for (std::size_t i = kSpeed; i < kMemorySize; ++i) still = still && m[i] == 0;
        return still;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (front_left.empty() || front_right.empty() || back_left.empty() || back_right.empty())
            problems.push_back({"names no wheel joint at one of its four corners", "Name all four."});
        expect_positive("wheel_radius", wheel_radius, problems);
        expect_positive("wheel_separation + wheelbase", wheel_separation + wheelbase, problems);
    }
    /// Compares all members.
    friend bool operator==(const MecanumDriveSpec&, const MecanumDriveSpec&) = default;
};

}  // namespace roboss
