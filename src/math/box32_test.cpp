// A single-precision box never loses what it holds.
#include "math/box32.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss {
namespace {

TEST(Box32, ContainsItsDoubleOriginal) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> number(-1e4, 1e4);
    for (int i = 0; i < 100'000; ++i) {
        const double x = number(random) * std::pow(10.0, static_cast<double>(i % 40 - 20));
        EXPECT_LE(static_cast<double>(round_down(x)), x);
        EXPECT_GE(static_cast<double>(round_up(x)), x);
    }
    EXPECT_EQ(round_down(0.5), 0.5f);
    EXPECT_EQ(round_up(1e300), std::numeric_limits<float>::infinity());
    EXPECT_LT(round_down(1e300), std::numeric_limits<float>::infinity());
}

TEST(Box32, TurnsNotANumberIntoEverywhere) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Box32 box = outward(Aabb{{nan, 0, 0}, {nan, 1, 1}});
    EXPECT_TRUE(overlaps(box, outward(Aabb{{1e9, 0, 0}, {2e9, 1, 1}})));
}

TEST(Box32, KeepsAnEmptyBoxEmpty) {
    const Box32 box = outward(Aabb{});
    EXPECT_FALSE(overlaps(box, outward(Aabb{{-1, -1, -1}, {1, 1, 1}})));
}

}  // namespace
}  // namespace roboss
