// Random numbers for tests.
#pragma once

#include <cstdint>

#include "math/quat.h"

namespace roboss::test {

/// xorshift64*: the same numbers on every machine, so a failing seed can be told.
class Random {
  public:
    explicit Random(std::uint64_t seed) : s_(seed * 0x9E3779B97F4A7C15ull + 0x2545F4914F6CDD1Dull) {}
    double uniform(double low, double high) {
        s_ ^= s_ >> 12, s_ ^= s_ << 25, s_ ^= s_ >> 27;
        return low + (high - low) * static_cast<double>((s_ * 0x2545F4914F6CDD1Dull) >> 11) * 0x1p-53;
    }
    int integer(int low, int high) { return low + static_cast<int>(uniform(0, high - low + 1)); }
    Vec3 vector(double size) {
        const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
        return {x, y, z};
    }
    Quat rotation() {
        for (;;) {
            const Vec3 v = vector(1);
            const Quat q{uniform(-1, 1), v.x, v.y, v.z};
            const double n = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
            if (n > 0.01 && n <= 1) return normalized(q);
        }
    }

  private:
    std::uint64_t s_;
};

}  // namespace roboss::test
