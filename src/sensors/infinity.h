// What a ray reads that meets nothing.
#pragma once

#include <limits>

namespace roboss {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();  // m

}  // namespace roboss
