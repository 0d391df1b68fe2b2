// Which joints of a model make its trees. Loops are still to come: a joint whose child hangs on an earlier joint already,
// or that would make a link its own ancestor, is left out; validate() says so and compile goes by the same rule.
#pragma once

#include <vector>

#include "world/world.h"

namespace roboss {

/// For each joint, in the order of the file, whether it is part of the trees. Joints to links that do not exist are not.
std::vector<bool> tree_joints(const ModelSpec& model);

}  // namespace roboss
