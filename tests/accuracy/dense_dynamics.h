// Constrained dynamics written anew, densely: masses and forces of the links from their twists, loops from
// poses of links, all derivatives along the motion by central differences of sixth order, and one big system
// of M, J and multipliers. Shares nothing with the step but the coordinates and the poses and twists of
// links.
#pragma once

#include <vector>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss::test {

/// Joint accelerations of robot 0 of the model, made of `spec`; `joint_force` one a Dof of the tree.
std::vector<double> dense_acceleration(const Model& model, const ModelSpec& spec, const RobotState& state,
                                       const std::vector<double>& joint_force);

}  // namespace roboss::test
