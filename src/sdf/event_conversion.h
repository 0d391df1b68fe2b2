// Plugins that pass messages on (TriggeredPublisher) or send them when something happens in the world
// (TouchPlugin, PerformerDetector): they look at several models, so they become a message board
// (onboard_kinds/message_board.h) once all models are known.
#pragma once

#include <vector>

#include "core/diagnostics.h"
#include "sdf/crumb_conversion.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// Classes of these plugins, separated by |: their elements are kept as they are until convert_events().
inline constexpr const char* kEventPlugins = "TriggeredPublisher|TouchPlugin|PerformerDetector";

/// Adds the message board to the world, if it needs one, and says what becomes of each of these plugins.
void convert_events(World& world, const std::vector<CrumbSupply>& crumbs, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
