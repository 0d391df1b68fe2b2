// Joints as libsdformat read them, with the numbers of their axes from the source.
#pragma once

#include <optional>
#include <sdf/Joint.hh>
#include <string>

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// X_MJ: the joint's frame in the outermost model's. nullopt for a type that is not known (libsdformat has
/// reported it).
std::optional<JointSpec> convert_joint(const sdf::Joint& joint, const Element& source, const Pose& X_MJ,
                                       const std::string& scope, const Import& import);

}  // namespace roboss::sdf_import
