// Static models become scenery, which has no sensors. One that carries a laser or the like becomes a robot
// welded to the world instead, so that a Client can read it.
#pragma once

#include "world/world.h"

namespace roboss::sdf_import {

/// Does so for a static `model` with sensors that are simulated, and says so.
void keep_sensors_of_static(ModelSpec& model, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
