// A step computes with gradual underflow and round-to-nearest whatever a plugin left behind, and gives the
// caller's settings back.
#include "core/float_env.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include <support/float_control.h>

namespace roboss {
namespace {

// Through volatile, so that the compiler computes nothing beforehand.
double quotient(double a, double b) {
    volatile double x = a, y = b;
    return x / y;
}

TEST(ExactFloatScope, RoundsToNearestInsideAndRestoresOutside) {
    ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
    const double upward = quotient(1, 3);
    double inside = 0;
    {
        const ExactFloatScope scope;
        inside = quotient(1, 3);
    }
    const double after = quotient(1, 3);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(inside, 1.0 / 3.0);
    EXPECT_GT(upward, inside);
    EXPECT_EQ(after, upward);
}

TEST(ExactFloatScope, KeepsTinyNumbersThatAPluginSetToBeFlushed) {
    const std::uint64_t before = test::float_control();
    test::set_float_control(before | test::kFlushTinyNumbers);
    const double smallest_normal = std::numeric_limits<double>::min();
    const double flushed = quotient(smallest_normal, 4);
    double kept = 0;
    {
        const ExactFloatScope scope;
        kept = quotient(smallest_normal, 4);
    }
    const std::uint64_t restored = test::float_control();
    test::set_float_control(before);
    EXPECT_EQ(flushed, 0.0);
    EXPECT_GT(kept, 0.0);
    EXPECT_EQ(restored & test::kFlushTinyNumbers, test::kFlushTinyNumbers);
}

}  // namespace
}  // namespace roboss
