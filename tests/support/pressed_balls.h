// Balls side by side on the ground, pressed together: one part that is large enough for a team of threads.
#pragma once

#include <string>

#include <support/bodies.h>
#include <support/simulation.h>

namespace roboss::test {

inline World balls_side_by_side() {
    constexpr int kSide = 28;
    World world = empty_world(2e-3);
    place(world, ground(surface(0.7)), "ground");
    world.prototypes.push_back(solid_sphere(1.0, 0.1, surface(0.5)));
    for (int i = 0; i < kSide * kSide; ++i)
        world.instances.push_back(
            {"ball_" + std::to_string(i), 1, {{0.199 * (i % kSide), 0.199 * (i / kSide), 0.0995}, {}}, {}});
    return world;
}

/// All balls move to the middle. The steps are profiled, which tells the largest part.
inline void press_together(Simulation& sim) {
    for (RobotState& state : sim.states)
        for (std::size_t axis = 0; axis < 2; ++axis) state.v[3 + axis] = -0.3 * (state.q[axis] - 2);
    sim.scratch.measure_stages([] { return std::uint64_t{0}; });
}

}  // namespace roboss::test
