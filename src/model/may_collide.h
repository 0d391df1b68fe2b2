// Which materials meet at all.
#pragma once

#include "model/model.h"

namespace roboss {

/// True if the bitmasks let shapes of these materials collide.
bool may_collide(const Material& a, const Material& b);

}  // namespace roboss
