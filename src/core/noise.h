// Counter-based random numbers: every number is a pure function of who asks (seed, robot, sensor, tick) and
// of its index, so there is no generator to save, to share or to advance in a fixed order (the idea of Salmon
// et al., "Parallel random numbers: as easy as 1, 2, 3", 2011). Mixing: chained finalisers of splitmix64
// (Steele, Lea, Flood 2014).
#pragma once

#include <cstdint>

#include "core/types.h"

namespace roboss {

/// Who asks. Two streams that differ in any member are independent.
struct NoiseStream {
    std::uint64_t seed = 0;    // of the run
    std::uint32_t robot = 0;   // RobotId, or any number of the caller's
    std::uint32_t sensor = 0;  // index of the sensor, or any number of the caller's
    Tick tick = 0;             // kOncePerRun for numbers that stay the same through the run
};

/// A tick that no reading has: for biases drawn once.
inline constexpr Tick kOncePerRun = INT64_MIN;

/// 64 random bits.
std::uint64_t random_bits(const NoiseStream& stream, std::uint64_t index);

/// Uniform in the open interval (0, 1).
double random_uniform(const NoiseStream& stream, std::uint64_t index);

/// Gaussian of mean 0 and standard deviation 1 (Box and Muller, 1958; at most 8.6 in absolute value).
double random_gaussian(const NoiseStream& stream, std::uint64_t index);

}  // namespace roboss
