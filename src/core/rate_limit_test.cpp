// Rates that are kept over time and at once.
#include "core/rate_limit.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(RateLimit, LetsTheRateThroughAndNoMore) {
    RateLimit limit(200);
    int taken = 0;
    for (std::int64_t ms = 1000; ms < 11'000; ++ms)
        for (int i = 0; i < 3; ++i) taken += limit.take(ms) ? 1 : 0;
    EXPECT_NEAR(taken, 200 * 11, 10);
}

TEST(RateLimit, LetsMoreThroughForAMoment) {
    RateLimit limit(2, 50);
    int taken = 0;
    for (int i = 0; i < 100; ++i) taken += limit.take(1000) ? 1 : 0;
    EXPECT_EQ(taken, 50);
    for (int i = 0; i < 100; ++i) taken += limit.take(6000) ? 1 : 0;
    EXPECT_EQ(taken, 60);
}

}  // namespace
}  // namespace roboss
