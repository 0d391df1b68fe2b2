// What a page reads of a robot's on-board controllers, surfaces and bonds: parts of the JSON of "robot"
// (docs/viewer-protocol.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "model/robot_state.h"

namespace roboss {

/// Adds "channels", "surfaces", "bonds" and "held_by" to `out`, each only where the robot has some. `states`:
/// by RobotId, those that are known; who holds the robot is searched in them.
void add_onboard(const Model& model, RobotId robot, std::span<const std::optional<RobotState>> states,
                 nlohmann::ordered_json& out);

}  // namespace roboss
