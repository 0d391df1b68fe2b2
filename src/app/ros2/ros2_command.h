// roboss ros2: shows a running simulation to ROS 2 nodes.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_ros2_command(CLI::App& app, int& exit_code);

}  // namespace roboss
