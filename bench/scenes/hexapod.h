// A six-legged walker of 40 cm and 18 hinges with position servos, and its tripod gait by inverse kinematics.
// Its zero pose is standing, so no engine needs to be told joint positions.
#pragma once

#include <array>
#include <cstddef>

#include "engines/engine.h"

namespace roboss::bench {

inline constexpr std::size_t kHexapodLegs = 6;
inline constexpr double kHexapodHeight = 0.135;  // of the body's centre over the ground, standing, m

/// Link 0 is the body (the model's frame is its centre, x forward); leg l has joints 3 l (yaw), 3 l + 1, 3 l
/// + 2 (pitch), left and right in turn from front to rear.
ModelSpec hexapod();

struct Gait {
    double speed = 0.2;   // m/s, forward
    double period = 0.6;  // s; three legs stand in each half of it
    double lift = 0.03;   // m
    double start = 1;     // s, standing still before
};

/// Angles of all 18 joints at time t, from the zero pose, rad.
std::array<double, 3 * kHexapodLegs> hexapod_angles(const Gait& gait, double t);

/// Gives them to the servos of an instance.
void walk(Engine& engine, std::size_t instance, const Gait& gait, double t);

}  // namespace roboss::bench
