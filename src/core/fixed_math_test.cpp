// The fixed functions against libm (long double), over the ranges that the simulator uses.
#include "core/fixed_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace roboss {
namespace {

double ulps(double ours, long double exact) {
    const auto rounded = static_cast<double>(exact);
    const double ulp = std::nextafter(std::fabs(rounded), 1e300) - std::fabs(rounded);
    return static_cast<double>(std::fabs(static_cast<long double>(ours) - exact)) / std::max(ulp, 1e-320);
}

TEST(FixedMath, SinCosWithinTwoUlps) {
    double worst = 0;
    for (int i = -200000; i <= 200000; ++i) {
        const double x = i * 0.0001234567 * (i % 7 == 0 ? 1000 : 1);
        const long double s = std::sin(static_cast<long double>(x));
        const long double c = std::cos(static_cast<long double>(x));
        const SinCos ours = fixed_sincos(x);
        // Near a zero of the function the reduction's rest counts; compare absolutely there.
        worst = std::max(worst,
                         std::min(ulps(ours.sin, s), static_cast<double>(std::fabs(ours.sin - s)) / 1e-16));
        worst = std::max(worst,
                         std::min(ulps(ours.cos, c), static_cast<double>(std::fabs(ours.cos - c)) / 1e-16));
    }
    EXPECT_LT(worst, 2.0);
}

TEST(FixedMath, Atan2WithinTwoUlpsInAllQuadrants) {
    double worst = 0;
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 400; ++j) {
            const double y = (i - 200) * 0.0173;
            const double x = (j - 200) * 0.0311;
            if (x == 0 && y == 0) continue;
            worst = std::max(worst, ulps(fixed_atan2(y, x), std::atan2(static_cast<long double>(y),
                                                                       static_cast<long double>(x))));
        }
    }
    EXPECT_LT(worst, 2.5);
    EXPECT_EQ(fixed_atan2(0.0, 0.0), 0.0);
}

TEST(FixedMath, LogWithinTwoUlps) {
    double worst = 0;
    for (int i = 1; i < 100000; ++i) {
        const double x = i * 0.00037;
        const long double exact = std::log(static_cast<long double>(x));
        worst = std::max(worst, std::min(ulps(fixed_log(x), exact),
                                         static_cast<double>(std::fabs(fixed_log(x) - exact)) / 1e-16));
    }
    EXPECT_LT(worst, 2.0);
}

TEST(FixedMath, AsinAcosClampAndInvert) {
    for (int i = -100; i <= 100; ++i) {
        const double x = i / 100.0;
        EXPECT_NEAR(fixed_sin(fixed_asin(x)), x, 1e-15);
        EXPECT_NEAR(fixed_cos(fixed_acos(x)), x, 1e-15);
    }
    EXPECT_DOUBLE_EQ(fixed_asin(1.5), kPi / 2);
    EXPECT_DOUBLE_EQ(fixed_acos(-1.5), kPi);
}

/// Their quadrant is no integer that a processor has, and processors disagree about what a conversion gives.
TEST(FixedMath, AnglesBeyondAllIntegersHaveTheFirstQuadrant) {
    for (const double n :
         {0x1p62, 0x1p63, 0x1p70, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
        EXPECT_EQ(fixed::mod_4(n), 0.0) << n;
        EXPECT_EQ(fixed::mod_4(-n), 0.0) << -n;
    }
    EXPECT_EQ(fixed::mod_4(0x1p53 + 6), 2.0);
    EXPECT_EQ(fixed::mod_4(-1.0), 3.0);
}

TEST(FixedMath, OfEqualZerosTheFirstIsTheLargestAndTheSmallest) {
    volatile double zero = 0.0, nan = std::nan("");
    for (const double first : {zero, -zero})
        for (const double second : {zero, -zero}) {
            EXPECT_EQ(std::signbit(fixed_max(first, second)), std::signbit(first));
            EXPECT_EQ(std::signbit(fixed_min(first, second)), std::signbit(first));
        }
    EXPECT_EQ(fixed_max(-2, 3), 3);
    EXPECT_EQ(fixed_min(-2, 3), -2);
    for (const double x : {-1.5, zero, 2.0}) {
        EXPECT_EQ(fixed_max(nan, x), x);
        EXPECT_EQ(fixed_max(x, nan), x);
        EXPECT_EQ(fixed_min(nan, x), x);
        EXPECT_EQ(fixed_min(x, nan), x);
    }
    EXPECT_TRUE(std::isnan(fixed_max(nan, nan)));
}

TEST(FixedMath, WrapAngleStaysInHalfOpenRange) {
    for (int i = -1000; i < 1000; ++i) {
        const double w = wrap_angle(i * 0.37);
        EXPECT_GT(w, -kPi);
        EXPECT_LE(w, kPi + 1e-15);
        EXPECT_NEAR(std::sin(w), std::sin(i * 0.37), 1e-12);
    }
}

TEST(FixedMath, ExponentialIsNearlyThatOfTheLibrary) {
    for (double x = -690; x < 690; x += 0.0371) {
        const double expected = std::exp(x);
        ASSERT_NEAR(fixed_exp(x) / expected, 1, 4e-16) << x;
    }
    EXPECT_EQ(fixed_exp(0), 1);
    EXPECT_TRUE(std::isfinite(fixed_exp(1e9)));
    EXPECT_GE(fixed_exp(-1e9), 0);
}

}  // namespace
}  // namespace roboss
