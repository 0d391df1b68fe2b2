// Models whose shapes a saved <state> scales.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "world/world.h"

namespace roboss::sdf_import {

/// Factors along x, y and z of a shape's own frame, by the scope of the links that they count for: "" or
/// "inner::". Of several that fit the longest counts.
using ModelScale = std::vector<std::pair<std::string, Vec3>>;

/// Multiplies the sizes of all shapes, as Gazebo Classic does: a round one has one radius still, by the
/// largest factor across it; masses and the places of shapes stay.
void scale_shapes(const ModelScale& scale, ModelSpec& model);

}  // namespace roboss::sdf_import
