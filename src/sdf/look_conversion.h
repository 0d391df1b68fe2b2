// What viewers need of a world beside visuals: <light>, <scene>, and the camera of <gui>.
#pragma once

#include <functional>

#include "sdf/conversion.h"
#include "sdf/include_store.h"

namespace roboss::sdf_import {

/// A <light>; nullopt: of an unknown type (reported), or switched off.
std::optional<LightSpec> convert_light(const Element& light, const Pose& X_FL, const Import& import);

/// Lights of the world and of included files that hold nothing else, <scene> and <gui>. `pose_of`: the pose
/// of a light of the world, in the world.
void read_look(const Element& world, IncludeStore& includes,
               const std::function<Pose(const Element&)>& pose_of, const Import& import, WorldLook& look);

}  // namespace roboss::sdf_import
