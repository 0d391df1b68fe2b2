// Scenes as users make them by mistake: robots that start deep in each other, with soft contacts and soft
// limits, servos without bounds, at every corner of the accuracy that is allowed. States stay finite, speeds
// sane, and momentum balances.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/scenes.h>

#include "model/accuracy.h"

namespace roboss::test {
namespace {

double fastest(const Simulation& sim) {
    double most = 0;
    for (const RobotState& state : sim.states)
        for (const double v : state.v) most = std::fmax(most, std::fabs(v));
    return most;
}

/// Some of the accuracy's numbers at an end of their range.
AccuracySpec random_corner(std::uint64_t seed) {
    Random random(seed);
    AccuracySpec spec;
    spec.setting = std::array{"fast", "standard", "high"}[seed % 3];
    for (const AccuracyNumber& n : accuracy_numbers()) {
        const double pick = random.uniform(0, 1);
        if (pick < 0.4) continue;
        const double most = n.whole != nullptr ? std::fmin(n.high, 200) : n.high;
        spec.numbers.push_back({n.name, pick < 0.7 ? n.low : most});
    }
    return spec;
}

TEST(WildScenes, MomentumBalancesAtEveryCornerOfTheAccuracy) {
    std::size_t ticks = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        World world = random_crowd(seed, 2 + static_cast<int>(seed % 9));
        world.accuracy.push_back(random_corner(seed));
        Simulation sim(world);
        stir(sim, seed);
        for (int i = 0; i < 60; ++i, ++ticks) {
            sim.step();
            ASSERT_FALSE(sim.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
            wrong += sim.report.residual > 1e-4 ? 1 : 0;
        }
        EXPECT_LT(fastest(sim), 500) << "seed " << seed;
    }
    tell("ticks whose momentum is off by more than 1e-4, of all",
         static_cast<double>(wrong) / static_cast<double>(ticks));
    EXPECT_LE(wrong, 2u);
}

/// A spider with shapes on all links and random numbers at its joints.
ModelSpec rigged_spider(Random& random, const SurfaceSpec& s, bool soft_limits) {
    ModelSpec m = spider();
    m.self_collide = true;
    for (LinkSpec& l : m.links)
        l.collisions.push_back(l.name == "body" ? box_shape({0.3, 0.2, 0.1}, s)
                                                : box_shape({0.1, 0.02, 0.03}, s, {{0.05, 0, -0.01}, {}}));
    for (JointSpec& j : m.joints) {
        AxisSpec& axis = j.axes[0];
        if (random.uniform(0, 1) < 0.5) continue;
        axis.lower = random.uniform(-1, 0), axis.upper = random.uniform(0, 1);
        if (!soft_limits || random.uniform(0, 1) < 0.5) continue;
        axis.limit_stiffness = std::pow(10.0, random.uniform(1, 7));
        axis.limit_dissipation = std::pow(10.0, random.uniform(-1, 3));
    }
    return m;
}

void expect_sane(const World& world, double seconds, double speed_max, std::uint64_t seed) {
    Simulation sim(world);
    while (sim.time() < seconds) {
        sim.step();
        ASSERT_FALSE(sim.report.not_finite.valid()) << "seed " << seed << ", time " << sim.time();
    }
    tell("seed " + std::to_string(seed) + ": fastest joint or base at the end", fastest(sim));
    EXPECT_LT(fastest(sim), speed_max) << "seed " << seed;
}

World overlapping_spiders(std::uint64_t seed, const SurfaceSpec& s, bool soft_limits) {
    Random random(seed);
    World world = empty_world(2e-3);
    place(world, ground(surface(0.7)), "ground");
    for (int i = 0; i < 5; ++i)
        place(world, rigged_spider(random, s, soft_limits), "spider_" + std::to_string(i),
              {{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0, 0.3)},
               random.rotation()});
    return world;
}

TEST(WildScenes, MendingDeepOverlapsThrowsNoJointAbout) {
    for (std::uint64_t seed = 0; seed < 8; ++seed)
        expect_sane(overlapping_spiders(seed, surface(0.6), true), 0.3, 300, seed);
}

/// Ticks of 5 ms in which limbs turn by more than a radian: explicit centrifugal and gyroscopic forces would
/// add energy to them without end.
TEST(WildScenes, LimbsThatTurnFarInATickDoNotRunAway) {
    for (const std::uint64_t seed : {10u, 25u}) {  // not finite without
        Random random(seed + 1000);
        SurfaceSpec s =
            surface(random.uniform(0, 1.2), random.uniform(0, 1) < 0.3 ? random.uniform(0, 1) : 0.0);
        if (random.uniform(0, 1) < 0.5) {
            s.stiffness = std::pow(10.0, random.uniform(2, 10));
            s.damping = std::pow(10.0, random.uniform(-1, 4));
        }
        World world = overlapping_spiders(seed, s, random.uniform(0, 1) < 0.5);
        world.dt_s = random.uniform(0, 1) < 0.5 ? 1e-3 : 5e-3;
        world.accuracy.push_back(random_corner(seed));
        Simulation sim(world);
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d) {
                const double pick = random.uniform(0, 1);
                const MotorMode mode = pick < 0.3   ? MotorMode::kPassive
                                       : pick < 0.6 ? MotorMode::kPosition
                                                    : MotorMode::kVelocity;
                sim.set_motor(r, d, mode, random.uniform(-3, 3));
            }
        for (int i = 0; i < 200; ++i) {
            sim.step();
            ASSERT_FALSE(sim.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
            for (const RobotState& state : sim.states)
                for (const double v : state.v)
                    ASSERT_LT(std::fabs(v), 1e5) << "seed " << seed << ", tick " << i;
        }
    }
}

TEST(WildScenes, SoftContactsThatStartDeepShootNothingAway) {
    SurfaceSpec soft = surface(0.6);
    soft.stiffness = 1e8, soft.damping = 100;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed);
        World world = empty_world(1e-3);
        place(world, ground(soft), "ground");
        for (int i = 0; i < 6; ++i)
            place(world, solid_box(1.0, {0.3, 0.2, 0.2}, soft), "box_" + std::to_string(i),
                  {{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0, 0.2)},
                   random.rotation()});
        expect_sane(world, 0.2, 300, seed);
    }
}

TEST(WildScenes, ServoWithoutAnyBoundApproachesAtTenRadiansASecond) {
    World world = empty_world(1e-3, {});
    place(world, pendulum(), "pendulum");
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kPosition, 1.0);
    sim.step();
    EXPECT_NEAR(sim.states[0].v[0], 10, 1e-4);
    sim.run(0.2);
    EXPECT_NEAR(sim.states[0].q[7], 1.0, 1e-6);
    EXPECT_NEAR(sim.states[0].v[0], 0, 1e-6);
}

}  // namespace
}  // namespace roboss::test
