// Plugins that publish something become sensors of their model: of the link that they name, else of the
// model's frame.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sdf/conversion.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {

/// A sensor that was made from a plugin, before the model's links are known.
struct PluginSensor {
    SensorSpec spec;   ///< X_LS: in the frame that it observes
    std::string link;  ///< that it observes; "": the model's frame
};

/// Whether a kind of sensor stands for the plugin, by itself and not for one of its controllers.
bool is_sensor_plugin(const PluginName& name);

/// The sensors that the plugin stands for: those of its own, and those of the controller that it became, the
/// last of `onboard` (`controls`: it did).
std::vector<PluginSensor> convert_plugin_sensors(const Element& plugin, const std::string& scope,
                                                 std::span<const OnboardSpec> onboard, bool controls,
                                                 const Import& import);

/// Puts a sensor on its link; of the model's frame, on `canonical_link`, with X_MS the frame's pose in the
/// outermost model. Reports one whose link is not there.
void attach_plugin_sensor(PluginSensor sensor, const std::string& canonical_link, const Pose& X_MS,
                          const Import& import, ModelSpec& model);

}  // namespace roboss::sdf_import
