// The IMU against closed forms: at rest, in free fall, on a turntable, on a pendulum, at an impact; and its
// noise.
#include <gtest/gtest.h>

#include <cmath>

#include <support/own_numbers.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "sensors/test_model.h"

namespace roboss {
namespace {

constexpr double kG = 9.81;

SensorSpec imu(const Pose& X_LS = {}, const ImuSpec& parameters = {}) {
    return sensors_test::sensor("imu", parameters, X_LS);
}

ImuReading reading_of(const test::Simulation& sim, std::uint64_t seed = 1) {
    std::vector<const RobotState*> states;
    for (const RobotState& state : sim.states) states.push_back(&state);
    return sensors_test::read_as<ImuReading>(sim.model, states, 0, sim.tick, seed);
}

/// A box of 2 kg with an IMU in a corner that is turned a quarter about x: its y axis points up.
ModelSpec box_with_imu() {
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {imu({{0.2, 0.1, 0}, from_rpy(kPi / 2, 0, 0)})};
    return box;
}

TEST(Imu, AtRestOnTheGroundItReadsGravityUpwards) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, test::ground(test::surface(0.5)), "ground");
    test::place(world, box_with_imu(), "box", {{0, 0, 0.05}, {}});
    test::Simulation sim(world);
    sim.run(0.5);
    const ImuReading reading = reading_of(sim);
    EXPECT_NEAR(norm(reading.specific_force_S - Vec3{0, kG, 0}), 0, 1e-3);
    EXPECT_NEAR(norm(reading.angular_velocity_S), 0, 1e-6);
    EXPECT_EQ(reading.tick, 500);
}

TEST(Imu, ASleepingRobotReadsGravityToo) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    world.sleep = true;
    test::place(world, test::ground(test::surface(0.5)), "ground");
    test::place(world, box_with_imu(), "box", {{0, 0, 0.05}, {}});
    test::Simulation sim(world);
    sim.run(3);
    ASSERT_TRUE(sim.states[0].rest.asleep);
    EXPECT_NEAR(norm(reading_of(sim).specific_force_S - Vec3{0, kG, 0}), 0, 1e-3);
}

TEST(Imu, ReadsTheGravityOfARobotThatHasItsOwn) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, test::ground(test::surface(0.5)), "ground");
    test::place(world, box_with_imu(), "box", {{0, 0, 0.05}, {}});
    test::Simulation sim(world);
    test::give(sim, 0, SetSurroundings{false, {Vec3{0, 0, -1.62}, std::nullopt}});
    sim.run(0.5);
    EXPECT_NEAR(norm(reading_of(sim).specific_force_S - Vec3{0, 1.62, 0}), 0, 1e-3);
}

TEST(Imu, OnAStaticModelItReadsGravity) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec mast = box_with_imu();
    mast.is_static = true;
    test::place(world, mast, "mast", {{0, 0, 2}, {}});
    const test::Simulation sim(world);
    EXPECT_NEAR(norm(reading_of(sim).specific_force_S - Vec3{0, kG, 0}), 0, 1e-12);
}

TEST(Imu, InFreeFallItReadsNothingAtTheCentreOfMass) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {imu()};
    test::place(world, box, "box", {{0, 0, 10}, from_rpy(0.3, 0.2, 0.1)});
    test::Simulation sim(world);
    sim.states[0].v = {0, 0, 5, 1, 2, 3};
    sim.run(0.3);
    EXPECT_NEAR(norm(reading_of(sim).specific_force_S), 0, 1e-9);
}

/// A disc on a vertical hinge, with an IMU 0.5 m from the axis, its x axis outwards.
TEST(Imu, OnATurntableItReadsTheCentripetalAcceleration) {
    const double radius = 0.5, rate = 4;
    ModelSpec table;
    table.name = "table";
    LinkSpec disc = test::link("disc", 3, test::cylinder_inertia(3, 1, 0.1));
    disc.sensors = {imu({{radius, 0, 0}, {}})};
    table.links = {disc};
    table.joints = {test::joint(JointSpecKind::kContinuous, "axis", "world", "disc", {}, {0, 0, 1})};
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, table, "table");
    test::Simulation sim(world);
    sim.states[0].v = {rate};
    sim.run(0.7);
    const ImuReading reading = reading_of(sim);
    EXPECT_NEAR(norm(reading.specific_force_S - Vec3{-rate * rate * radius, 0, kG}), 0, 1e-4)
        << "of second order in the step";
    EXPECT_NEAR(norm(reading.angular_velocity_S - Vec3{0, 0, rate}), 0, 1e-9);
}

/// A sled that motors drive outwards on a turning arm: centripetal and Coriolis acceleration.
TEST(Imu, OnASledOnATurntableItReadsTheCoriolisAcceleration) {
    const double rate = 3, speed = 0.8;
    ModelSpec table;
    table.name = "table";
    LinkSpec disc = test::link("disc", 30, test::cylinder_inertia(30, 1, 0.1));
    LinkSpec sled = test::link("sled", 1, test::cylinder_inertia(1, 0.1, 0.1));
    sled.X_ML.p = {0.2, 0, 0};
    sled.sensors = {imu()};
    table.links = {disc, sled};
    table.joints = {
        test::joint(JointSpecKind::kContinuous, "axis", "world", "disc", {}, {0, 0, 1}),
        test::joint(JointSpecKind::kPrismatic, "slide", "disc", "sled", {{0.2, 0, 0}, {}}, {1, 0, 0})};
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, table, "table");
    test::Simulation sim(world);
    sim.states[0].v = {rate, speed};
    sim.set_motor(0, 0, MotorMode::kVelocity, rate);
    sim.set_motor(0, 1, MotorMode::kVelocity, speed);
    sim.run(0.5);
    const ImuReading reading = reading_of(sim);
    const double radius = 0.2 + speed * (0.5 + 0.5e-3);  // at the middle of the tick that begins now
    EXPECT_NEAR(norm(reading.specific_force_S - Vec3{-rate * rate * radius, 2 * rate * speed, kG}), 0, 1e-3);
    EXPECT_NEAR(norm(reading.angular_velocity_S - Vec3{0, 0, rate}), 0, 1e-6);
}

/// At the bob the string is all that acts: along it g cos(a) + l w^2, across it nothing. The rod of this
/// pendulum is a point mass in effect: a sensor at the centre of oscillation, 2/3 of a thin rod, feels
/// nothing across either.
TEST(Imu, OnAPendulumItReadsTheForceOfTheRod) {
    const double length = 1;
    ModelSpec pendulum = test::pendulum(1, length);
    const LinkSpec& rod = pendulum.links[0];
    const double inertia = rod.inertia_C(1, 1) + rod.mass * norm(rod.p_LC) * norm(rod.p_LC);
    const double oscillation = inertia / (rod.mass * norm(rod.p_LC));
    pendulum.links[0].sensors = {imu({{0, 0, -oscillation}, {}})};
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, pendulum, "pendulum");
    test::Simulation sim(world);
    sim.states[0].q[7] = 1;
    for (int i = 0; i < 10; ++i) {
        sim.run(0.1);
        const ImuReading reading = reading_of(sim);
        const double rate = sim.states[0].v[0];
        // the reading is the mean over the tick that begins now: of its middle to second order
        const double angle = sim.states[0].q[7] + 0.5 * rate * 1e-3,
                     middle = rate - 0.5 * kG / oscillation * std::sin(angle) * 1e-3;
        const double along = kG * std::cos(angle) + oscillation * middle * middle;
        EXPECT_NEAR(norm(reading.specific_force_S - Vec3{0, 0, along}), 0, 1e-4) << i;
        EXPECT_NEAR(norm(reading.angular_velocity_S - Vec3{0, rate, 0}), 0, 1e-9) << i;
    }
}

TEST(Imu, AnImpactShowsAsItsImpulseOverOneTick) {
    const double dt = 1e-3;
    World world = test::empty_world(dt, {0, 0, -kG});
    test::place(world, test::ground(test::surface(0.5)), "ground");
    ModelSpec ball = test::solid_sphere(1, 0.1, test::surface(0.5));
    ball.links[0].sensors = {imu()};
    test::place(world, ball, "ball", {{0, 0, 0.6}, {}});
    test::Simulation sim(world);
    double sum = 0, largest = 0;
    for (int i = 0; i < 600; ++i) {
        const double force = reading_of(sim).specific_force_S.z, before = sim.states[0].v[5];
        sim.step();
        EXPECT_NEAR(force, (sim.states[0].v[5] - before) / dt + kG, 1e-6);
        sum += force * dt, largest = std::fmax(largest, force);
    }
    const double speed = std::sqrt(2 * kG * 0.5);
    EXPECT_GT(largest, 0.5 * speed / dt) << "one tick or two stop it";
    EXPECT_NEAR(sum, 600 * dt * kG, 1e-6) << "in all it gives what gravity takes: the ball lies still";
}

TEST(Imu, EachAxisHasNoiseOfItsOwn) {
    ImuSpec noisy;
    noisy.linear_acceleration_x.mean = 0.2, noisy.linear_acceleration_x.stddev = 0.5;
    noisy.linear_acceleration_y.stddev = 0.5;
    noisy.linear_acceleration_z.bias_mean = 1, noisy.linear_acceleration_z.bias_stddev = 0.3;
    noisy.angular_velocity_x.stddev = 0.02;
    World world = test::empty_world(1e-3, {});
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {imu({}, noisy)};
    test::place(world, box, "box");
    test::Simulation sim(world);
    constexpr int kDraws = 4000;
    double sum_x = 0, squares_x = 0, squares_y = 0, product = 0, squares_rate = 0;
    const double bias = reading_of(sim).specific_force_S.z;
    EXPECT_NEAR(bias, 1, 1.5);
    EXPECT_NE(bias, 1);
    EXPECT_NE(reading_of(sim, 2).specific_force_S.z, bias) << "another seed";
    for (sim.tick = 0; sim.tick < kDraws; ++sim.tick) {
        const ImuReading r = reading_of(sim);
        const Vec3 f = r.specific_force_S - Vec3{0.2, 0, 0};
        sum_x += f.x, squares_x += f.x * f.x, squares_y += f.y * f.y, product += f.x * f.y;
        squares_rate += r.angular_velocity_S.x * r.angular_velocity_S.x;
        EXPECT_EQ(f.z, bias) << "the bias is drawn once";
        EXPECT_EQ(r.angular_velocity_S.y, 0);
    }
    EXPECT_NEAR(sum_x / kDraws, 0, 0.03);
    EXPECT_NEAR(std::sqrt(squares_x / kDraws), 0.5, 0.03);
    EXPECT_NEAR(std::sqrt(squares_y / kDraws), 0.5, 0.03);
    EXPECT_LT(std::fabs(product) / kDraws, 0.02) << "axes are drawn independently";
    EXPECT_NEAR(std::sqrt(squares_rate / kDraws), 0.02, 0.001);
}

}  // namespace
}  // namespace roboss
