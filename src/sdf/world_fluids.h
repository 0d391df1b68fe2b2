// Plugins of the world that change what its robots feel: fluids that carry them (Buoyancy), and the wind
// (WindEffects).
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Takes the plugin of a world into `out` if it is one of these; false: it is none.
bool convert_fluid_plugin(const Element& plugin, const Import& import, World& out);

/// Marks the links that the world's fluids carry. An instance of which other links float than of those before
/// gets a prototype of its own. Call it when all models are placed.
void mark_buoyant(World& world);

}  // namespace roboss::sdf_import
