// Gives topics that drive robots the names and types of a bridge's file.
#pragma once

#include <vector>

#include "ros2/bridge.h"
#include "ros2/robot_commands.h"

namespace roboss::ros2 {

/// Gives each of `topics` that an entry names its name and type; further entries for it become topics of
/// their own. Others that have such a name get another one.
void name_commands(const BridgeMatch& bridge, const Model& model, std::vector<CommandTopic>& topics);

}  // namespace roboss::ros2
