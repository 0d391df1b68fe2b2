// A sphere that holds a robot of a type in every pose.
#pragma once

#include "math/vec3.h"

namespace roboss {

/// In the base frame, m.
struct ReachSphere {
    Vec3 centre{};
    double radius = 0;
};

}  // namespace roboss
