// Where a robot starts if the world says it of its links (SDF <state>): base pose, joint coordinates and
// velocities follow from poses and velocities of links. Internal to the model layer.
#pragma once

#include "model/model.h"

namespace roboss {

/// Sets Robot::X_WR, start_q and start_v from what `instance` says of the links and axes of this robot. A
/// note tells if its joints cannot put the links where they are said to be.
void set_start(const ModelInstance& instance, const RobotType& type, Robot& robot, Diagnostics& diagnostics);

}  // namespace roboss
