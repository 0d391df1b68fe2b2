// How the arm gets somewhere: inverse kinematics in closed form and motions of its joints. Pure functions, in
// the frame of the cell (src/app/worlds/cell_layout.h).
#pragma once

#include <array>
#include <optional>

#include <roboss/app/worlds/cell_layout.h>

namespace arm_cell {

/// Positions of shoulder, elbow, lift and wrist: rad, rad, m, rad.
using Joints = std::array<double, 4>;

/// Where the hand is: m, and the direction of its x axis in rad. Its tip is the ends of the fingers, or the
/// cup.
struct HandPose {
    double x = 0, y = 0, z = 0, yaw = 0;
};

HandPose forward(const Joints& q);

/// Joints that put the hand at the pose, with the elbow to the left. A box looks the same after half a turn,
/// so the yaw counts modulo pi, and the wrist turns as little as it can from `wrist`. std::nullopt: out of
/// reach.
std::optional<Joints> inverse(const HandPose& pose, double wrist);

/// From rest to rest by quintic polynomials, all joints in the same time.
struct Motion {
    Joints from{}, to{};
    double begin_s = 0, length_s = 0;

    double end_s() const { return begin_s + length_s; }
    Joints at(double time_s) const;
};

/// The fastest motion within kJointLimits.
Motion motion(const Joints& from, const Joints& to, double begin_s);

}  // namespace arm_cell
