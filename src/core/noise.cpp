// Box-Muller takes two uniform numbers and gives two Gaussian ones; index 2k and 2k + 1 share the pair, one
// takes the cosine, the other the sine, so that each index can be asked for alone.
#include "core/noise.h"

#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

std::uint64_t absorb(std::uint64_t h, std::uint64_t word) {
    return mix((h ^ word) + 0x9E3779B97F4A7C15ull);
}

}  // namespace

std::uint64_t random_bits(const NoiseStream& stream, std::uint64_t index) {
    std::uint64_t h = mix(stream.seed + 0x9E3779B97F4A7C15ull);
    h = absorb(h, (static_cast<std::uint64_t>(stream.robot) << 32) | stream.sensor);
    h = absorb(h, static_cast<std::uint64_t>(stream.tick));
    return absorb(h, index);
}

double random_uniform(const NoiseStream& stream, std::uint64_t index) {
    const std::uint64_t top52 = random_bits(stream, index) >> 12;
    return (static_cast<double>(top52) + 0.5) * 0x1p-52;
}

double random_gaussian(const NoiseStream& stream, std::uint64_t index) {
    const std::uint64_t pair = index & ~std::uint64_t{1};
    const double radius = std::sqrt(-2.0 * fixed_log(random_uniform(stream, pair)));
    const SinCos direction = fixed_sincos(2.0 * kPi * random_uniform(stream, pair + 1));
    return radius * (index == pair ? direction.cos : direction.sin);
}

}  // namespace roboss
