// What slides without turning moves by the mean of its velocities: exactly, not deeper into anything, and
// what rocks instead gains no energy from it.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kEdge = 0.2;

/// Gravity is tilted instead of the ground: level ground in a world that falls towards +x.
World tilted(double dt_s, double angle, double mu) {
    World world = empty_world(dt_s, {kG * std::sin(angle), 0, -kG * std::cos(angle)});
    place(world, ground(surface(mu)), "ground");
    return world;
}

void put_box(World& world, const std::string& name, double x, double mu, double mass = 1) {
    place(world, solid_box(mass, {kEdge, kEdge, kEdge}, surface(mu)), name, {{x, 0, 0.5 * kEdge}, {}});
}

TEST(Sliding, ABoxSlidesDownAnInclineAsGalileoSays) {
    const double angle = 20 * kPi / 180, mu = 0.2, a = kG * (std::sin(angle) - mu * std::cos(angle));
    for (const double dt_s : {1e-3, 2e-3, 5e-3}) {
        World world = tilted(dt_s, angle, mu);
        put_box(world, "box", 0, mu);
        Simulation sim(world);
        sim.run(2);
        EXPECT_NEAR(sim.states[0].q[0] / (2 * a), 1, 0.6 * dt_s * dt_s) << dt_s << " s";
        EXPECT_NEAR(sim.states[0].v[3] / (2 * a), 1, 1e-10) << dt_s << " s";
        EXPECT_NEAR(sim.states[0].q[2], 0.5 * kEdge, 0.01 * dt_s * dt_s);
    }
}

TEST(Sliding, ABoxSlidesToAStopWhereItsEnergyIsSpent) {
    constexpr double kMu = 0.3, kSpeed = 2;
    World world = tilted(1e-3, 0, kMu);
    put_box(world, "box", 0, kMu);
    Simulation sim(world);
    sim.run(0.1);
    sim.states[0].v[3] = kSpeed;
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[3], 0, 1e-9);
    EXPECT_NEAR(sim.states[0].q[0] / (kSpeed * kSpeed / (2 * kMu * kG)), 1, 1e-5);
}

/// The smooth box pushes the rough one down the incline: both move by their means, or neither does.
TEST(Sliding, BoxesThatPushEachOtherNeitherPartNorMeetDeeper) {
    const double angle = 20 * kPi / 180;
    World world = tilted(1e-3, angle, 0.9);
    put_box(world, "rough", 0, 0.3);
    put_box(world, "smooth", -kEdge, 0);
    Simulation sim(world);
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        ASSERT_NEAR(sim.states[0].q[0] - sim.states[1].q[0], kEdge, 1e-7) << "tick " << i;
    }
    const double a = kG * (std::sin(angle) - 0.5 * 0.3 * std::cos(angle));
    EXPECT_NEAR(sim.states[0].q[0] / (2 * a), 1, 5e-4);
}

TEST(Sliding, ABoxThatSlidesAgainstAWallStopsAtIt) {
    constexpr double kWall = 1.0;
    World world = tilted(2e-3, 0, 0.1);
    put_box(world, "box", 0, 0.1);
    ModelSpec wall = solid_box(1, {0.1, 2, 2}, surface(0.1));
    wall.is_static = true;
    place(world, wall, "wall", {{kWall + 0.05, 0, 1}, {}});
    Simulation sim(world);
    sim.run(0.1);
    sim.states[0].v[3] = 5;
    double furthest = 0;
    for (int i = 0; i < 500; ++i) {
        sim.step();
        furthest = std::fmax(furthest, sim.states[0].q[0] + 0.5 * kEdge);
    }
    EXPECT_GT(furthest, kWall - 1e-6);
    EXPECT_LT(furthest, kWall + 1e-6);
}

/// A ball whose centre of mass lies below its middle rocks for ever. Its weight acts by where it is, so
/// moving by mean velocities would more than double its energy in these 20 s.
TEST(Sliding, ARockingBallGainsNoEnergy) {
    World world = tilted(2e-3, 0, 0.9);
    ModelSpec ball = solid_sphere(1, 0.1, surface(0.9));
    ball.links[0].p_LC = {0, 0, -0.04};
    place(world, ball, "ball", {{0, 0, 0.1}, from_rpy(0, 0.6, 0)});
    Simulation sim(world);
    const double lowest = kG * 0.06, energy = sim.energy(0) - lowest;
    double highest = 0;
    for (int i = 0; i < 10000; ++i) {
        sim.step();
        highest = std::fmax(highest, (sim.energy(0) - lowest) / energy);
    }
    tell("highest energy of the rocking ball, of that at the start", highest);
    EXPECT_LT(highest, 1.02);
    EXPECT_GT(highest, 0.9);
}

}  // namespace
}  // namespace roboss::test
