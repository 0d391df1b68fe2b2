// What a <world> says beside its models: time step, gravity, air, place on the Earth; and what of it is not
// simulated.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// `profile`: the name of the <physics> wanted, empty: the world's own choice. Sets what of it concerns the
/// models in `import`.
void read_world_settings(const Element& world, const std::string& profile, Import& import, World& out,
                         std::vector<OnboardSpec>& plugins);

}  // namespace roboss::sdf_import
