// Pulls: springs with damping by which a hand, or a program, holds a point of a robot (the order Pull).
#pragma once

#include "physics/dynamics/robot_work.h"

namespace roboss {

/// Gives the robot a wrench of this tick for each of its pulls, and drops those that are over. `work` is
/// overwritten.
///
/// The force on the point is m (r^2 d - 2 r v), with its distance d to the target, its velocity v, the rate r
/// and the apparent mass m of the robot at this point: 3 / trace(J M^-1 J^T) over the three directions. So
/// the spring is critically damped whatever robot it pulls. d is counted up to where the spring alone would
/// give the greatest force, which bounds the speed of the approach and so the overshoot. A rate above a
/// quarter of a radian a tick is lowered to it: the force is that of the beginning of the tick.
void apply_pulls(const Model& model, Tick tick, RobotId robot, RobotState& state, RobotWork& work);

}  // namespace roboss
