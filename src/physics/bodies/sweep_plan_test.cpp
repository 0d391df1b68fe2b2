// When sweeps end, and when what they found is the solution.
#include "physics/bodies/sweep_plan.h"

#include <gtest/gtest.h>

#include <limits>

namespace roboss {
namespace {

constexpr SweepPlan kPlan{
    .most = 3, .start_tolerance = 1e-8, .most_to_settle = 100, .settle_tolerance = 1e-7};

TEST(SweepProgress, SettlesAtAShareOfTheMotion) {
    SweepProgress progress(kPlan);
    progress.begin(1, 2);
    EXPECT_FALSE(progress.ends(3e-7));
    EXPECT_TRUE(progress.ends(1.9e-7));
    EXPECT_TRUE(progress.report().settled);
    EXPECT_EQ(progress.report().sweeps, 2);
}

TEST(SweepProgress, NothingSettlesAtRest) {
    SweepProgress progress(kPlan);
    progress.begin(1, 1e-3);
    EXPECT_FALSE(progress.ends(1e-7));
    EXPECT_FALSE(progress.ends(2e-8));
    EXPECT_TRUE(progress.ends(1.1e-8)) << "the last of three";
    EXPECT_FALSE(progress.report().settled);
    SweepProgress converges(kPlan);
    converges.begin(1, 1e-3);
    EXPECT_TRUE(converges.ends(1e-9));
    EXPECT_FALSE(converges.report().settled);
}

TEST(SweepProgress, SomethingFastDoesNotLoosenWhatRestsBesideIt) {
    SweepProgress progress(kPlan);
    progress.begin(1, 1e6);
    EXPECT_FALSE(progress.ends(1e-5));
    EXPECT_TRUE(progress.ends(0.9e-6));
    EXPECT_TRUE(progress.report().settled);
}

TEST(SweepProgress, AtRestALargePartSettlesATighterTolerance) {
    const SweepPlan plan = pile_plan({}, 80, Fill::kMuch);
    ASSERT_TRUE(plan.rest_settles);
    SweepProgress progress(plan);
    progress.begin(1, 0);
    EXPECT_FALSE(progress.ends(1e-9));
    EXPECT_TRUE(progress.ends(0.9e-12));
    EXPECT_TRUE(progress.report().settled);
    SweepProgress fails(plan);
    fails.begin(1, 0);
    for (int i = 1; i < plan.most; ++i) EXPECT_FALSE(fails.ends(1e-9));
    EXPECT_TRUE(fails.ends(1e-9));
    EXPECT_FALSE(fails.report().settled);
    EXPECT_FALSE(pile_plan({}, 80, Fill::kLittle).rest_settles);
}

TEST(SweepProgress, ATightenedPlanGoesOn) {
    SweepPlan plan = kPlan;
    plan.tighten(1e-2);
    SweepProgress progress(plan);
    progress.begin(1, 2);
    EXPECT_FALSE(progress.ends(3e-9));
    EXPECT_TRUE(progress.ends(1.9e-9));
    EXPECT_TRUE(progress.report().settled);
}

TEST(SweepProgress, WhatIsNoNumberEndsThem) {
    SweepProgress progress(kPlan);
    progress.begin(1, 2);
    EXPECT_TRUE(progress.ends(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(progress.report().settled);
}

TEST(SweepProgress, WithoutProgressTheAccelerationStops) {
    SweepProgress progress(kPlan);
    progress.begin(1, 2);
    int plain = 0;
    for (int i = 0; i < 48; ++i) {
        EXPECT_FALSE(progress.ends(i == 0 ? 1 : 0.9));
        plain += progress.share() == 0 ? 1 : 0;
    }
    EXPECT_GE(plain, 16);
    EXPECT_LT(plain, 32);
}

}  // namespace
}  // namespace roboss
