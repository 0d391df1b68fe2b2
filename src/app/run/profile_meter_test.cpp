// A second of measurements at a time, only while somebody asks.
#include "app/run/profile_meter.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

StepProfile a_window(std::uint64_t ns, std::uint64_t robots) {
    StepProfile profile;
    profile.stages.ns[static_cast<std::size_t>(Stage::kVelocities)] = ns;
    profile.solver.add_island(robots, robots, 3);
    return profile;
}

TEST(ProfileMeter, MeasuresOnlyWhileSomebodyAsks) {
    ProfileMeter meter;
    EXPECT_FALSE(meter.wanted(0));
    EXPECT_EQ(meter.asked(100, 50, 1e-3).ticks, 0) << "nothing was measured yet";
    EXPECT_TRUE(meter.wanted(3'000));
    EXPECT_FALSE(meter.wanted(3'200));
    meter.add(a_window(1'000, 9));
    EXPECT_EQ(meter.asked(60'000, 9'000, 1e-3).ticks, 0) << "an old measurement is not shown";
}

TEST(ProfileMeter, ShowsTheLastSecondThatIsComplete) {
    ProfileMeter meter;
    (void)meter.asked(0, 50, 1e-3);
    meter.add(a_window(2'000'000, 9));
    EXPECT_EQ(meter.asked(500, 100, 1e-3).ticks, 0);
    meter.add(a_window(1'000'000, 4));
    const RunProfile first = meter.asked(1'000, 150, 1e-3);
    EXPECT_EQ(first.ticks, 100);
    ASSERT_EQ(first.stages.size(), kStages);
    const StageTime& velocities = first.stages[static_cast<std::size_t>(Stage::kVelocities)];
    EXPECT_EQ(velocities.name, stage_name(Stage::kVelocities));
    EXPECT_DOUBLE_EQ(velocities.seconds, 3e-3);
    EXPECT_EQ(first.largest_island, 9u);
    EXPECT_EQ(first.iterations, 6u);
    EXPECT_EQ(first.friction_tolerance, 1e-3);
    meter.add(a_window(5'000, 2));
    EXPECT_EQ(meter.asked(2'000, 160, 1e-3).largest_island, 2u) << "maxima of the last second alone";
}

TEST(ProfileMeter, KeepsWhatWasLastWhileTheRunIsPausedAndBeginsAnewAfterARewind) {
    ProfileMeter meter;
    (void)meter.asked(0, 50, 1e-3);
    meter.add(a_window(1'000, 9));
    EXPECT_EQ(meter.asked(1'000, 150, 1e-3).ticks, 100);
    EXPECT_EQ(meter.asked(2'000, 150, 1e-3).ticks, 100) << "paused";
    (void)meter.asked(3'000, 20, 1e-3);  // rewound to tick 20
    EXPECT_EQ(meter.asked(4'000, 30, 1e-3).ticks, 10);
}

}  // namespace
}  // namespace roboss
