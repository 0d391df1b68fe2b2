// Puts the drives of a file of ros2_control into a World, before it is compiled: they run on board, as those
// of plugins do, so the Model and its hash have them.
#pragma once

#include <string>

#include "ros2/controllers_file.h"
#include "world/world.h"

namespace roboss::ros2 {

/// Gives each model the drives of the file that are for it: with all of their wheel joints in it, none of
/// which an on-board controller moves already; of a namespace only where that is the model's name in ROS 2.
/// With a drive come its odometry, a sensor, and the timeout of its command. `root`: as in TopicOptions.
/// `name`: what the only model is called where the world is added to a run; empty: as in the World.
void add_drives(const Controllers& controllers, const std::string& root, const std::string& name,
                World& world);

}  // namespace roboss::ros2
