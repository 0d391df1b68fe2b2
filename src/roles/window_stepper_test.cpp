// What becomes of a window's robots when one of them fails.
#include "roles/window_stepper.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

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

Plan plan_for(const Simulation& sim, Tick until) {
    Plan plan;
    plan.until = until;
    plan.island_offsets = {0};
    for (const RobotId robot : sim.ids) {
        plan.robots.push_back(robot);
        plan.island_offsets.push_back(static_cast<std::uint32_t>(plan.robots.size()));
    }
    return plan;
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
    WindowStepper stepper(sim.model, pool, false, 1);
    const Frame frame = stepper.step(plan_for(sim, 8), store, [] {});
    for (int i = 0; i < 8; ++i) sim.step();
    ASSERT_EQ(frame.islands.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(frame.islands[i].failed.valid(), i == 2) << i;
        if (i == 2) continue;
        EXPECT_EQ(frame.robots[i].hash, state_hash(RobotId(i), 8, sim.states[i])) << i;
        EXPECT_EQ(frame.robots[i].robot, RobotId(i));
    }
}

}  // namespace
}  // namespace roboss::test
