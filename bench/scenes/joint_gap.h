// How far joints come apart, measured from the poses that an engine reports: in engines with a body for each
// link everywhere, in engines of joint coordinates where joints close loops.
#pragma once

#include "engines/engine.h"

namespace roboss::bench {

/// m, the most of all joints of the world whose origin is fixed to both links (hinges and ball joints).
double widest_joint_gap(const World& world, const Engine& engine);

}  // namespace roboss::bench
