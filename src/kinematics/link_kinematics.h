// Where the links of a robot are and how they move, for many configurations: forward kinematics and Jacobians
// (Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, chapters 2 and 3). Rows are those of robot_model.h.
#pragma once

#include <span>

#include "kinematics/robot_model.h"

namespace roboss {

/// In whose axes a vector is given.
enum class FrameAxes {
    kWorld,  ///< of the world
    kTool    ///< of the tool frame, which moves
};

/// Poses of a tool in the world, rows x 7: m, unit quaternions x y z w. X_LT: the tool frame in the link's
/// frame.
void tool_poses(const RobotModel& robot, std::span<const double> q, LinkId link, const Pose& X_LT,
                std::span<double> out);

/// Poses of all links in the world, rows x links x 7, by LinkId.
void link_poses(const RobotModel& robot, std::span<const double> q, std::span<double> out);

/// Velocities of a tool, rows x 6: linear velocity of its origin (m/s), angular velocity (rad/s), world axes.
void tool_twists(const RobotModel& robot, std::span<const double> q, std::span<const double> v, LinkId link,
                 const Pose& X_LT, std::span<double> out);

/// Geometric Jacobians of a tool, rows x 6 x v_columns(): twist = J v. Lines 0 to 2 are the linear velocity
/// of the tool's origin, 3 to 5 the angular velocity, in `axes`.
void tool_jacobians(const RobotModel& robot, std::span<const double> q, LinkId link, const Pose& X_LT,
                    FrameAxes axes, std::span<double> out);

}  // namespace roboss
