// Plugins of a world that pass messages between robots (RFComms, PerfectComms of Gazebo): what they say holds
// for the radios of its models that were made from CommsEndpoint plugins.
#pragma once

#include "sdf/conversion.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {

/// Whether the plugin passes messages between robots.
bool is_comms_plugin(const PluginName& name);

/// Gives the radios of CommsEndpoint plugins the parameters of the world's plugin. Reports endpoints that no
/// plugin serves. Call it when all models are known.
void convert_comms(World& world, const Import& import);

}  // namespace roboss::sdf_import
