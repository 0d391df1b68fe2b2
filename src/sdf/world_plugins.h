// Plugins of a world that act on its models: each model gets controllers of its own.
#pragma once

#include <vector>

#include "world/world.h"

namespace roboss::sdf_import {

/// Adds the controllers that `plugins` mean to the models of `world`. Equal models for which they mean
/// different controllers become different prototypes. A plugin that belongs into a model is reported.
void attach_world_plugins(const std::vector<OnboardSpec>& plugins, World& world, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
