// libgazebo_ros_diff_drive.so and libgazebo_ros_skid_steer_drive.so of classic Gazebo.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/ros_drive.h"
#include "onboard_kinds/speed_limits.h"

namespace roboss {

/// Places in the memory of a RosDiffDriveSpec or RosSkidSteerSpec; it begins with the odometry.
struct RosDiffDriveMemory {
    static constexpr std::size_t kOdometry = 0,  ///< OnboardKind::odometry
        kStarted = 5,                            ///< 1: the angles below are known
        kLeftAngle = 6,                          ///< rad, of the first left wheel at the last tick
        kRightAngle = 7,                         ///< rad
        kRims = 8;                               ///< m/s: rim speed of each pair's left, right wheel
};

/// Pairs of wheels, each with a separation and diameter of its own. Motors of bounded torque hold the wheels'
/// speeds; an acceleration bounds the change of each rim's speed.
struct RosDiffDriveSpec {
    JointNames left,                  ///< wheel joints
        right;                        ///< wheel joints, as many
    std::vector<double> separations,  ///< m, one a pair
        diameters;                    ///< m, one a pair
    int pairs = 1;                    ///< number of pairs
    double torque = 5.0,              ///< N m, of each wheel
        acceleration = 0;             ///< m/s^2 of the rim; 0: unbounded
    RosDrive ros;                     ///< topics, odometry

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 14,
                                       .name = "ros-diff-drive",
                                       .phrase = "a differential drive",
                                       .classes = "",
                                       .files = "gazebo_ros_diff_drive",
                                       .ignored = kRosIgnored,
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"left", "left_joint|leftJoint"}, s.left);
        visit({"right", "right_joint|rightJoint"}, s.right);
        visit({"separations", "wheel_separation|wheelSeparation", "m"}, s.separations);
        visit({"diameters", "wheel_diameter|wheelDiameter", "m"}, s.diameters);
        visit({"pairs", "num_wheel_pairs"}, s.pairs);
        visit({"torque", "max_wheel_torque|wheelTorque", "N m"}, s.torque);
        visit({"acceleration", "max_wheel_acceleration|wheelAcceleration", "m/s^2"}, s.acceleration);
        RosDrive::parameters(visit, s.ros);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const { return {ros.command()}; }
    /// Separation of the wheels of a pair, m.
    double separation(std::size_t pair) const { return pair < separations.size() ? separations[pair] : 0.34; }
    /// Diameter of the wheels of a pair, m.
    double diameter(std::size_t pair) const { return pair < diameters.size() ? diameters[pair] : 0.15; }
    /// Its memory at the start.
    std::vector<double> memory() const {
        return std::vector<double>(RosDiffDriveMemory::kRims + 2 * left.size(), 0.0);
    }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const {
        bool still = true;
        for (const double rim : m.subspan(RosDiffDriveMemory::kRims)) still = still && rim == 0;
        return still;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        expect_wheels(left.empty() || left.size() != right.size(), problems);
        if (pairs < 1 || static_cast<std::size_t>(pairs) != left.size())
            problems.push_back({"has " + std::to_string(left.size()) + " left wheels and num_wheel_pairs " +
                                    std::to_string(pairs),
                                "Name one left and one right wheel for each pair."});
        for (std::size_t pair = 0; pair < left.size(); ++pair)
            expect_positive("wheel_diameter", diameter(pair), problems);
    }
    /// Compares all members.
    friend bool operator==(const RosDiffDriveSpec&, const RosDiffDriveSpec&) = default;
};

/// Four wheels; both of a side turn equally fast.
struct RosSkidSteerSpec {
    JointNames left_front,    ///< wheel joint
        right_front,          ///< wheel joint
        left_rear,            ///< wheel joint
        right_rear;           ///< wheel joint
    double separation = 0.4,  ///< m
        diameter = 0.15,      ///< m
        torque = 5.0;         ///< N m, of each wheel
    RosDrive ros;             ///< topics, odometry

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 15,
                                       .name = "ros-skid-steer",
                                       .phrase = "a skid steering drive",
                                       .classes = "",
                                       .files = "gazebo_ros_skid_steer_drive",
                                       .ignored = kRosIgnored,
                                       .odometry = 0};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"left_front", "leftFrontJoint"}, s.left_front);
        visit({"right_front", "rightFrontJoint"}, s.right_front);
        visit({"left_rear", "leftRearJoint"}, s.left_rear);
        visit({"right_rear", "rightRearJoint"}, s.right_rear);
        visit({"separation", "wheelSeparation", "m"}, s.separation);
        visit({"diameter", "wheelDiameter", "m"}, s.diameter);
        visit({"torque", "torque", "N m"}, s.torque);
        RosDrive::parameters(visit, s.ros);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const { return {ros.command()}; }
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(RosDiffDriveMemory::kRims, 0.0); }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        expect_wheels(left_front.empty() || right_front.empty() || left_rear.empty() || right_rear.empty(),
                      problems);
        expect_positive("wheelDiameter", diameter, problems);
    }
    /// Compares all members.
    friend bool operator==(const RosSkidSteerSpec&, const RosSkidSteerSpec&) = default;
};

}  // namespace roboss
