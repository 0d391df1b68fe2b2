// Random numbers for scenes of the sensors' tests.
#pragma once

#include <cstdint>

#include "core/noise.h"
#include "math/vec3.h"

namespace roboss::sensors_test {

/// Random numbers of one test scene, drawn in order.
class Draws {
  public:
    explicit Draws(std::uint64_t seed) : stream_{seed, 0, 0, 0} {}
    double between(double low, double high) { return low + (high - low) * random_uniform(stream_, index_++); }
    Vec3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_cube(1);
            if (norm(v) > 0.1 && norm(v) < 1) return normalized(v);
        }
    }

  private:
    NoiseStream stream_;
    std::uint64_t index_ = 0;
};

}  // namespace roboss::sensors_test
