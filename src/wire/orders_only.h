// The period of Clients that only give orders.
#pragma once

#include "core/types.h"

namespace roboss {

/// A Client with this period observes nothing, and so holds up no window.
inline constexpr Tick kOrdersOnly = Tick{1} << 49;

}  // namespace roboss
