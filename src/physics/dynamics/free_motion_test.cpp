// Motion that nothing touches: energy and momentum stay, and the error falls with the power of the step that
// the method's order says.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

double relative_change(const Vec3& now, const Vec3& before) {
    return norm(now - before) / norm(before);
}

/// The tumbling block turns about its middle axis, the unstable one.
World tumbling_block(const Vec3& gravity) {
    World world = empty_world(1e-3, gravity);
    place(world, solid_box(2.0, {1, 4, 9}, surface(0.5)), "block", {{1, 2, 3}, from_rpy(0.3, 0.2, 0.1)});
    return world;
}

TEST(FreeMotion, TumblingBlockKeepsEnergyAndAngularMomentum) {
    Simulation sim(tumbling_block({}));
    sim.states[0].v = {0.05, 3.0, 0.05, 1, 2, 3};
    const double energy = sim.energy();
    const Momentum momentum = sim.momentum();
    sim.run(10);
    const double energy_drift = std::fabs(sim.energy() / energy - 1);
    const Momentum now = sim.momentum();
    tell("relative energy drift in 10 s", energy_drift);
    tell("relative angular momentum drift", relative_change(now.angular, momentum.angular));
    EXPECT_LT(energy_drift, 1e-10);
    EXPECT_LT(relative_change(now.angular, momentum.angular), 1e-10);
    EXPECT_LT(relative_change(now.linear, momentum.linear), 1e-13);
}

/// Cubes, bricks, plates, rods and needles. Angular momentum of those that are no rods stays to rounding.
TEST(FreeMotion, LoneBodiesOfAnyProportionsGainNoEnergy) {
    double most_drift = 0;
    for (const Vec3& size :
         {Vec3{1, 1, 1}, {1, 2, 1.5}, {1, 1, 0.1}, {1, 3, 2.5}, {0.1, 0.1, 1}, {0.002, 0.002, 1}})
        for (const double speed : {10.0, 100.0, 300.0}) {  // rad/s
            World world = empty_world(2e-3, {});
            place(world, solid_box(2.0, size, surface(0.5)), "body", {{}, from_rpy(0.3, 0.2, 0.1)});
            Simulation sim(world);
            sim.states[0].v = {0.3 * speed, 0.8 * speed, 0.5 * speed, 1, 2, 3};
            const double energy = sim.energy();
            const Momentum momentum = sim.momentum();
            sim.run(1);
            EXPECT_LT(sim.energy(), (1 + 3e-5) * energy) << size.x << ' ' << size.z << ' ' << speed;
            const double drift = relative_change(sim.momentum().angular, momentum.angular);
            if (size.x > 0.5) most_drift = std::fmax(most_drift, drift);
            EXPECT_LT(drift, 1e-9);
        }
    tell("largest relative drift of the angular momentum in a second", most_drift);
    EXPECT_LT(most_drift, 1e-12);
}

TEST(FreeMotion, ThrownBlockFollowsTheParabola) {
    Simulation sim(tumbling_block({0, 0, -9.81}));
    sim.states[0].v = {0.05, 3.0, 0.05, 1, 2, 30};
    sim.run(2);
    EXPECT_NEAR(sim.states[0].q[0], 1 + 2 * 1, 1e-10);
    EXPECT_NEAR(sim.states[0].q[1], 2 + 2 * 2, 1e-10);
    EXPECT_NEAR(sim.states[0].q[2], 3 + 2 * 30 - 0.5 * 9.81 * 4, 1e-10);
}

TEST(FreeMotion, SwingingArmKeepsItsEnergy) {
    World world = empty_world(1e-3);
    place(world, arm(), "arm");
    Simulation sim(world);
    const double lowest = sim.energy();  // hangs at zero
    const double start[] = {0.5, 1.2, 0.8, -0.7};
    for (std::size_t i = 0; i < 4; ++i) sim.states[0].q[7 + i] = start[i];
    const double energy = sim.energy();
    double drift = 0;
    for (int i = 0; i < 100; ++i) {
        sim.run(0.1);
        drift = std::fmax(drift, std::fabs(sim.energy() - energy) / (energy - lowest));
    }
    tell("largest energy drift of the swinging arm in 10 s at 1 ms, relative to the swing", drift);
    EXPECT_LT(drift, 1e-6);  // semi-implicit Euler loses 7 to 56 %
}

TEST(FreeMotion, SpiderInFreeFallKeepsEnergyAndMomentum) {
    World world = empty_world(1e-3, {});
    place(world, spider(), "spider");
    Simulation sim(world);
    Random random(3);
    for (double& v : sim.states[0].v) v = random.uniform(-2, 2);
    const double energy = sim.energy();
    const Momentum momentum = sim.momentum();
    sim.run(3);
    tell("relative energy drift of the spider in 3 s", std::fabs(sim.energy() / energy - 1));
    EXPECT_LT(std::fabs(sim.energy() / energy - 1), 1e-7);
    EXPECT_LT(relative_change(sim.momentum().linear, momentum.linear), 1e-8);
    EXPECT_LT(relative_change(sim.momentum().angular, momentum.angular), 1e-8);
}

/// Largest difference in q after a second at step dt from the same start.
double error_at(const World& base, double dt, const std::vector<double>& q, const std::vector<double>& v,
                const std::vector<double>& exact, std::vector<double>* end = nullptr) {
    World world = base;
    world.dt_s = dt;
    Simulation sim(world);
    sim.states[0].q = q;
    sim.states[0].v = v;
    sim.run(1.0);
    if (end != nullptr) *end = sim.states[0].q;
    double error = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        error = std::fmax(error, std::fabs(sim.states[0].q[i] - exact[i]));
    return error;
}

void expect_order(int theory, ModelSpec model, double speed) {
    World world = empty_world(1e-3);
    const std::string name = model.name;
    place(world, std::move(model), name);
    Simulation start(world);
    Random random(11);
    for (double& v : start.states[0].v) v = random.uniform(-speed, speed);
    const std::vector<double> q = start.states[0].q, v = start.states[0].v;
    std::vector<double> exact;
    error_at(world, 1.0 / 8192, q, v, {}, &exact);
    const double coarse = error_at(world, 1.0 / 256, q, v, exact),
                 fine = error_at(world, 1.0 / 512, q, v, exact);
    const double order = std::log2(coarse / fine);
    tell(name + ": order of convergence", order);
    EXPECT_GT(order, theory - 0.3) << "errors " << coarse << " and " << fine;
    EXPECT_LT(order, theory + 0.5);
}

TEST(FreeMotion, ErrorFallsWithTheSixthPowerOfTheStepOnJointsAndTheFourthOfALoneBody) {
    ModelSpec damped = double_pendulum();
    damped.joints[1].axes[0].damping = 0.05;
    damped.joints[1].axes[0].spring_stiffness = 5;
    expect_order(6, damped, 3);
    expect_order(6, arm(), 2);
    expect_order(6, ball_chain(), 2);
    expect_order(4, solid_box(1, {0.1, 0.4, 0.9}, surface(0)), 6);
}

/// dt * damping / inertia = 30: an explicit method would blow up in a few ticks.
TEST(FreeMotion, StiffDampingAndSpringsOfAFlyingRobotStayStable) {
    for (const bool spring : {false, true}) {
        ModelSpec m = double_pendulum();
        (spring ? m.joints[1].axes[0].spring_stiffness : m.joints[1].axes[0].damping) = spring ? 3e6 : 2e3;
        World world = empty_world(2e-3);
        place(world, m, "pendulum");
        Simulation sim(world);
        sim.states[0].q[7] = 1.0;
        sim.states[0].v[1] = 0.5;
        const double energy = sim.energy();
        double highest = energy;
        for (int i = 0; i < 500; ++i) {
            sim.step();
            ASSERT_FALSE(sim.report.not_finite.valid()) << "tick " << i;
            highest = std::fmax(highest, sim.energy());
        }
        EXPECT_LT(highest, energy + 0.1) << (spring ? "spring" : "damping");
        EXPECT_LT(std::fabs(sim.states[0].q[8]), 0.05) << "the joint is nearly rigid";
    }
}

/// A rod that a blow or friction spins about its length: beyond the method's stability at one step a tick.
TEST(FreeMotion, AThinRodSpinningFastStaysFiniteAndKeepsEnergyAndMomentum) {
    for (const double spin : {50.0, 500.0, 1500.0, 5000.0}) {
        World world = empty_world(2e-3, {});
        place(world, solid_cylinder(0.05, 0.005, 0.3, surface(0.5)), "rod", {{}, from_rpy(0.3, 0.4, 0)});
        Simulation sim(world);
        const Vec3 along = rotate(from_rpy(0.3, 0.4, 0), Vec3{0, 0, 1});
        for (std::size_t i = 0; i < 3; ++i) sim.states[0].v[i] = spin * along[i];
        sim.states[0].v[0] += 3;
        const double energy = sim.energy(0);
        const Vec3 momentum = sim.momentum().angular;
        sim.run(2);
        ASSERT_FALSE(sim.report.not_finite.valid()) << spin << " rad/s";
        EXPECT_NEAR(sim.energy(0) / energy, 1, 2e-2) << spin << " rad/s";
        EXPECT_LT(norm(sim.momentum().angular - momentum), 2e-2 * norm(momentum)) << spin << " rad/s";
    }
}

}  // namespace
}  // namespace roboss::test
