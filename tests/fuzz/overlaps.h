// Random worlds that start overlapping: robots in the ground and in each other, at rest.
#pragma once

#include "fuzz/scene.h"

namespace roboss::fuzz {

/// One robot that starts in the ground.
Scene sunk(Random& random, const Setting& setting);
/// A few robots that start in the ground and in each other.
Scene jammed(Random& random, const Setting& setting);

}  // namespace roboss::fuzz
