// Piles of many bodies, and heaps that once broke the solver.
#include <gtest/gtest.h>

#include <cmath>

#include <support/bodies.h>
#include <support/scenes.h>

namespace roboss::test {
namespace {

/// m/s, rad/s
double fastest(const Simulation& sim) {
    double most = 0;
    for (const RobotState& state : sim.states)
        for (const double v : state.v) most = std::fmax(most, std::fabs(v));
    return most;
}

/// Rows of boxes on top of each other: each box stands on two, each row has one less.
World brick_wall(int rows, int columns) {
    constexpr double kSide = 0.1;
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    const std::size_t prototype = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {kSide, kSide, kSide}, surface(0.6)));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns - row; ++column) {
            const std::string name = "box_" + std::to_string(world.instances.size());
            const Vec3 p{1.05 * kSide * (column + 0.5 * row), 0, kSide * (row + 0.5)};
            world.instances.push_back({name, prototype, {p, {}}, {}});
        }
    return world;
}

/// One part of 585 bodies, whose factor hardly fills up: Newton's method solves it. Sweeps would
/// leave it trembling.
TEST(Pile, AWallOfBoxesStandsStill) {
    Simulation sim(brick_wall(6, 100));
    sim.run(0.1);
    tell("fastest box, m/s or rad/s", fastest(sim));
    EXPECT_LT(fastest(sim), 1e-6);
    EXPECT_LE(sim.residual_max, sim.model->accuracy.tolerance);
}

/// What the heaps had in common: contacts whose friction bound is a number like 1e-180, and cars jammed so
/// hard that a friction disc has no room left that doubles could tell.
TEST(Heap, StatesStayFiniteInHeapsThatBrokeTheInteriorPoint) {
    for (const std::uint64_t seed : {294u, 467u, 719u, 746u, 1035u, 3073u}) {
        Simulation sim(random_crowd(seed, 2 + static_cast<int>(seed % 9)));
        stir(sim, seed);
        for (int i = 0; i < 40; ++i) {
            sim.step();
            ASSERT_FALSE(sim.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
        }
    }
}

}  // namespace
}  // namespace roboss::test
