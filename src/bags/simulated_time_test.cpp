// Log times become simulated times.
#include "bags/simulated_time.h"

#include <gtest/gtest.h>

namespace roboss::bags {
namespace {

SimulatedTime made(std::vector<ClockReading> clock, std::int64_t earliest_ns = 0) {
    return std::move(SimulatedTime::make(std::move(clock), earliest_ns)).value();
}

TEST(SimulatedTime, BeginsWithTheBagWhereThereIsNoClock) {
    EXPECT_EQ(made({}, 1'000).at(1'000), 0);
    EXPECT_EQ(made({}, 1'000).at(1'250), 250);
}

TEST(SimulatedTime, IsThatOfTheClock) {
    const SimulatedTime time = made({{1'000, 50}, {1'100, 70}, {1'300, 470}, {1'400, 470}}, 900);
    EXPECT_EQ(time.at(1'000), 50);
    EXPECT_EQ(time.at(1'050), 60) << "slower than real time";
    EXPECT_EQ(time.at(1'200), 270) << "faster";
    EXPECT_EQ(time.at(1'350), 470) << "paused";
    EXPECT_EQ(time.at(950), 0) << "before the first";
    EXPECT_EQ(time.at(900), -50);
    EXPECT_EQ(time.at(1'410), 480) << "behind the last";
}

TEST(SimulatedTime, IsExactWhereLogTimesAreSimulated) {
    std::vector<ClockReading> clock;
    for (std::int64_t ns = 0; ns <= 3'000'000'000'000; ns += 2'999'999'999) clock.push_back({ns, ns});
    const SimulatedTime time = made(std::move(clock));
    for (std::int64_t ns = 0; ns < 3'000'000'000'000; ns += 7'654'321'987) EXPECT_EQ(time.at(ns), ns);
}

TEST(SimulatedTime, TakesReadingsInAnyOrderAndTwoAtOneTime) {
    const SimulatedTime time = made({{200, 20}, {100, 10}, {200, 30}, {300, 40}});
    EXPECT_EQ(time.at(150), 15);
    EXPECT_EQ(time.at(200), 30);
    EXPECT_EQ(time.at(250), 35);
}

TEST(SimulatedTime, AClockThatGoesBackIsAnError) {
    const Result<SimulatedTime> time = SimulatedTime::make({{100, 10}, {200, 5}}, 0);
    ASSERT_FALSE(time.ok());
    EXPECT_EQ(time.error().code, "clock-back");
}

TEST(SimulatedTime, HoldsForTheGreatestTimes) {
    constexpr std::int64_t kMost_ns = 4'000'000'000'000'000'000;
    EXPECT_EQ(made({}, 0).at(kMost_ns), kMost_ns);
    EXPECT_GT(made({{0, 2'147'483'647'000'000'000}}).at(kMost_ns), kMost_ns);
    const SimulatedTime time = made({{0, -2'147'483'648'000'000'000}, {1, 2'147'483'647'000'000'000}});
    EXPECT_LT(time.at(0), 0);
}

}  // namespace
}  // namespace roboss::bags
