// Joints: links and frames of the model that is read, types, axes and motors from the source.
#pragma once

#include <optional>
#include <string>

#include "sdf/conversion.h"
#include "sdf/model_tree.h"

namespace roboss::sdf_import {

/// X_MJ: the joint's frame in the outermost model's. nullopt for a type that is not known (reported), and for
/// a gearbox that couples nothing.
std::optional<JointSpec> convert_joint(const TreePart& joint, const ModelTree& model, const Pose& X_MJ,
                                       const std::string& scope, const Import& import);

}  // namespace roboss::sdf_import
