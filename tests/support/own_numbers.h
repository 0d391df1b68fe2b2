// Robots with own numbers, compared with those whose file has the numbers.
#pragma once

#include <gtest/gtest.h>

#include <support/compare_lanes.h>
#include <support/simulation.h>

#include "model/order.h"

namespace roboss::test {

/// Gives a robot an order, at once.
inline void give(Simulation& sim, std::size_t robot, Action action) {
    const Order order{sim.tick, ClientId(0u), 0, sim.ids[robot], std::move(action)};
    const Result<> checked = check_order(*sim.model, order);
    ASSERT_TRUE(checked.ok()) << checked.error().text();
    apply_order(*sim.model, order, sim.states[robot]);
}

/// Steps a world whose file has some numbers, and one whose robots were given them: but for the numbers,
/// their states are equal to the last bit.
inline void expect_equal_steps(Simulation& in_file, Simulation& given, const Drive& drive, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        drive(in_file), drive(given);
        in_file.step(), given.step();
        for (std::size_t r = 0; r < in_file.states.size(); ++r) {
            RobotState without = given.states[r];
            ASSERT_FALSE(without.own.empty());
            without.own = {};
            ASSERT_EQ(state_hash(in_file.ids[r], in_file.tick, in_file.states[r]),
                      state_hash(in_file.ids[r], in_file.tick, without))
                << "robot " << r << ", tick " << i;
        }
        ASSERT_EQ(in_file.bounds, given.bounds);
    }
}

}  // namespace roboss::test
