// Own gravity and wind: from the tick of the order on, a robot moves as one of a world whose file has them,
// bit for bit; and as closed forms say.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <support/mechanisms.h>
#include <support/own_numbers.h>
#include <support/robots.h>

#include "model/order.h"

namespace roboss::test {
namespace {

const Vec3 kSlope{0.4, -0.3, -3.7}, kGust{4, -3, 1};

void set_gravity(Simulation& sim, std::size_t robot, const Vec3& gravity) {
    give(sim, robot, SetSurroundings{false, {gravity, std::nullopt}});
}

void turn_motors(Simulation& sim) {
    if (sim.tick % 50 != 0) return;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t d = 0; d < sim.type(r).dofs.size(); d += 2)
            sim.states[r].motors[d] = {MotorMode::kVelocity, sim.tick % 100 == 0 ? 0.3 : -0.2, 20.0};
}

/// A ball that the wind carries.
ModelSpec sail(double linear) {
    ModelSpec ball = solid_sphere(0.5, 0.1, surface(0.5));
    DragSpec& drag = ball.links[0].drag;
    drag.acts = drag.wind = true;
    drag.area = 0, drag.linear = linear;
    return ball;
}

/// Boxes on each other, and a few beside them.
World piled(const char* setting) {
    World world = empty_world(2e-3);
    world.accuracy.push_back({setting, {}, {}});
    place(world, ground(surface(0.6)), "ground");
    for (int i = 0; i < 12; ++i)
        place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.6)), "box_" + std::to_string(i),
              {{0.15 * (i % 3), 0.02 * i, 0.11 + 0.21 * (i / 3)}, from_rpy(0, 0, 0.1 * i)});
    return world;
}

std::vector<std::pair<std::string, World>> worlds_of_all_kinds() {
    std::vector<std::pair<std::string, World>> all{
        {"spiders", scattered(with_balls(spider(), 0.02), 5, 0.0)},
        {"arms", scattered(arm(), 5, 2.0)},
        {"cars", scattered(car(), 5, 0.001)},
        {"boxes that sleep", scattered(solid_box(2, {0.2, 0.3, 0.1}, surface(0.5)), 5, 0.06)},
        {"trees of all joints", scattered(mixed_tree(), 3, 0.5)},
        {"four bars", scattered(four_bar(), 3, 0.5)},
        {"balls in the wind", scattered(sail(0.8), 3, 2.0)},
        {"a pile", piled("")},
        {"a pile, fast", piled("fast")},
    };
    all[3].second.sleep = true;
    return all;
}

/// Runs the world for a while, gives all robots gravity and wind, and continues beside a world whose file has
/// them, from the same state.
void expect_the_run_of_such_a_file(const std::string& name, World world, Precision precision) {
    SCOPED_TRACE(name + (precision == Precision::kFloat ? ", floats" : ""));
    world.precision = precision;
    Simulation given(world);
    world.gravity = kSlope, world.wind = kGust;
    Simulation in_file(world);
    for (int i = 0; i < 120; ++i) turn_motors(given), given.step();
    in_file.tick = given.tick;
    for (std::size_t r = 0; r < given.states.size(); ++r) {
        give(given, r, SetSurroundings{false, {kSlope, kGust}});
        in_file.states[r] = given.states[r];
        set_own(in_file.type(r), {}, in_file.states[r]);
    }
    expect_equal_steps(in_file, given, turn_motors, 250);
}

TEST(OwnSurroundings, MoveRobotsAsAFileWithThemDoes) {
    for (const auto& [name, world] : worlds_of_all_kinds())
        expect_the_run_of_such_a_file(name, world, Precision::kDouble);
}

TEST(OwnSurroundings, MoveRobotsSteppedInFloatsAsAFileWithThemDoes) {
    for (const auto& [name, world] : worlds_of_all_kinds())
        expect_the_run_of_such_a_file(name, world, Precision::kFloat);
}

TEST(OwnSurroundings, OfSomeRobotsGiveTheSameBitsInLanes) {
    const Drive some_differ = [](Simulation& sim) {
        turn_motors(sim);
        if (sim.tick % 60 != 7) return;
        for (std::size_t r = 0; r < sim.states.size(); ++r)  // some equal, some their own, some of the world
            if (r % 3 != 0)
                set_gravity(
                    sim, r,
                    {r % 2 == 0 ? -0.0 : 0.0, 0, r % 3 == 1 ? -1.62 : -3.0 - 0.5 * static_cast<double>(r)});
    };
    compare(scattered(with_balls(spider(), 0.02), 13, 0.0), some_differ, 200);
    compare(scattered(solid_box(2, {0.2, 0.3, 0.1}, surface(0.5)), 13, 0.06), some_differ, 200);
}

TEST(OwnSurroundings, OfAllRobotsGiveTheSameBitsInLanes) {
    const Drive all_alike = [](Simulation& sim) {
        turn_motors(sim);
        if (sim.tick == 20)
            for (std::size_t r = 0; r < sim.states.size(); ++r) set_gravity(sim, r, {0, 0, -1.62});
    };
    compare(scattered(with_balls(spider(), 0.02), 13, 0.0), all_alike, 200);
}

TEST(OwnSurroundings, ABodyFallsOnTheParabolaOfItsGravity) {
    World world = empty_world(1e-3, {0, 0, -9.81});
    place(world, solid_sphere(1, 0.1, surface(0.5)), "changed");
    place(world, solid_sphere(1, 0.1, surface(0.5)), "other", {{5, 0, 0}, {}});
    Simulation sim(world);
    sim.run(0.4);
    set_gravity(sim, 0, {0.5, 0, -1.62});
    sim.run(0.6);
    const double z = -0.5 * 9.81 * 0.16 - 9.81 * 0.4 * 0.6 - 0.5 * 1.62 * 0.36;
    EXPECT_NEAR(sim.states[0].q[0], 0.5 * 0.5 * 0.36, 1e-12);
    EXPECT_NEAR(sim.states[0].q[2], z, 1e-11);
    EXPECT_NEAR(sim.states[0].v[5], -9.81 * 0.4 - 1.62 * 0.6, 1e-11);
    EXPECT_NEAR(sim.states[1].q[2], -0.5 * 9.81, 1e-11) << "the other one has the gravity of the world";
    give(sim, 0, SetSurroundings{true, {}});
    const double speed = sim.states[0].v[5];
    sim.run(0.5);
    EXPECT_NEAR(sim.states[0].v[5], speed - 9.81 * 0.5, 1e-11);
}

TEST(OwnSurroundings, APendulumSwingsWithThePeriodOfItsGravity) {
    World world = empty_world(1e-3, {0, 0, -9.81});
    place(world, pendulum(2.0, 0.8), "rod");
    Simulation sim(world);
    set_gravity(sim, 0, {0, 0, -1.62});
    const RobotType& type = sim.type(0);
    const Body& rod = type.bodies[0];
    const double arm = norm(rod.p_BC), moment = rod.inertia_C(1, 1) + rod.mass * arm * arm;
    const double small = 0.01, rate = std::sqrt(rod.mass * 1.62 * arm / moment);
    sim.states[0].q[7] = small;
    for (int i = 0; i < 4000; ++i) {
        sim.step();
        ASSERT_NEAR(sim.states[0].q[7], small * std::cos(rate * sim.time()), 2e-5) << sim.time();
    }
}

TEST(OwnSurroundings, ABoxPressesWithTheWeightOfItsGravity) {
    for (const char* setting : {"standard", "fast"}) {
        World world = empty_world(1e-3, {0, 0, -9.81});
        world.accuracy.push_back({setting, {}, {}});
        place(world, ground(surface(1.0)), "ground");
        for (int i = 0; i < 2; ++i)
            place(world, solid_box(2, {0.2, 0.2, 0.1}, surface(0.8)), "box_" + std::to_string(i),
                  {{1.0 * i, 0, 0.05}, {}});
        Simulation sim(world);
        set_gravity(sim, 1, {0, 0, -25});
        sim.run(1);
        for (std::size_t r : {0u, 1u}) {
            double impulse = 0;
            for (const ContactMemory& contact : sim.states[r].contacts) impulse += contact.impulse;
            EXPECT_NEAR(impulse / 1e-3, 2 * (r == 0 ? 9.81 : 25), 0.02) << setting << ", box " << r;
        }
    }
}

TEST(OwnSurroundings, ASleeperWakesAndRisesWhereItsGravityPointsUp) {
    World world = empty_world(1e-3, {0, 0, -9.81});
    world.sleep = true;
    place(world, ground(surface(1.0)), "ground");
    place(world, solid_box(2, {0.2, 0.2, 0.1}, surface(0.8)), "box", {{0, 0, 0.05}, {}});
    Simulation sim(world);
    sim.run(3);
    ASSERT_TRUE(sim.states[0].rest.asleep);
    const double before = sim.states[0].q[2];
    set_gravity(sim, 0, {0, 0, 2});
    sim.run(1);
    EXPECT_FALSE(sim.states[0].rest.asleep);
    EXPECT_NEAR(sim.states[0].q[2] - before, 1, 5e-3);
}

TEST(OwnSurroundings, TheWindCarriesABallWithTheTimeOfItsDrag) {
    World world = empty_world(1e-3, {});
    place(world, sail(0.5), "ball");
    Simulation sim(world);
    sim.run(1);
    EXPECT_EQ(sim.states[0].v[3], 0) << "the air stands still";
    give(sim, 0, SetSurroundings{false, {std::nullopt, Vec3{2, 0, 0}}});
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[3], 2 * (1 - std::exp(-0.5 / 0.5)), 1e-3);
}

}  // namespace
}  // namespace roboss::test
