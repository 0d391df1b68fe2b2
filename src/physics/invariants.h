// What holds of all states between two ticks. Costs about as much as a step: for tests, which so find a fault
// at the tick in which it arises.
#pragma once

#include <limits>
#include <span>
#include <string>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// The first invariant that is violated, with the robot's name and the values; empty: all hold. `states` by
/// RobotId:
/// - sizes are those of the type; all numbers are finite; quaternions have unit length;
/// - the mass matrix is positive definite;
/// - warm-start impulses are sorted by (other robot, shapes, feature) and push; friction exceeds its bound by
/// no more than
///   the share `friction_error`. (Where robots start deep in each other the solver may end before friction
///   converges.)
/// - sleepers are at rest, have a bound, and sleep together with those that they touch.
std::string check_invariants(const Model& model, std::span<const RobotState> states,
                             double friction_error = std::numeric_limits<double>::infinity());

}  // namespace roboss
