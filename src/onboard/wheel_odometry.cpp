// See wheel_odometry.h.
#include "onboard/wheel_odometry.h"

#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

/// sin(h) / h
double sine_ratio(double h) {
    const double z = h * h;
    if (z < 1e-3) return 1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0));  // next term: below 1e-17
    return fixed_sin(h) / h;
}

}  // namespace

void move_odometry(std::span<double> odometry, const OdometryStep& step, double dt) {
    // An arc: its chord stands half the turn away from the heading, and is shorter than it by sin(h) / h.
    const double half = 0.5 * step.turn, chord = sine_ratio(half);
    const SinCos heading = fixed_sincos(odometry[2] + half);
    odometry[0] += chord * (step.forward * heading.cos - step.left * heading.sin);
    odometry[1] += chord * (step.forward * heading.sin + step.left * heading.cos);
    odometry[2] += step.turn;
    if (std::fabs(odometry[2]) > kPi) odometry[2] = wrap_angle(odometry[2]);
    odometry[3] = step.forward / dt, odometry[4] = step.turn / dt;
}

PlanarPose planar_pose(const RobotType& type, const RobotState& state) {
    const Transform X_WB = to_transform(base_pose(state));
    const Mat3 R_WR = X_WB.R * transpose(type.X_RB.R);
    const Vec3 p = X_WB.p - R_WR * type.X_RB.p;
    return {p.x, p.y, fixed_atan2(R_WR.r1.x, R_WR.r0.x)};
}

void set_true_odometry(std::span<double> odometry, const RobotType& type, const RobotState& state) {
    const PlanarPose pose = planar_pose(type, state);
    odometry[0] = pose.x, odometry[1] = pose.y, odometry[2] = pose.yaw;
    if (!type.free_base) return;
    const SinCos heading = fixed_sincos(pose.yaw);
    odometry[3] = state.v[3] * heading.cos + state.v[4] * heading.sin, odometry[4] = state.v[2];
}

}  // namespace roboss
