// <ros2_control> in URDF: of it, initial positions and mimic joints count, as for the joints of
// gz_ros2_control.
#pragma once

#include <map>
#include <string>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// Initial positions by the name of their joint, as text of a number: <state_interface name="position"> with
/// the parameter initial_value. A joint with the parameter mimic, and without a <mimic> of its own, gets one
/// in `robot`. One note for each <ros2_control>; a warning for a value that is no number, or that the joint's
/// limits exclude.
std::map<std::string, std::string> read_ros2_control(pugi::xml_node robot, const SourceFile& urdf,
                                                     Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
