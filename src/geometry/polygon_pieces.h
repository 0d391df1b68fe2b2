// A simple polygon cut into convex ones.
#pragma once

#include <span>
#include <vector>

#include "core/result.h"
#include "math/vec3.h"

namespace roboss {

/// Convex pieces (counter-clockwise, z = 0) of a polygon given by its corners in order, either way round; a
/// repeated last corner and corners on a straight line are fine. An error when it has no area or crosses
/// itself.
Result<std::vector<std::vector<Vec3>>> convex_pieces(std::span<const Vec3> outline);

}  // namespace roboss
