// Where the bodies and links of a robot are and how they move, from its state alone.
#pragma once

#include <span>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// Poses of all bodies by body index, in m; X_WB has type.bodies.size() entries.
void body_poses(const RobotType& type, const RobotState& state, std::span<Transform> X_WB);

/// Velocity of a frame relative to the world.
struct Twist {
    Vec3 angular;  // rad/s, world axes
    Vec3 linear;   // m/s, of the frame's origin, world axes
};

/// Pose X_WL of one link, in m (computes all bodies of the robot; for tools, traces and sensors, not for the
/// step).
Transform link_pose(const RobotType& type, const RobotState& state, LinkId link);
/// Velocity of the link's frame at its origin; zero if the link belongs to a fixed base.
Twist link_twist(const RobotType& type, const RobotState& state, LinkId link);

/// Position and velocity of one axis of a joint, rad or m and a second. Of a joint that closes a loop from
/// its two bodies: angles in (-pi, pi]. Of a ball joint: the rotation vector and the angular velocity of the
/// file's child in the parent's joint frame. A joint that does not move: zeros.
struct JointState {
    double position = 0,  ///< rad or m
        velocity = 0;     ///< rad/s or m/s
};
/// Zeros if the joint has no such axis. `id` must be a joint of the type.
JointState joint_state(const RobotType& type, const RobotState& state, JointId id, int axis = 0);

}  // namespace roboss
