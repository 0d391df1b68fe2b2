// robot_description: a robot of the Model as URDF, as ROS 2 programs want it: robot_state_publisher, RViz,
// MoveIt.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace roboss::ros2 {

/// The robot as URDF text. Links have the names `frames`, by LinkId. What URDF cannot say is left out: joints
/// that close loops, shapes that are no box, sphere, cylinder or capsule. A capsule is a cylinder and two
/// spheres. A joint whose frame is not that of its link, or that has several axes, has links without mass in
/// between. A robot on a fixed base hangs on a link "world".
std::string urdf_of(const Model& model, RobotId robot, const std::string& name,
                    const std::vector<std::string>& frames);

}  // namespace roboss::ros2
