// Writes a ModelSpec as MuJoCo's XML, straight from the World and past our own compile, so that an error
// there shows too.
#pragma once

#include <string>

#include "world/world.h"

namespace roboss::test {

/// One model at X_WM, contacts off. Bodies are named as the links, joints as the joints (a second axis: name
/// + "_1"); a free base's joint is "base". Kinds: fixed, revolute, continuous, prismatic, ball, universal;
/// parents before children in file order.
std::string to_mjcf(const ModelSpec& model, const Pose& X_WM, const Vec3& gravity);

}  // namespace roboss::test
