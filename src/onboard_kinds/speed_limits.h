// Limits of a commanded speed, and what drives publish of their odometry: parameters that several kinds
// share.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Bounds of a speed, of its rate and of the rate's rate; infinite: none. The speed is in m/s or rad/s.
struct SpeedLimits {
    double min_velocity = -std::numeric_limits<double>::infinity(),   ///< m/s or rad/s
        max_velocity = std::numeric_limits<double>::infinity(),       ///< m/s or rad/s
        min_acceleration = -std::numeric_limits<double>::infinity(),  ///< m/s^2 or rad/s^2
        max_acceleration = std::numeric_limits<double>::infinity(),   ///< m/s^2 or rad/s^2
        min_jerk = -std::numeric_limits<double>::infinity(),          ///< m/s^3 or rad/s^3
        max_jerk = std::numeric_limits<double>::infinity();           ///< m/s^3 or rad/s^3
    /// Compares all members.
    friend bool operator==(const SpeedLimits&, const SpeedLimits&) = default;
};

/// The six parameters of SpeedLimits, in the order of its members.
struct SpeedLimitElements {
    Parameter each[6];  ///< name and element
};

/// Elements that set both limits of a drive: in Gazebo, min_velocity counts for m/s and rad/s alike.
inline constexpr SpeedLimitElements kLinearOfBoth{{{"min_velocity", "min_velocity", "m/s", true},
                                                   {"max_velocity", "max_velocity", "m/s", true},
                                                   {"min_acceleration", "min_acceleration", "m/s^2", true},
                                                   {"max_acceleration", "max_acceleration", "m/s^2", true},
                                                   {"min_jerk", "min_jerk", "m/s^3", true},
                                                   {"max_jerk", "max_jerk", "m/s^3", true}}};
/// The same elements, read for the angular limits.
inline constexpr SpeedLimitElements kAngularOfBoth{
    {{"min_turn_rate", "min_velocity", "rad/s", true},
     {"max_turn_rate", "max_velocity", "rad/s", true},
     {"min_turn_acceleration", "min_acceleration", "rad/s^2", true},
     {"max_turn_acceleration", "max_acceleration", "rad/s^2", true},
     {"min_turn_jerk", "min_jerk", "rad/s^3", true},
     {"max_turn_jerk", "max_jerk", "rad/s^3", true}}};

/// Calls visit(Parameter, value) for each limit.
template <class Visitor, class Limits>
void visit_limits(Visitor&& visit, Limits& limits, const SpeedLimitElements& elements) {
    visit(elements.each[0], limits.min_velocity);
    visit(elements.each[1], limits.max_velocity);
    visit(elements.each[2], limits.min_acceleration);
    visit(elements.each[3], limits.max_acceleration);
    visit(elements.each[4], limits.min_jerk);
    visit(elements.each[5], limits.max_jerk);
}

/// How Gazebo publishes the odometry of a drive.
struct OdometryOutput {
    double rate = 50;   ///< Hz; zero or less: every tick
    std::string topic,  ///< empty: /model/NAME/odometry
        tf_topic,       ///< empty: /model/NAME/tf
        frame,          ///< empty: NAME/odom
        child_frame;    ///< empty: NAME/LINK
    /// Compares all members.
    friend bool operator==(const OdometryOutput&, const OdometryOutput&) = default;
};

/// Calls visit(Parameter, value) for each member.
template <class Visitor, class Output>
void visit_odometry(Visitor&& visit, Output& output) {
    visit({"odometry_rate", "odom_publish_frequency", "Hz"}, output.rate);
    visit({"odometry_topic", "odom_topic"}, output.topic);
    visit({"tf_topic", "tf_topic"}, output.tf_topic);
    visit({"frame", "frame_id"}, output.frame);
    visit({"child_frame", "child_frame_id"}, output.child_frame);
}

/// Adds a problem if a side has no wheel.
inline void expect_wheels(bool missing, std::vector<OnboardProblem>& problems) {
    if (missing)
        problems.push_back(
            {"names no wheel joint on one of its sides", "Name the joints of all its wheels."});
}
/// Adds a problem if a length is not above zero.
inline void expect_positive(const std::string& element, double value, std::vector<OnboardProblem>& problems) {
    if (!(value > 0))
        problems.push_back(
            {"has a <" + element + "> of " + std::to_string(value), "Write a number above 0."});
}

}  // namespace roboss
