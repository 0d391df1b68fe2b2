// The models that nearly every world of Gazebo includes and that Gazebo has installed or downloads: they are
// part of this program, for machines without Gazebo. A file of the same name that is found counts first.
#pragma once

#include <optional>
#include <string>

namespace roboss::sdf_import {

struct StandardModel {
    std::string path;  // stands for the file in diagnostics
    const char* text;  // SDFormat
};

/// model://sun and model://ground_plane, or their addresses on Fuel ("Sun", "Ground Plane" of OpenRobotics);
/// nullopt: another model.
std::optional<StandardModel> standard_model(const std::string& uri);

}  // namespace roboss::sdf_import
