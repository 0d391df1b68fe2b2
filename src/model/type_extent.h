// A sphere that holds a robot of a type in every pose.
#pragma once

#include "math/vec3.h"
#include "model/model.h"

namespace roboss {

/// In the base frame, m.
struct ReachSphere {
    Vec3 centre{};
    double radius = 0;
};

/// Holds every shape in every pose, with slides within their limits. Of a robot on a fixed base it is the
/// sphere about its first joint, if that is smaller than the one about its base (RobotType::reach).
ReachSphere reach_sphere_of(const RobotType& type);

}  // namespace roboss
