// Odometry of drives: what wheels say about the way of the robot, and its pose where the truth is known.
#pragma once

#include <cstddef>
#include <span>

#include "onboard/onboard_context.h"

namespace roboss {

/// A displacement of the robot during a tick, in its own axes.
struct OdometryStep {
    double forward = 0,  ///< m
        left = 0,        ///< m
        turn = 0;        ///< rad
};

/// Moves odometry (five numbers, OnboardKind::odometry) along the arc of the step.
void move_odometry(std::span<double> odometry, const OdometryStep& step, double dt);

/// Pose of the robot in the plane, in the world.
struct PlanarPose {
    double x = 0, y = 0,  ///< m, of the robot's frame
        yaw = 0;          ///< rad
};
PlanarPose planar_pose(const RobotType& type, const RobotState& state);

/// Sets odometry to the true pose and to the base's velocity in the axes of its heading.
void set_true_odometry(std::span<double> odometry, const RobotType& type, const RobotState& state);

}  // namespace roboss
