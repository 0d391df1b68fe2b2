// A clock that never goes back: for profiles, never for results.
#pragma once

#include <cstdint>

namespace roboss {

/// Time since some moment in the past, ns.
std::uint64_t monotonic_ns();

}  // namespace roboss
