// Keeps explicit centrifugal and gyroscopic forces from feeding energy to the solver of what turns far in a
// tick.
#pragma once

#include "physics/dynamics/integrate.h"

namespace roboss {

/// Centrifugal and gyroscopic forces do no work. Taken at the beginning of the tick, as the solver takes
/// them, they add j M^-1 j / 2 to the energy. Where a robot turns fast (fast_turning.h) and a body turns by
/// more than half a radian in the tick, j is cut back so that it adds no more than a small share: else rows
/// would be solved for velocities without bound. A lone body that turns fast has none in the solver:
/// gyroscopic torque mostly turns its angular velocity along with it, and a contact row, which has the arms
/// of the beginning, would take that for motion of the contact point. The drift (kick_drift.h) has it. `work`
/// has its impulse and mass matrix; the impulse changes, and `buffer` is overwritten.
void limit_velocity_forces(const Model& model, RobotWork& work, FreeBuffer& buffer);

}  // namespace roboss
