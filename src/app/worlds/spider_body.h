// The spider robot: its measures, which the generator of the world and the gait of examples/spider share.
// Lengths in m, angles in rad, masses in kg.
//
// A leg is a chain of three hinges: the coxa turns about the vertical, femur and tibia about the horizontal
// across the leg. All joints are at 0 while the robot stands. Legs: front left, front right, middle left,
// ...; joints 3 * leg + (0 coxa, 1 femur, 2 tibia), as in the file.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace spider {

inline constexpr std::size_t kLegs = 6, kLegJoints = 3, kJoints = kLegs * kLegJoints;

inline constexpr std::array<std::string_view, kLegs> kLegNames{"front_left",   "front_right", "middle_left",
                                                               "middle_right", "rear_left",   "rear_right"};
inline constexpr std::array<std::string_view, kLegJoints> kPartNames{"coxa", "femur", "tibia"};

/// Where a leg begins, in the trunk's frame (x ahead, y to the left), and where it points while standing.
struct Hip {
    double x = 0, y = 0, azimuth = 0;
};
inline constexpr double kSplay = 0.698131700797731840;  // 40 degrees: front legs point ahead, rear legs back
inline constexpr double kQuarter = 1.570796326794896619;
inline constexpr std::array<Hip, kLegs> kHips{{
    {0.115, 0.060, kQuarter - kSplay},
    {0.115, -0.060, -(kQuarter - kSplay)},
    {0, 0.075, kQuarter},
    {0, -0.075, -kQuarter},
    {-0.115, 0.060, kQuarter + kSplay},
    {-0.115, -0.060, -(kQuarter + kSplay)},
}};

inline constexpr double kTrunkLength = 0.40;  // from the head to the end of the abdomen
inline constexpr std::array<double, kLegJoints> kPartLengths{0.045, 0.130, 0.190};
inline constexpr double kFootRadius = 0.012;
inline constexpr double kFemurUp = 0.610865238198015370;   // 35 degrees above the horizontal, standing
inline constexpr double kTibiaUp = -1.256637061435917295;  // 72 degrees below it

inline constexpr double kTrunkMass = 1.5;
inline constexpr std::array<double, kLegJoints> kPartMasses{0.09, 0.12, 0.05};
inline constexpr double kMass = kTrunkMass + kLegs * (kPartMasses[0] + kPartMasses[1] + kPartMasses[2]);

/// Lower and upper limits of coxa, femur and tibia.
inline constexpr std::array<std::array<double, 2>, kLegJoints> kJointLimits{
    {{-0.75, 0.75}, {-1.6, 0.9}, {-0.9, 1.8}}};

// Each motor is a position servo: torque = gain * (target - angle) - damping * speed, within its bounds.
inline constexpr double kServoGain = 60, kServoDamping = 0.6;  // N m/rad, N m s/rad
inline constexpr double kRotorInertia = 0.002;                 // kg m^2, behind the gears

}  // namespace spider
