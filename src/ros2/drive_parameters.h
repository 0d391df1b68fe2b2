// What the parameters of ros2_control's drives (control.ros.org, "ros2_controllers") mean here.
#pragma once

#include <string>

#include "ros2/controller_parameters.h"

namespace roboss::ros2 {

/// Reads the parameters of a drive. What is wrong, and what has no effect, is in the parameters afterwards.
using DriveReader = DriveController (*)(ControllerParameters& parameters);

/// The one of a type, such as "diff_drive_controller/DiffDriveController"; null: it is no drive that there is
/// here.
DriveReader drive_reader(const std::string& type);

}  // namespace roboss::ros2
