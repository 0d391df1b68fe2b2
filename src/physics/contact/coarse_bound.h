// A box that surely holds a robot's interaction bound, from its state alone, without placing its bodies: a
// sphere of the robot's whole reach, and what it can move in a tick. Robots whose coarse boxes are apart
// cannot meet.
#pragma once

#include "math/aabb.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// Not finite where the state is not, or the reach has no limit.
Aabb coarse_bound(const RobotType& type, const RobotState& state, double dt);

}  // namespace roboss
