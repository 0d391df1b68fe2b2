// What is fast, small or thin does not pass through others: shots head-on, at edges, off one wall onto
// another, and blades on joints. And what clear edges along the way do to it: nothing.
#include <gtest/gtest.h>

#include <support/meshes.h>
#include <support/robots.h>
#include <support/scenes.h>

namespace roboss::test {
namespace {

constexpr double kTick = 2e-3;

Vec3 place_of(const RobotState& s) {
    return {s.q[0], s.q[1], s.q[2]};
}

TEST(FastBodies, BallsThatMeetHeadOnAtAHundredMetresASecondDoNotPassEachOther) {
    for (int seed = 0; seed < 200; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        World world = empty_world(kTick, {});
        const Vec3 aside{0, random.uniform(-0.015, 0.015), random.uniform(-0.01, 0.01)};
        const ModelSpec ball = solid_sphere(0.01, 0.01, surface(0.5, random.uniform(0, 1)));
        place(world, ball, "a", {{-1 + random.uniform(0, 0.2), 0, 0}, {}});
        place(world, ball, "b", {Vec3{1, 0, 0} + aside, {}});
        Simulation sim(world);
        sim.states[0].v[3] = 100, sim.states[1].v[3] = -100;
        for (int i = 0; i < 20; ++i) {
            sim.step();
            // They may go round each other, pushed aside, but not through: at least a diameter apart.
            const double apart = norm(place_of(sim.states[1]) - place_of(sim.states[0]));
            ASSERT_GT(apart, 0.02 - 5e-4) << "seed " << seed;
        }
        if (norm(aside) < 0.019) {
            EXPECT_LT(sim.states[0].v[3], 99.0) << "seed " << seed << ": it was felt";
        }
    }
}

TEST(FastBodies, AGolfBallBouncesOffTheEdgeOfASmallRobot) {
    constexpr double kBall = 0.0213, kHalf = 0.0375;
    for (int seed = 0; seed < 200; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        World world = empty_world(kTick);
        place(world, ground(surface(0.5)), "ground");
        place(world, solid_box(0.65, {0.075, 0.075, 0.075}, surface(0.3)), "robot",
              {{0, 0, kHalf}, from_rpy(0, 0, 0.25 * kPi + random.uniform(-0.3, 0.3))});
        place(world, solid_sphere(0.046, kBall, surface(0.3, 0.5)), "ball",
              {{-0.3, random.uniform(-0.07, 0.07), kBall}, {}});
        Simulation sim(world);
        RobotState& ball = sim.states[1];
        ball.v[3] = 5, ball.v[1] = 5 / kBall;
        for (int i = 0; i < 100; ++i) {
            sim.step();
            const Pose robot = base_pose(sim.states[0]);
            const Vec3 at = rotate(conjugate(robot.q), place_of(ball) - robot.p);
            const Vec3 nearest{std::clamp(at.x, -kHalf, kHalf), std::clamp(at.y, -kHalf, kHalf),
                               std::clamp(at.z, -kHalf, kHalf)};
            ASSERT_GT(norm(at - nearest), kBall - 5e-4) << "seed " << seed << ", tick " << i;
        }
    }
}

/// A blade of a metre on a fixed hub, and a post in its circle.
TEST(FastBodies, ASpinningBladeStopsAtAPostHoweverFast) {
    for (const double rate : {20.0, 100.0, 300.0})
        for (const bool is_mesh : {false, true}) {
            World world = empty_world(kTick, {});
            LinkSpec blade = link("blade", 1.0, box_inertia(1.0, {1, 0.05, 0.01}));
            blade.collisions.push_back(box_shape({1, 0.05, 0.01}, surface(0.3)));
            ModelSpec m = one_link(blade);
            m.joints.push_back(joint(JointSpecKind::kContinuous, "hub", "world", "blade", {}, {0, 0, 1}));
            place(world, m, "blade");
            const Vec3 size{0.02, 0.02, 0.3};
            place(world,
                  scenery(is_mesh ? mesh_shape(box_mesh(size), surface(0.3)) : box_shape(size, surface(0.3))),
                  "post", {{0, 0.4, 0}, {}});
            Simulation sim(world);
            sim.states[0].v.back() = rate;
            for (int i = 0; i < 200; ++i) {
                sim.step();
                const double angle = sim.states[0].q.back();
                ASSERT_LT(angle, 0.5 * kPi) << rate << " rad/s, tick " << i;
            }
            EXPECT_GT(sim.states[0].q.back(), 1.3) << "it came to the post";
        }
}

TEST(FastBodies, ABallBouncesOffAWallOntoAThinWallWithinOneTick) {
    for (int seed = 0; seed < 200; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const double restitution = random.uniform(0.3, 1), speed = random.uniform(20, 100);
        for (const bool is_mesh : {false, true}) {
            World world = empty_world(kTick, {});
            // A slope that turns +x into +y, and above it a wall of 5 mm across y.
            place(world, scenery(box_shape({1, 0.1, 1}, surface(0.1, restitution))), "slope",
                  {{0, 0, 0}, from_rpy(0, 0, 0.25 * kPi)});
            const double height = random.uniform(0.2, 0.35);
            const Vec3 size{4, 0.005, 4};
            place(world,
                  scenery(is_mesh ? mesh_shape(box_mesh(size), surface(0.1, restitution))
                                  : box_shape(size, surface(0.1, restitution))),
                  "wall", {{0, height, 0}, {}});
            place(world, solid_sphere(0.01, 0.01, surface(0.1, restitution)), "ball",
                  {{-1 - random.uniform(0, 0.2), random.uniform(-0.1, 0.1), 0}, {}});
            Simulation sim(world);
            sim.states[0].v[3] = speed;
            for (int i = 0; i < 50; ++i) {
                sim.step();
                if (std::fabs(sim.states[0].q[0]) > 1.5) break;
                ASSERT_LT(sim.states[0].q[1], height - 0.0025 - 0.01 + 2e-3)
                    << "seed " << seed << ", mesh " << is_mesh << ", tick " << i;
            }
        }
    }
}

TEST(FastBodies, ABallStruckBeforeAThinWallDoesNotGoThroughIt) {
    for (int seed = 0; seed < 100; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        for (const bool is_mesh : {false, true}) {
            World world = empty_world(kTick, {});
            const Vec3 size{0.005, 1, 1};
            place(world,
                  scenery(is_mesh ? mesh_shape(box_mesh(size), surface(0.5, 0.5))
                                  : box_shape(size, surface(0.5, 0.5))),
                  "wall", {{0, 0, 0}, {}});
            const double gap = random.uniform(0.006, 0.05);
            place(world, solid_sphere(0.05, 0.02, surface(0.5, 0.5)), "ball", {{-0.0225 - gap, 0, 0}, {}});
            place(world, solid_box(2, {0.1, 0.2, 0.2}, surface(0.5)), "bat",
                  {{-0.8 + random.uniform(0, 0.05), random.uniform(-0.05, 0.05), 0}, {}});
            Simulation sim(world);
            sim.states[1].v[3] = random.uniform(5, 60);
            for (int i = 0; i < 150; ++i) {
                sim.step();
                if (std::fabs(sim.states[0].q[1]) > 0.4 || std::fabs(sim.states[0].q[2]) > 0.4) break;
                ASSERT_LT(sim.states[0].q[0], 0) << "seed " << seed << ", mesh " << is_mesh << ", tick " << i;
            }
        }
    }
}

/// A bat throws one ball onto another that rests before the wall, all in one tick: nothing touches the second
/// ball before the velocities are solved. A few are squeezed into the wall between bat and ball.
TEST(FastBodies, ABallStruckByOneThatIsStruckDoesNotGoThroughAThinWall) {
    constexpr int kSeeds = 400;
    constexpr double kBallRadius = 0.02, kShortTick = 1e-3;  // m, s
    int through = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        World world = empty_world(kShortTick, {});
        place(world, scenery(box_shape({0.005, 4, 4}, surface(0.3, 0.5))), "wall", {{0, 0, 0}, {}});
        const double resting = -0.0025 - kBallRadius - random.uniform(0.006, 0.03);
        place(world, solid_sphere(0.02, kBallRadius, surface(0.3, 0.5)), "resting", {{resting, 0, 0}, {}});
        const double gap = random.uniform(0.004, 0.02), aside = random.uniform(8, 20),
                     y = random.uniform(-0.03, 0.01), flying = resting - 2 * kBallRadius - gap;
        place(world, solid_sphere(0.05, kBallRadius, surface(0.0, 0.5)), "flying", {{flying, y, 0}, {}});
        const double speed = random.uniform(20, 80), way = random.uniform(0.0005, 0.5) * speed * kShortTick;
        place(world, solid_box(2, {0.1, 0.3, 0.3}, surface(0.0)), "bat",
              {{flying - kBallRadius - 0.05 - way, 0, 0}, {}});
        Simulation sim(world);
        sim.states[1].v[4] = aside, sim.states[2].v[3] = speed;
        for (int i = 0; i < 30; ++i) {
            sim.step();
            if (sim.states[0].q[0] <= -0.002) continue;
            ++through;
            break;
        }
    }
    tell("balls in or behind the wall", through);
    EXPECT_LE(through, kSeeds / 80);
}

TEST(FastBodies, AClearEdgeBesideTheWayToAWallChangesNoBit) {
    for (int seed = 0; seed < 50; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const double speed = random.uniform(15, 60), clear = random.uniform(0.002, 0.01);
        const auto make = [&](bool with_edge) {
            World world = empty_world(kTick);
            place(world, ground(surface(0.5)), "ground");
            place(world, scenery(box_shape({0.1, 1, 1}, surface(0.5, 0.5))), "wall", {{1.55, 0, 0.5}, {}});
            if (with_edge)
                place(world, scenery(box_shape({0.2, 0.2, 0.2}, surface(0.5))), "edge",
                      {{1.2, 0.02 + clear + 0.1 * std::sqrt(2.0), 0.1}, from_rpy(0, 0, 0.25 * kPi)});
            place(world, solid_sphere(0.1, 0.02, surface(0.5, 0.5)), "ball", {{0, 0, 0.02}, {}});
            return world;
        };
        Simulation with(make(true)), without(make(false));
        for (Simulation* sim : {&with, &without})
            sim->states[0].v[3] = speed, sim->states[0].v[1] = speed / 0.02;
        for (int i = 0; i < 60; ++i) {
            with.step(), without.step();
            ASSERT_EQ(with.states[0].q, without.states[0].q) << "seed " << seed << ", tick " << i;
            ASSERT_EQ(with.states[0].v, without.states[0].v) << "seed " << seed << ", tick " << i;
        }
        EXPECT_LT(with.states[0].v[3], 0) << "it came to the wall";
    }
}

TEST(FastBodies, RobotsMetresApartAtThousandsOfMetresASecondDoNotPushEachOther) {
    for (int seed = 0; seed < 100; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        World world = empty_world(kTick, {});
        for (int r = 0; r < 6; ++r)
            place(world, solid_box(1, {0.3, 0.2, 0.1}, surface(0.5)), "robot_" + std::to_string(r),
                  {{random.uniform(-20, 20), 14.0 * r, 0}, random.rotation()});
        Simulation sim(world);
        for (RobotState& s : sim.states)
            s.v[3] = random.uniform(-1, 1) * 7000, s.v[4] = random.uniform(-500, 500);
        const std::vector<RobotState> start = sim.states;
        sim.step();
        for (std::size_t r = 0; r < start.size(); ++r)
            ASSERT_EQ(sim.states[r].v, start[r].v) << "seed " << seed << ", robot " << r;
    }
}

/// Faster than the crowds of invariance_test.cpp: near misses, deferred impacts and second looks occur.
TEST(FastBodies, GroupingChangesNoBitOfFastCrowds) {
    GroupedStepper stepper;
    for (const Precision precision : {Precision::kDouble, Precision::kFloat})
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            World world = random_crowd(seed, 3 + static_cast<int>(seed % 6));
            world.precision = precision;
            place(world, scenery(mesh_shape(box_mesh({0.02, 3, 1}), surface(0.5))), "sheet",
                  {{-1, 0, 0.5}, {}});
            Simulation whole(world), grouped(world);
            for (Simulation* sim : {&whole, &grouped}) {
                stir(*sim, seed);
                const double times = seed % 2 == 0 ? 10 : 40;
                for (RobotState& s : sim->states)
                    for (std::size_t i = 0; i < 6; ++i) s.v[i] *= times;
            }
            for (int i = 0; i < 30; ++i) {
                whole.step();
                stepper.step(grouped);
                ASSERT_EQ(whole.hash(), grouped.hash()) << "seed " << seed << ", tick " << i;
                ASSERT_FALSE(whole.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
            }
        }
}

}  // namespace
}  // namespace roboss::test
