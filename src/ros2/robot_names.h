// Names of ROS 2 for what a world names otherwise.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "model/model.h"

namespace roboss::ros2 {

/// The name with what ROS 2 allows in names: letters, digits and _, no digit in front; "::" becomes "/".
std::string ros_name(const std::string& name);

/// The same of each part of a path: "/front/scan" is "front/scan".
std::string ros_path(const std::string& path);

/// Why a name ("/front/scan") is none of ROS 2: "has a part without characters"; empty: it is one.
std::string problem_of_name(const std::string& name);

/// The path with another last part: "/front/image" is "/front/camera_info".
std::string beside(const std::string& path, const std::string& name);

/// The name, or with _2, _3 ... the first that is not taken; takes it.
std::string unique_name(const std::string& name, std::set<std::string>& taken);

/// The namespace of each robot without "/" in front, by RobotId: "car_3". That of `root`, the name of a robot
/// in the world, is "".
std::vector<std::string> robot_names(const Model& model, const std::string& root);

/// The name in the namespace of a robot, as robot_names() has it: "/car_3/scan", or "/scan".
std::string below(const std::string& robot, const std::string& name);

}  // namespace roboss::ros2
