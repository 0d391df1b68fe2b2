// The invariants hold after each tick of random scenes, and their check finds each violation.
#include "physics/invariants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include <support/scenes.h>

namespace roboss::test {
namespace {

constexpr double kFrictionError = 0.01;  // of bodies that rest and slide

TEST(Invariants, HoldAfterEachTickOfCrowds) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Simulation sim(random_crowd(seed, 2 + static_cast<int>(seed % 9)));
        stir(sim, seed);
        for (int i = 0; i < 100; ++i) {
            sim.step();
            ASSERT_EQ(check_invariants(*sim.model, sim.states), "") << "seed " << seed << ", tick " << i;
        }
    }
}

/// Two boxes, one on the other, that have fallen asleep.
World boxes() {
    World world = empty_world(2e-3);
    world.sleep = true;
    place(world, ground(surface(0.7)), "ground");
    world.prototypes.push_back(solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)));
    for (int i = 0; i < 2; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i), world.prototypes.size() - 1, {{0, 0, 0.1 + 0.2 * i}, {}}, {}});
    return world;
}

TEST(Invariants, EachViolationIsFound) {
    Simulation sim(boxes());
    for (int i = 0; i < 1500; ++i) {
        sim.step();
        ASSERT_EQ(check_invariants(*sim.model, sim.states, kFrictionError), "") << "tick " << i;
    }
    const std::size_t box = sim.states.size() - 2;
    ASSERT_TRUE(sim.states[box].rest.asleep);
    ASSERT_GE(sim.states[box].contacts.size(), 2u);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::function<void(RobotState&)>> damages = {
        [&](RobotState& s) { s.q[0] = nan; },
        [&](RobotState& s) { s.v[2] = nan; },
        [](RobotState& s) { s.v.pop_back(); },
        [](RobotState& s) { s.q[3] += 1e-6; },
        [](RobotState& s) { s.v[0] = 1e-9; },
        [](RobotState& s) { std::swap(s.contacts[0], s.contacts[1]); },
        [](RobotState& s) { s.contacts[0].impulse = 0; },
        [](RobotState& s) { s.contacts[0].load = 2 * s.contacts[0].impulse; },
        [](RobotState& s) {
            s.contacts[0].friction = {s.contacts[0].impulse, 0, 0};
        },
        [](RobotState& s) { s.rest.bound = {}; },
        [](RobotState& s) { s.rest.neighbours.push_back(77); },
        [](RobotState& s) { s.rest.asleep = false; },
        [](RobotState& s) { s.wrenches.push_back({}); },
    };
    for (std::size_t i = 0; i < damages.size(); ++i) {
        std::vector<RobotState> damaged = sim.states;
        damages[i](damaged[box]);
        EXPECT_NE(check_invariants(*sim.model, damaged, kFrictionError), "") << "damage " << i;
    }
    std::vector<RobotState> damaged = sim.states;
    damaged[box + 1].rest = {};
    EXPECT_NE(check_invariants(*sim.model, damaged), "") << "a sleeper's neighbour is awake";
}

}  // namespace
}  // namespace roboss::test
