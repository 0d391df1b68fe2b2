// Trajectories between two places: of joints by quintic polynomials, of a tool along a straight line.
// Sources: Craig, Introduction to Robotics, 2005, chapter 7; Lynch and Park, Modern Robotics, 2017,
// chapter 9.
#pragma once

#include <span>

#include "math/pose.h"

namespace roboss {

/// A motion from positions q0 to q1 in the time from times.front() to times.back(), with the velocities v0
/// and v1 there and no acceleration there; each column by itself.
struct JointMotion {
    std::span<const double> q0, q1,  ///< rad or m, one a column
        v0, v1;                      ///< rad/s or m/s; empty: zeros
};

/// Values of a trajectory, times x columns each.
struct JointSamples {
    std::span<double> q,  ///< rad or m
        v,                ///< rad/s or m/s
        a;                ///< rad/s^2 or m/s^2
};

/// The quintic polynomials at `times`: s, ascending; the last is later than the first.
void joint_trajectory(const JointMotion& motion, std::span<const double> times, const JointSamples& out);

/// Poses X along a straight line, turning about a fixed axis by the shorter way (slerp), and their
/// velocities. The speed rises during `ramp` of the time, 0 to 0.5, is then constant, and falls during the
/// same (trapezoid).
///
/// times: s, ascending; the motion lasts from the first to the last. poses: times x 7, m and quaternion x y z
/// w. twists: times x 6, m/s of the frame's origin, rad/s; axes of the frame in which the poses are.
void cartesian_trajectory(const Pose& X0, const Pose& X1, double ramp, std::span<const double> times,
                          std::span<double> poses, std::span<double> twists);

}  // namespace roboss
