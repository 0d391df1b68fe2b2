// Reads the parameters of ros2_control's drives (control.ros.org, "ros2_controllers").
#pragma once

#include <string>

#include "ros2/controller_parameters.h"

namespace roboss::ros2 {

/// Reads the parameters of a drive. What is wrong, and what has no effect, is in the parameters afterwards.
using DriveReader = DriveController (*)(ControllerParameters& parameters);

/// The one of a type, such as "diff_drive_controller/DiffDriveController"; null: RoBOSS has no such drive.
DriveReader drive_reader(const std::string& type);

}  // namespace roboss::ros2
