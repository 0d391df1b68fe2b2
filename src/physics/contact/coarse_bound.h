// A box that surely holds a robot's interaction bound, from its state alone, without placing its bodies: a
// sphere of the robot's whole reach, and what it can move in a tick. Robots whose coarse boxes are apart
// cannot meet.
#pragma once

#include "math/aabb.h"
#include "model/model.h"
#include "model/robot_state.h"
#include "model/type_extent.h"

namespace roboss {

/// Not finite where the state is not, or the reach has no limit. `sphere`: reach_sphere_of(type).
Aabb coarse_bound(const RobotType& type, const ReachSphere& sphere, const RobotState& state, double dt);

}  // namespace roboss
