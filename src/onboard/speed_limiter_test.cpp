// Limits of a commanded speed: kept at every tick, in the shortest time, without overshoot.
#include "onboard/speed_limiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <support/random.h>

namespace roboss::test {
namespace {

constexpr double kDt = 1e-3;  // s

struct Limiter {
    SpeedLimits limits;
    double last = 0, before = 0;
    double step(double wanted) { return limit_speed(limits, wanted, kDt, last, before); }
};

TEST(SpeedLimiter, WithoutLimitsTheCommandPassesUnchanged) {
    Limiter limiter;
    for (const double v : {0.1, -7.3, 1e9, 0.0}) EXPECT_EQ(limiter.step(v), v);
}

TEST(SpeedLimiter, AnAccelerationGivesARampAndEndsExactlyAtTheTarget) {
    Limiter limiter;
    limiter.limits.max_acceleration = 2, limiter.limits.min_acceleration = -4;
    for (int i = 1; i <= 510; ++i) EXPECT_NEAR(limiter.step(1), std::min(2e-3 * i, 1.0), 1e-12);
    EXPECT_EQ(limiter.step(1), 1);
    for (int i = 1; i <= 200; ++i) limiter.step(0);
    EXPECT_NEAR(limiter.last, 1 - 4 * 0.2, 1e-12);
}

TEST(SpeedLimiter, OnlyAMaximumLeavesTheOtherSideFree) {
    Limiter limiter;
    limiter.limits.max_velocity = 0.5;
    EXPECT_EQ(limiter.step(3), 0.5);
    EXPECT_EQ(limiter.step(-3), -3);
}

/// With jerk j and acceleration a, a speed v > a^2 / j is reached after v / a + a / j.
TEST(SpeedLimiter, WithJerkTheTargetIsReachedInTheShortestTimeWithoutOvershoot) {
    const double v = 1.0, a = 2.0, j = 10.0;
    Limiter limiter;
    limiter.limits = {-5, 5, -a, a, -j, j};
    int ticks = 0;
    while (limiter.last != v && ticks < 10000) {
        const double next = limiter.step(v);
        ASSERT_LE(next, v + 1e-12);
        ++ticks;
    }
    EXPECT_NEAR(ticks * kDt, v / a + a / j, 3 * kDt);
    EXPECT_EQ(limiter.step(v), v);
    EXPECT_EQ(limiter.step(v), v) << "it stays there";
}

TEST(SpeedLimiter, AllLimitsHoldAtEveryTickForAnyCommands) {
    const SpeedLimits limits{-0.8, 1.2, -3, 2, -40, 25};
    Random random(11);
    for (int run = 0; run < 200; ++run) {
        Limiter limiter{limits, 0, 0};
        double wanted = 0, acceleration = 0, last = 0;
        for (int i = 0; i < 3000; ++i) {
            if (random.uniform(0, 1) < 0.01) wanted = random.uniform(-2, 2);
            const double v = limiter.step(wanted), a = (v - last) / kDt, jerk = (a - acceleration) / kDt;
            ASSERT_GE(v, limits.min_velocity);
            ASSERT_LE(v, limits.max_velocity);
            ASSERT_GE(a, limits.min_acceleration - 1e-9);
            ASSERT_LE(a, limits.max_acceleration + 1e-9);
            ASSERT_GE(jerk, limits.min_jerk - 1e-6) << "run " << run << ", tick " << i;
            ASSERT_LE(jerk, limits.max_jerk + 1e-6) << "run " << run << ", tick " << i;
            acceleration = a, last = v;
        }
    }
}

TEST(SpeedLimiter, AJerkOfZeroNeverStarts) {
    Limiter limiter;
    limiter.limits.min_jerk = limiter.limits.max_jerk = 0;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(limiter.step(1), 0);
}

}  // namespace
}  // namespace roboss::test
