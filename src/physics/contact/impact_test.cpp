// Impacts: bounce heights, exchanged momentum, fast bodies against thin walls.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

/// Heights of the first peaks of a ball dropped from 1 m.
std::vector<double> peaks(double restitution, double dt_s, std::size_t count) {
    World world = empty_world(dt_s);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_sphere(1.0, 0.05, surface(0.5, restitution)), "ball", {{0, 0, 1.05}, {}});
    Simulation sim(world);
    std::vector<double> heights;
    double peak = 0;
    bool rising = false;
    for (int i = 0; i < 20000 && heights.size() < count; ++i) {
        sim.step();
        if (sim.states[0].v[5] > 0) {
            rising = true;
            peak = std::fmax(peak, sim.states[0].q[2] - 0.05);
        } else if (rising) {
            heights.push_back(peak);
            rising = false;
            peak = 0;
        }
    }
    return heights;
}

TEST(Impact, BallBouncesToTheRightHeights) {
    for (const double restitution : {0.5, 0.9}) {
        const std::vector<double> heights = peaks(restitution, 1e-3, 4);
        ASSERT_EQ(heights.size(), 4u);
        double expected = 1;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            expected *= restitution * restitution;
            tell("restitution " + std::to_string(restitution) + ", peak " + std::to_string(i + 1) +
                     ", relative error",
                 heights[i] / expected - 1);
            EXPECT_NEAR(heights[i] / expected, 1, 5e-3);
        }
    }
}

TEST(Impact, BallThatFeelsNoGravityBouncesByItsRestitutionAlone) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    ModelSpec ball = solid_sphere(1.0, 0.05, surface(0.5, 0.5));
    ball.links[0].gravity = false;
    place(world, ball, "ball", {{0, 0, 0.35}, {}});
    Simulation sim(world);
    sim.states[0].v[5] = -1;
    sim.run(0.5);
    EXPECT_NEAR(sim.states[0].v[5], 0.5, 1e-5);
}

/// Of two surfaces the larger restitution counts, and the larger threshold.
TEST(Impact, BallBouncesOnlyWhenItHitsFasterThanTheThreshold) {
    for (const bool on_the_ball : {true, false})
        for (const double speed : {0.29, 0.31}) {
            SurfaceSpec lively = surface(0.5, 0.5), dull = surface(0.5, 0.2);
            lively.bounce_threshold = 0.1, dull.bounce_threshold = 0.3;
            World world = empty_world(1e-3, {});
            place(world, ground(on_the_ball ? dull : lively), "ground");
            place(world, solid_sphere(1.0, 0.05, on_the_ball ? lively : dull), "ball", {{0, 0, 0.06}, {}});
            Simulation sim(world);
            sim.states[0].v[5] = -speed;
            sim.run(0.2);
            EXPECT_NEAR(sim.states[0].v[5], speed > 0.3 ? 0.5 * speed : 0, 1e-5) << speed << " m/s";
        }
}

TEST(Impact, BallWithoutRestitutionStaysDown) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_sphere(1.0, 0.05, surface(0.5)), "ball", {{0, 0, 1.05}, {}});
    Simulation sim(world);
    sim.run(0.44);
    for (int i = 0; i < 1000; ++i) {
        sim.step();
        if (sim.time() > 0.46) {
            ASSERT_LT(sim.states[0].q[2], 0.05 + 1e-5);
        }
    }
    EXPECT_GT(sim.states[0].q[2], 0.05 - 2e-5);
}

TEST(Impact, ElasticSpheresExchangeTheirVelocities) {
    World world = empty_world(1e-3, {});
    place(world, solid_sphere(1.0, 0.1, surface(0.5, 1.0)), "a");
    place(world, solid_sphere(1.0, 0.1, surface(0.5, 1.0)), "b", {{0.5, 0, 0}, {}});
    Simulation sim(world);
    sim.states[0].v[3] = 2;
    sim.run(0.5);
    EXPECT_NEAR(sim.states[0].v[3], 0, 1e-5);
    EXPECT_NEAR(sim.states[1].v[3], 2, 1e-5);
}

struct CollisionErrors {
    double linear = 0, angular = 0;  // N s; relative
    double energy_kept = 0;
};

CollisionErrors collide_boxes(double dt_s) {
    World world = empty_world(dt_s, {});
    place(world, solid_box(1.0, {0.2, 0.3, 0.4}, surface(0.5, 0.3)), "a", {{}, from_rpy(0.3, 0.5, 0.2)});
    place(world, solid_box(2.5, {0.3, 0.2, 0.2}, surface(0.5, 0.3)), "b",
          {{0.8, 0.08, -0.05}, from_rpy(1, 0.2, 0.7)});
    Simulation sim(world);
    sim.states[0].v = {1, 2, -1, 2, 0.2, 0};
    sim.states[1].v = {-1, 0.5, 2, -1, 0, 0.1};
    const double energy = sim.energy();
    const Momentum before = sim.momentum();
    sim.run(1.0);
    const Momentum after = sim.momentum();
    return {norm(after.linear - before.linear), norm(after.angular - before.angular) / norm(before.angular),
            sim.energy() / energy};
}

TEST(Impact, CollisionOfTumblingBoxesKeepsMomentumAndLosesEnergy) {
    const CollisionErrors coarse = collide_boxes(1e-3), fine = collide_boxes(1e-4);
    tell("linear momentum error at 1 ms, N s", coarse.linear);
    tell("relative angular momentum error at 1 ms", coarse.angular);
    tell("relative angular momentum error at 0.1 ms", fine.angular);
    tell("energy kept", coarse.energy_kept);
    EXPECT_LT(coarse.linear, 1e-12);
    EXPECT_LT(coarse.angular, 1e-11);
    EXPECT_LT(fine.angular, 1e-11);
    EXPECT_LT(coarse.energy_kept, 0.5) << "they meet head on";
    EXPECT_NEAR(fine.energy_kept, coarse.energy_kept, 0.02);
}

TEST(Impact, FastSmallBallDoesNotPassAThinWall) {
    for (const double restitution : {0.0, 0.5}) {
        World world = empty_world(2e-3, {});
        place(world, scenery(box_shape({0.01, 2, 2}, surface(0.5))), "wall", {{1.0, 0, 0}, {}});
        place(world, solid_sphere(0.01, 0.01, surface(0.5, restitution)), "ball", {{0, 0.03, 0.01}, {}});
        for (const double speed : {5.0, 30.0, 200.0}) {
            Simulation sim(world);
            sim.states[0].v[3] = speed;
            for (int i = 0; i < 300; ++i) {
                sim.step();
                ASSERT_LT(sim.states[0].q[0], 0.995 - 0.01 + 1e-4) << speed << " m/s";
            }
            EXPECT_NEAR(sim.states[0].v[3], -restitution * speed, 1e-4 * speed);
        }
    }
}

TEST(Impact, FastBallPushesAThinFreePlateInsteadOfPassingIt) {
    World world = empty_world(2e-3, {});
    place(world, solid_box(1.0, {0.01, 1, 1}, surface(0.5)), "plate", {{1.0, 0, 0}, {}});
    place(world, solid_sphere(0.1, 0.01, surface(0.5)), "ball");
    Simulation sim(world);
    sim.states[1].v[3] = 100;
    for (int i = 0; i < 100; ++i) {
        sim.step();
        ASSERT_LT(sim.states[1].q[0], sim.states[0].q[0]);
    }
    EXPECT_NEAR(sim.states[0].v[3], 0.1 * 100 / 1.1, 1e-3);
    EXPECT_NEAR(sim.states[1].v[3], 0.1 * 100 / 1.1, 1e-3);
}

}  // namespace
}  // namespace roboss::test
