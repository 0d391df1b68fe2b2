// What becomes of a window's robots when one of them fails.
#include "roles/simulator/window_stepper.h"

#include <gtest/gtest.h>

#include <support/bodies.h>
#include <support/robots.h>
#include <support/simulation.h>
#include <atomic>

namespace roboss::test {
namespace {

/// Balls far from each other: islands of one robot, stepped together.
World lone_balls(int count) {
    World world = empty_world(2e-3);
    for (int i = 0; i < count; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{10.0 * i, 0, 1}, {}});
    return world;
}

Assignment assignment_for(const Simulation& sim, Tick until) {
    Assignment assignment;
    assignment.until = until;
    assignment.island_offsets = {0};
    for (const RobotId robot : sim.ids) {
        assignment.robots.push_back(robot);
        assignment.island_offsets.push_back(static_cast<std::uint32_t>(assignment.robots.size()));
    }
    return assignment;
}

TEST(WindowStepper, StepsTheOthersToTheEndWhenOneFails) {
    Simulation sim(lone_balls(6));
    StateStore store(*sim.model);
    for (const RobotId robot : sim.ids) {
        RobotState state = sim.states[robot.index()];
        if (robot == RobotId(2u)) state.v[5] = 1e308;
        store.put(robot, 0, std::move(state));
    }
    ThreadPool pool(1);
    WindowStepper stepper(sim.model, pool, {nullptr, nullptr, 1});
    const WindowResult result = *stepper.step(
        assignment_for(sim, 8), store, [](const StepProgress&) { return WindowStepper::Next::kContinue; });
    for (int i = 0; i < 8; ++i) sim.step();
    ASSERT_EQ(result.islands.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(result.islands[i].failed.valid(), i == 2) << i;
        if (i == 2) continue;
        EXPECT_EQ(result.robots[i].hash, state_hash(RobotId(i), 8, sim.states[i])) << i;
        EXPECT_EQ(result.robots[i].robot, RobotId(i));
    }
}

/// Two Simulators' stores: the first is cut short at `cut`, keeps the first `kept` of the balls for the rest,
/// and gives the others to the second. Together they report what one does that steps all to the end.
TEST(WindowStepper, WhatACutLeavesIsSteppedOnBySomebodyElseToTheSameStates) {
    constexpr Tick kCut = 5, kUntil = 12;
    constexpr std::size_t kBalls = 6, kKept = 4;
    Simulation sim(lone_balls(kBalls));
    ThreadPool pool(1);
    const auto goes_on = [](const StepProgress&) { return WindowStepper::Next::kContinue; };
    const auto started = [&](StateStore& store) {
        for (const RobotId robot : sim.ids) store.put(robot, 0, RobotState(sim.states[robot.index()]));
    };
    StateStore whole_store(*sim.model), store(*sim.model), other_store(*sim.model);
    started(whole_store), started(store);
    WindowStepper whole(sim.model, pool, {}), stepper(sim.model, pool, {{}, {}, kMostLanes, 1}),
        other(sim.model, pool, {});
    Assignment assignment = assignment_for(sim, kUntil);
    const WindowResult expected = *whole.step(assignment, whole_store, goes_on);

    assignment.due_ns = 1;
    const WindowResult cut = *stepper.step(assignment, store, [&](const StepProgress& progress) {
        return progress.done * kUntil < kCut ? WindowStepper::Next::kContinue : WindowStepper::Next::kStop;
    });
    EXPECT_EQ(cut.left, static_cast<std::uint64_t>(kUntil - kCut));
    EXPECT_TRUE(cut.robots.empty());
    ASSERT_EQ(cut.islands.size(), kBalls);

    const auto rest_of = [&](std::size_t first, std::size_t last) {
        Assignment rest = assignment_for(sim, kUntil);
        rest.from = kCut;
        rest.robots.assign(sim.ids.begin() + static_cast<std::ptrdiff_t>(first),
                           sim.ids.begin() + static_cast<std::ptrdiff_t>(last));
        rest.island_offsets.resize(last - first + 1);
        return rest;
    };
    for (std::size_t i = kKept; i < kBalls; ++i)
        other_store.put(sim.ids[i], kCut, RobotState(*store.find(sim.ids[i], kCut)));
    for (std::size_t i = 0; i < kKept; ++i) ASSERT_TRUE(store.start(sim.ids[i], kCut));
    const WindowResult kept = *stepper.step(rest_of(0, kKept), store, goes_on),
                       given = *other.step(rest_of(kKept, kBalls), other_store, goes_on);

    ASSERT_EQ(kept.earlier.size(), kBalls - kKept);
    for (std::size_t i = 0; i < kBalls; ++i) {
        const RobotResult& got = i < kKept ? kept.robots[i] : given.robots[i - kKept];
        const IslandResult& rest = i < kKept ? kept.islands[i] : given.islands[i - kKept];
        EXPECT_EQ(got.hash, expected.robots[i].hash) << i;
        EXPECT_EQ(cut.islands[i].cost_ns + rest.cost_ns, expected.islands[i].cost_ns) << i;
        if (i < kKept) {
            EXPECT_EQ(got.swept, expected.robots[i].swept) << i;
            continue;
        }
        EXPECT_EQ(kept.earlier[i - kKept].robot, sim.ids[i]);
        Box32 both = got.swept;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            both.min[axis] = std::min(both.min[axis], kept.earlier[i - kKept].swept.min[axis]);
            both.max[axis] = std::max(both.max[axis], kept.earlier[i - kKept].swept.max[axis]);
        }
        EXPECT_EQ(both, expected.robots[i].swept) << i;
    }
}

/// Boxes on each other beside balls far from each other: islands of several robots, and of one.
World boxes_and_balls() {
    World world = lone_balls(6);
    for (int i = 0; i < 4; ++i)
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.5)), "box_" + std::to_string(i),
              {{0, 10, 0.3 * i}, {}});
    return world;
}

Assignment with_an_island_of_boxes(const Simulation& sim, Tick until) {
    Assignment assignment = assignment_for(sim, until);
    assignment.island_offsets = {0, 1, 2, 3, 4, 5, 6, 10};
    return assignment;
}

TEST(WindowStepper, WhatIsAbandonedBetweenTicksHasNoResultAndCanBeSteppedAgainToTheSameStates) {
    constexpr Tick kUntil = 40;
    const auto goes_on = [](const StepProgress&) { return WindowStepper::Next::kContinue; };
    Simulation sim(boxes_and_balls());
    const Assignment assignment = with_an_island_of_boxes(sim, kUntil);
    const auto started = [&](StateStore& store) {
        for (const RobotId robot : sim.ids) store.put(robot, 0, RobotState(sim.states[robot.index()]));
    };
    for (const unsigned threads : {1u, 3u}) {
        ThreadPool pool(threads);
        StateStore whole_store(*sim.model), store(*sim.model);
        started(whole_store), started(store);
        const WindowResult expected =
            *WindowStepper(sim.model, pool, {}).step(assignment, whole_store, goes_on);
        std::atomic<int> asked = 0;
        std::atomic<bool> ends = true;
        SteppingOptions options;
        options.abandons = [&] { return ends && ++asked > 7; };
        WindowStepper stepper(sim.model, pool, options);
        EXPECT_FALSE(stepper.step(assignment, store, goes_on).has_value()) << threads;
        EXPECT_GE(asked, 8);
        EXPECT_LE(asked, 8 + 2 * static_cast<int>(threads)) << "a thread went on";
        for (const RobotId robot : sim.ids) {
            EXPECT_FALSE(store.has(robot, kUntil));
            ASSERT_TRUE(store.has(robot, 0));
            EXPECT_EQ(state_hash(robot, 0, *store.find(robot, 0)),
                      state_hash(robot, 0, sim.states[robot.index()]));
        }
        ends = false;
        const std::optional<WindowResult> again = stepper.step(assignment, store, goes_on);
        ASSERT_TRUE(again.has_value());
        for (std::size_t i = 0; i < sim.ids.size(); ++i) {
            EXPECT_EQ(again->robots[i].hash, expected.robots[i].hash) << i;
            EXPECT_EQ(again->robots[i].swept, expected.robots[i].swept) << i;
        }
        EXPECT_EQ(again->earlier.size(), expected.earlier.size());
    }
}

}  // namespace
}  // namespace roboss::test
