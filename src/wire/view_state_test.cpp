// View states are small, say the same of who stands still, and keep to their ranges.
#include "wire/view_state.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include <cstring>
#include <limits>

namespace roboss {
namespace {

World cars_and_a_slide() {
    World world;
    world.prototypes = {test::car(), test::prismatic_chain()};
    world.prototypes[1].joints[0].axes[0].lower = -0.5;
    world.prototypes[1].joints[0].axes[0].upper = 0.2;
    world.instances = {{"car", 0, {}, {}}, {"slide", 1, {{5, 0, 0}, {}}, {}}};
    return world;
}

std::int16_t coordinate(const std::vector<std::uint8_t>& entry, std::size_t i) {
    std::int16_t value = 0;
    std::memcpy(&value, entry.data() + 24 + 2 * i, sizeof(value));
    return value;
}

TEST(ViewState, OfACarTakesThirtyTwoBytes) {
    const auto model = test::compiled(cars_and_a_slide());
    EXPECT_EQ(ViewLayout(*model).bytes_of(RobotId(0u)), 32u);
}

TEST(ViewState, AnglesWrapAndSlidesEndAtTheirRange) {
    const auto model = test::compiled(cars_and_a_slide());
    const ViewLayout layout(*model);
    const std::vector<double> ranges = view_ranges(model->type_of(RobotId(1u)));
    EXPECT_NEAR(ranges[0], 0.525, 1e-12) << "of the larger limit, and a little";
    EXPECT_EQ(ranges[1], 100);
    RobotState car = initial_state(*model, RobotId(0u)), slide = initial_state(*model, RobotId(1u));
    car.q[7] = 2 * kPi + 0.5, car.q[8] = -kPi - 0.5;
    slide.q[7] = 0.2, slide.q[8] = 1e9;
    std::vector<std::uint8_t> entry;
    layout.append(*model, RobotId(0u), car, entry);
    EXPECT_NEAR(coordinate(entry, 0) * kPi / 32767, 0.5, 1e-4);
    EXPECT_NEAR(coordinate(entry, 1) * kPi / 32767, kPi - 0.5, 1e-4);
    entry.clear();
    layout.append(*model, RobotId(1u), slide, entry);
    EXPECT_NEAR(coordinate(entry, 0) * ranges[0] / 32767, 0.2, 1e-4);
    EXPECT_EQ(coordinate(entry, 1), 32767);
}

TEST(ViewState, OfARobotThatMovesLessThanTheRoundingStaysTheSame) {
    const auto model = test::compiled(cars_and_a_slide());
    const ViewLayout layout(*model);
    RobotState state = initial_state(*model, RobotId(0u));
    std::vector<std::uint8_t> before, after, moved;
    layout.append(*model, RobotId(0u), state, before);
    state.q[0] += 1e-6;
    layout.append(*model, RobotId(0u), state, after);
    state.q[0] += 1e-4;
    layout.append(*model, RobotId(0u), state, moved);
    EXPECT_EQ(before, after);
    EXPECT_NE(before, moved);
}

TEST(ViewState, NumbersThatAreNotFiniteHarmNothing) {
    const auto model = test::compiled(cars_and_a_slide());
    const ViewLayout layout(*model);
    RobotState state = initial_state(*model, RobotId(0u));
    for (double& q : state.q) q = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::uint8_t> entry;
    layout.append(*model, RobotId(0u), state, entry);
    EXPECT_EQ(entry.size(), 32u);
}

TEST(ViewState, EntriesAreFoundOnlyWhereTheyAreWhole) {
    const auto model = test::compiled(cars_and_a_slide());
    const ViewLayout layout(*model);
    std::vector<std::uint8_t> entry;
    layout.append(*model, RobotId(1u), initial_state(*model, RobotId(1u)), entry);
    EXPECT_EQ(layout.entry_at(entry, 0), RobotId(1u));
    EXPECT_FALSE(layout.entry_at(entry, entry.size()));
    EXPECT_FALSE(layout.entry_at(std::span(entry).first(entry.size() - 1), 0));
    entry[0] = 2;
    EXPECT_FALSE(layout.entry_at(entry, 0)) << "there is no robot 2";
}

}  // namespace
}  // namespace roboss
