// The gait of the spider as pure functions: parameters and the place in the cycle give the path of each foot,
// and inverse kinematics in closed form the angles of its joints.
#pragma once

#include <array>
#include <cstddef>

#include <roboss/app/worlds/spider_body.h>

namespace spider {

/// Parameters of a gait. Lengths in m, angles in rad; phases and shares are parts of a cycle.
struct Gait {
    double period_s = 0.6;  // of a cycle: each foot makes one step in it
    double duty = 0.5;      // share of the cycle that a foot stands on the ground
    double stride = 0.12;   // that a standing foot moves backwards; speed = stride / (duty * period)
    double lift = 0.04;     // height of a step
    double ease = 0.5;      // 0: a swinging foot moves evenly; 1: it lands at the speed of the ground
    double height = 0.118;  // of the hips above the ground
    double reach = 0.210;   // from a hip to its foot, along the ground, in the middle of a stride
    double splay = kSplay;  // of the front and rear legs in the middle of a stride
    double shift = 0;       // of all feet forwards
    double lead_s = 0.01;   // targets are those of this time ahead: makes up for the lag of the servos
    std::array<double, kLegs> phases{0, 0.5, 0.5, 0, 0, 0.5};  // alternating tripods
};

struct Point {
    double x = 0, y = 0, z = 0;
};

/// A foot in the trunk's frame at a place of the cycle, 0 to 1, of the leg itself. `amount`, 0 to 1, scales
/// the step (0: it stands); `turn` is the angle by which the trunk turns in one stride, to the left.
Point foot(const Gait& gait, std::size_t leg, double phase, double amount, double turn);

/// Joint angles of coxa, femur and tibia that bring the foot there. A point beyond the reach of the leg gives
/// the nearest that the leg reaches in that direction; angles are clamped to the joints' limits.
std::array<double, kLegJoints> leg_angles(std::size_t leg, const Point& foot);

/// Where the foot is at these angles, in the trunk's frame.
Point foot_of_angles(std::size_t leg, const std::array<double, kLegJoints>& angles);

/// Targets of all joints `time_s` after the start of the walk: the steps grow during the first two cycles.
std::array<double, kJoints> targets(const Gait& gait, double time_s, double turn);

}  // namespace spider
