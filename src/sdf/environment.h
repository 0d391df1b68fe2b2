// What sensors read of the world besides robots: the table of EnvironmentPreload, and static models.
#pragma once

#include "sdf/conversion.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {

/// Whether the plugin loads the table or serves the sensors that read it.
bool is_environment_plugin(const PluginName& name);

/// Reads the table of the world's EnvironmentPreload and gives its columns to the environmental sensors;
/// reports a file, a column or a point of the grid that is missing.
void convert_environment(World& world, const Import& import);

/// Gives the logical cameras the names and poses of the models that have no state of their own.
void show_scenery(World& world);

}  // namespace roboss::sdf_import
