// Sensors of a simulation without roles, for tests.
#pragma once

#include <vector>

#include <support/simulation.h>

#include "sensors/test_model.h"

namespace roboss::sensors_test {

/// What a sensor measures now, with seed 1.
template <class Reading>
Reading reading_of(const test::Simulation& sim, std::size_t robot = 0, std::size_t sensor = 0) {
    std::vector<const RobotState*> states;
    for (const RobotState& state : sim.states) states.push_back(&state);
    return read_as<Reading>(sim.model, states, sensor, sim.tick, 1, robot);
}

}  // namespace roboss::sensors_test
