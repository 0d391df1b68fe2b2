// AckermannSteering of Gazebo: drives and steers a car so that it follows a commanded velocity, or steers
// only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/speed_limits.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// The steering joints are driven by speed_gain times their distance from the angle wanted. Before the first
/// command the wheels are held at zero and steered straight.
struct AckermannSteeringSpec {
    JointNames left,                ///< driven wheels of the left side; the first one is the odometer
        right,                      ///< driven wheels of the right side
        left_steering,              ///< steering joints of the left side; the first one is measured
        right_steering;             ///< of the right side
    double wheel_separation = 1.0,  ///< m, between the wheels of an axle
        kingpin_width = 0.8,        ///< m, between the steering axes
        wheel_base = 1.0,           ///< m, between the axles
        steering_limit = 0.5,       ///< rad
        wheel_radius = 0.2,         ///< m
        speed_gain = 1.0;           ///< 1/s, of the steering
    SpeedLimits linear,             ///< m/s
        angular;                    ///< rad/s; with steering_only rad of the angle
    bool steering_only = false,     ///< commands are steering angles
        use_actuators = false;      ///< steering_only, with a command that names an actuator
    int actuator_number = -1;       ///< of the angle in Gazebo's Actuators message
    std::string topic,              ///< of the command; empty: sub_topic
        sub_topic;                  ///< of the command behind /model/NAME/; empty: cmd_vel or steer_angle
    OdometryOutput output;          ///< of the odometry

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 11,
                                       .name = "ackermann-steering",
                                       .phrase = "an Ackermann steering",
                                       .classes = "AckermannSteering",
                                       .files = "ackermann-steering-system",
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"left", "left_joint"}, s.left);
        visit({"right", "right_joint"}, s.right);
        visit({"left_steering", "left_steering_joint"}, s.left_steering);
        visit({"right_steering", "right_steering_joint"}, s.right_steering);
        visit({"wheel_separation", "wheel_separation", "m"}, s.wheel_separation);
        visit({"kingpin_width", "kingpin_width", "m"}, s.kingpin_width);
        visit({"wheel_base", "wheel_base", "m"}, s.wheel_base);
        visit({"steering_limit", "steering_limit", "rad"}, s.steering_limit);
        visit({"wheel_radius", "wheel_radius", "m"}, s.wheel_radius);
        visit({"speed_gain", "steer_p_gain", "1/s"}, s.speed_gain);
        visit_limits(visit, s.linear, kLinearOfBoth);
        visit_limits(visit, s.angular, kAngularOfBoth);
        visit({"steering_only", "steering_only"}, s.steering_only);
        visit({"use_actuators", "use_actuator_msg"}, s.use_actuators);
        visit({"actuator_number", "actuator_number"}, s.actuator_number);
        visit({"topic", "topic"}, s.topic);
        visit({"sub_topic", "sub_topic"}, s.sub_topic);
        visit_odometry(visit, s.output);
    }
    /// Whether its command is an actuator's: use_actuator_msg counts with a number only.
    bool takes_actuator() const { return use_actuators && actuator_number >= 0; }
    /// Whether it steers and does not drive.
    bool only_steers() const { return steering_only || takes_actuator(); }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        if (takes_actuator()) {
            const std::string name = "actuators/position/" + std::to_string(actuator_number);
            return {{name, topic.empty() ? "/actuators" : topic, {{"position", "rad"}}}};
        }
        if (steering_only) return {channel_of(topic, usual_topic("steer_angle"), {{"angle", "rad"}})};
        return {twist_channel(topic, usual_topic("cmd_vel"))};
    }
    /// Places in its memory; it begins with the odometry (OnboardKind::odometry), zeros if it only steers.
    enum Memory : std::size_t {
        kOdometry = 0,
        kStarted = 5,     ///< 1: the angles below are known
        kLeftAngle = 6,   ///< rad, of the first left wheel at the last tick
        kRightAngle = 7,  ///< rad
        kSpeed = 8,       ///< m/s, the last two commands after the limits
        kTurnRate = 10,   ///< rad/s, likewise; rad if it only steers
        kMemorySize = 12
    };
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// Whether it would change nothing while its robot is at rest: its last two commands were the same.
    bool rests(std::span<const double> m) const {
        return m[kSpeed] == 0 && m[kSpeed + 1] == 0 && m[kTurnRate] == m[kTurnRate + 1];
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (left_steering.empty() || right_steering.empty())
            problems.push_back({"names no steering joint on one of its sides", "Name both steering joints."});
        expect_positive("wheel_base", wheel_base, problems);
        if (only_steers()) return;
        expect_wheels(left.empty() || right.empty(), problems);
        expect_positive("wheel_separation", wheel_separation, problems);
        expect_positive("wheel_radius", wheel_radius, problems);
        expect_positive("steering_limit", steering_limit, problems);
    }
    /// Compares all members.
    friend bool operator==(const AckermannSteeringSpec&, const AckermannSteeringSpec&) = default;

  private:
    std::string usual_topic(const char* usual) const { return sub_topic.empty() ? usual : sub_topic; }
};

}  // namespace roboss
