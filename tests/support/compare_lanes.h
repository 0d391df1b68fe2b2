// Runs worlds with and without lanes, and compares the bits.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include <support/scenes.h>
#include <support/simulation.h>

#include "physics/lanes/lane_stepper.h"

namespace roboss::test {

inline constexpr std::size_t kWidths[] = {2, 4, 8};
inline constexpr std::size_t kFloatWidths[] = {4, 8, 16};

/// Skips what this processor cannot do; the rest of the test then compares scalar with scalar.
inline bool has_lanes(Precision precision, std::size_t width) {
    const auto stepper = make_lane_stepper(precision, width);
    return stepper != nullptr && stepper->width() == width;
}

inline void expect_same_states(const Simulation& a, const Simulation& b, const std::string& where) {
    for (std::size_t r = 0; r < a.states.size(); ++r) {
        std::vector<std::uint8_t> x, y;
        encode(a.states[r], x);
        encode(b.states[r], y);
        ASSERT_EQ(x, y) << where << ", robot " << r << ", tick " << a.tick;
    }
}

using Drive = std::function<void(Simulation&)>;

/// Runs the world with and without lanes, and compares every tick.
inline void compare(const World& world, const Drive& drive, int ticks, std::size_t width) {
    Simulation alone(world), in_lanes(world);
    alone.scratch.use_lanes(1);
    in_lanes.scratch.use_lanes(width);
    ASSERT_EQ(alone.scratch.lanes(world.precision), 1u);
    ASSERT_EQ(in_lanes.scratch.lanes(world.precision), width);
    for (int i = 0; i < ticks; ++i) {
        drive(alone), drive(in_lanes);
        const StepReport a = alone.step(), b = in_lanes.step();
        expect_same_states(alone, in_lanes, std::to_string(width) + " lanes");
        ASSERT_EQ(alone.bounds, in_lanes.bounds);
        ASSERT_EQ(a.contacts, b.contacts);
        ASSERT_EQ(a.static_contacts, b.static_contacts);
        ASSERT_EQ(a.iterations, b.iterations);
        ASSERT_EQ(a.residual, b.residual);
        if (::testing::Test::HasFatalFailure()) return;
    }
}

/// In doubles and in floats, in all lanes that there are.
inline void compare(World world, const Drive& drive, int ticks) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
        world.precision = precision;
        for (const std::size_t width : precision == Precision::kFloat ? kFloatWidths : kWidths)
            if (has_lanes(precision, width)) compare(world, drive, ticks, width);
    }
}

/// `count` robots of a model, far from each other, each in a slightly different pose.
inline World scattered(const ModelSpec& model, int count, double height, double dt_s = 2e-3) {
    World world = empty_world(dt_s);
    place(world, ground(surface(0.9)), "ground");
    const std::size_t prototype = world.prototypes.size();
    world.prototypes.push_back(model);
    for (int i = 0; i < count; ++i)
        world.instances.push_back({"robot_" + std::to_string(i),
                                   prototype,
                                   {{5.0 * i, 0.3 * i, height + 1e-3 * i}, from_rpy(0, 0, 0.4 * i)},
                                   {}});
    return world;
}

/// Steps all robots in lanes, and only there, for some ticks; the number of robot steps that were taken.
inline int step_only_in_lanes(Simulation& sim, Precision precision, std::size_t width, int ticks,
                              StepReport& report) {
    const auto stepper = make_lane_stepper(precision, width);
    std::vector<LaneRobot> robots;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        robots.push_back({sim.ids[r], &sim.states[r], &sim.bounds[r], false, {}});
    StageClock clock;
    int stepped = 0;
    for (int i = 0; i < ticks; ++i)
        stepped += std::popcount(stepper->step(*sim.model, robots, report, clock));
    return stepped;
}

}  // namespace roboss::test
