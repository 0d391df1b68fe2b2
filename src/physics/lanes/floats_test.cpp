// Robots in floats: the same bits however they are grouped, bounds as in doubles, and close to doubles
// wherever they are and however far their wheels have turned. (That lanes change no bit: lanes_test.cpp.)
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scenes.h>

namespace roboss::test {
namespace {

World in_floats(World world) {
    world.precision = Precision::kFloat;
    return world;
}

/// A car on the ground at x, y.
World car_at(double x, double y) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, car(), "car", {{x, y, 0.0}, {}});
    return world;
}

/// Two seconds of a curve.
void drive_a_curve(Simulation& sim) {
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        sim.set_motor(0, wheel, MotorMode::kVelocity, wheel % 2 == 0 ? 4.0 : 10.0);
    sim.run(2);
}
constexpr double kCurve = 1e-4;  // m, of .7

Vec3 place_of(const Simulation& sim) {
    const std::vector<double>& q = sim.states[0].q;
    return {q[0], q[1], q[2]};
}

TEST(Floats, GroupingByInteractionBoundsEqualsOneIsland) {
    GroupedStepper stepper;
    std::size_t islands = 0, robot_ticks = 0;
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
        const World world = in_floats(random_crowd(seed, 2 + static_cast<int>(seed % 9)));
        Simulation whole(world), grouped(world);
        stir(whole, seed);
        stir(grouped, seed);
        for (int i = 0; i < 60; ++i) {
            whole.step();
            islands += stepper.step(grouped);
            robot_ticks += whole.states.size();
            ASSERT_EQ(whole.hash(), grouped.hash()) << "seed " << seed << ", tick " << i;
            ASSERT_FALSE(whole.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
        }
    }
    EXPECT_GT(robot_ticks, islands + islands / 20) << "islands of several robots do occur";
}

TEST(Floats, BoundsOfTheStepAreInteractionBounds) {
    World world = in_floats(car_at(3e4, -7e3));
    place(world, car(), "other", {{3e4 + 5, -7e3, 0.2}, from_rpy(0.1, 0, 1)});
    Simulation sim(world);
    for (int i = 0; i < 200; ++i) {
        std::vector<Aabb> expected;
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            expected.push_back(interaction_bound(*sim.model, sim.ids[r], sim.states[r]));
        sim.step();
        ASSERT_EQ(expected, sim.bounds);
    }
}

TEST(Floats, ACarDrivesACurveAsInDoubles) {
    Simulation doubles(car_at(0, 0)), floats(in_floats(car_at(0, 0)));
    drive_a_curve(doubles), drive_a_curve(floats);
    ASSERT_NE(place_of(doubles), place_of(floats)) << "it is stepped in other numbers";
    const double apart = norm(place_of(doubles) - place_of(floats));
    tell("m apart after 2 s", apart);
    EXPECT_LT(apart, kCurve);
    EXPECT_LT(floats.residual_max, 1e-4);
}

TEST(Floats, FarFromTheOriginACarDrivesAsAtTheOrigin) {
    Simulation near(in_floats(car_at(0, 0))), far(in_floats(car_at(2e5, -1e5)));
    drive_a_curve(near), drive_a_curve(far);
    const double apart = norm(place_of(far) - Vec3{2e5, -1e5, 0} - place_of(near));
    tell("m apart after 2 s", apart);
    EXPECT_LT(apart, kCurve);
}

TEST(Floats, WheelsThatHaveTurnedAMillionTimesTurnAsNewOnes) {
    Simulation fresh(in_floats(car_at(0, 0))), worn(in_floats(car_at(0, 0)));
    constexpr double kTurns = 1e6 * 2 * kPi;
    for (std::size_t wheel = 0; wheel < 4; ++wheel) {
        fresh.set_motor(0, wheel, MotorMode::kPosition, 1.5);
        worn.set_motor(0, wheel, MotorMode::kPosition, 1.5 + kTurns);
        worn.states[0].q[7 + wheel] += kTurns;
    }
    fresh.run(1), worn.run(1);
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        EXPECT_NEAR(worn.states[0].q[7 + wheel] - kTurns, fresh.states[0].q[7 + wheel], 1e-6);
    EXPECT_NEAR(fresh.states[0].q[7], 1.5, 1e-3) << "they got there";
}

TEST(Floats, ABrakedCarStandsOnASlope) {
    World world = in_floats(car_at(0, 0));
    world.gravity = {9.8 * fixed_sin(0.2), 0, -9.8 * fixed_cos(0.2)};
    Simulation sim(world);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, 0);
    sim.run(1);
    const Vec3 before = place_of(sim);
    sim.run(10);
    const double creep = norm(place_of(sim) - before) / 10;
    tell("creep, m/s", creep);
    EXPECT_LT(creep, 1e-6);
}

/// What floats cannot reach is not asked of them.
TEST(Floats, TheHighSettingEndsToo) {
    World world = car_at(0, 0);
    world.accuracy = {{"high", {}, {}}};
    Simulation sim(in_floats(world));
    drive_a_curve(sim);
    tell("most Newton iterations of a tick", sim.iterations_max);
    EXPECT_LT(sim.iterations_max, 100);
    EXPECT_NEAR(sim.states[0].v[2], 0.4909, 0.005) << "the yaw rate of cylinder wheels";
}

}  // namespace
}  // namespace roboss::test
