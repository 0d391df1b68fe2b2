// What a <world> says beside its models: time step, gravity, place on the Earth; and what of it is not
// simulated.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

void read_world_settings(const Element& world, const Import& import, World& out);

}  // namespace roboss::sdf_import
