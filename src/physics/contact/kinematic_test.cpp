// Kinematic bodies (actors): they are where their timetable says, and push what they meet.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

/// Through these places, one after the other in these times.
ModelSpec actor(CollisionSpec body, const std::vector<std::pair<double, Pose>>& waypoints, bool loop = false,
                double delay_s = 0) {
    LinkSpec l;
    l.name = "link";
    l.collisions.push_back(std::move(body));
    ModelSpec m = one_link(l);
    m.kinematic = true;
    m.joints.push_back(joint(JointSpecKind{}, "weld", "world", "link", {}));
    ActorSpec spec;
    spec.loop = loop, spec.delay_start = delay_s;
    for (const auto& [time, pose] : waypoints) {
        ActorWaypoint point;
        point.time = time, point.pose = pose;
        spec.waypoints.push_back(point);
    }
    m.onboard.push_back({"actor", spec, {}});
    return m;
}

/// Gazebo's curve between two points: it starts and ends at half of the mean speed.
double eased(double u) {
    return u * (0.5 + u * (1.5 - u));
}

TEST(Kinematic, AnActorIsWhereItsTimetableSays) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        const Quat turned = from_rpy(0, 0, 1);
        place(world, actor(sphere_shape(0.1, surface(0.5)), {{1, {{0, 0, 0}, {}}}, {3, {{2, 1, 0}, turned}}}),
              "actor", {{5, 0, 1}, from_rpy(0, 0, kPi / 2)});
        Simulation sim(world);
        for (int i = 0; i < 25; ++i) {
            sim.run(0.1);
            const double u = std::min(sim.time() / 2, 1.0);  // times count from the first waypoint
            const Pose X = base_pose(sim.states[0]);
            EXPECT_NEAR(X.p.x, 5 - eased(u), 1e-9) << sim.time();
            EXPECT_NEAR(X.p.y, 2 * eased(u), 1e-9);
            EXPECT_NEAR(X.p.z, 1, 1e-12);
        }
        EXPECT_NEAR(logarithm(base_pose(sim.states[0]).q).z, kPi / 2 + 1, 1e-9);
        EXPECT_TRUE(sim.states[0].surfaces.empty()) << "it stands at the end";
    }
}

TEST(Kinematic, WhatStandsInItsWayIsPushedAlong) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        world.sleep = true;
        place(world, ground(surface(0.6)), "ground");
        place(world, actor(box_shape({0.1, 1, 1}, surface(0.2)), {{0, {}}, {4, {{2, 0, 0}, {}}}}, false, 1.5),
              "actor", {{0, 0, 0.5}, {}});
        place(world, solid_box(3, {0.2, 0.2, 0.2}, surface(0.6)), "box", {{0.5, 0, 0.1}, {}});
        Simulation sim(world);
        sim.run(1.4);
        EXPECT_TRUE(sim.states[1].rest.asleep);
        double deepest = 0;
        while (sim.time() < 6) {
            sim.step();
            deepest = std::min(deepest, sim.states[1].q[0] - sim.states[0].q[0] - 0.15);
        }
        tell("deepest overlap with what it pushes, m", deepest);
        EXPECT_GT(deepest, -2e-4);
        EXPECT_NEAR(sim.states[0].q[0], 2, 1e-9) << "nothing stops it";
        EXPECT_GT(sim.states[1].q[0], 2.15 - 1e-3);
        EXPECT_LT(sim.states[1].q[0], 2.35);
        EXPECT_NEAR(sim.states[1].q[2], 0.1, 1e-3);
    }
}

/// A platform that goes up and sideways and turns, with a box off its centre.
TEST(Kinematic, WhatStandsOnItIsCarried) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        place(
            world,
            actor(box_shape({2, 2, 0.2}, surface(0.8)),
                  {{0, {}}, {4, {{1, 0.5, 1.5}, from_rpy(0, 0, 1)}}, {8, {{2, 0, 0.5}, from_rpy(0, 0, 2)}}}),
            "platform");
        place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.8)), "box", {{0.4, 0, 0.2}, {}});
        Simulation sim(world);
        sim.run(0.2);
        const auto relative = [&] { return inverse(base_pose(sim.states[0])) * base_pose(sim.states[1]); };
        const Pose start = relative();
        sim.run(8.5);
        const Pose end = relative();
        tell("slip on the platform, m", norm(end.p - start.p));
        EXPECT_LT(norm(end.p - start.p), 2e-3);
        EXPECT_LT(norm(logarithm(conjugate(start.q) * end.q)), 2e-3);
    }
}

TEST(Kinematic, AFastOneDoesNotPassThroughWhatItHits) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s, {0, 0, 0});
        place(world, actor(box_shape({0.02, 1, 1}, surface(0)), {{0, {}}, {1, {{20, 0, 0}, {}}}}), "racket",
              {{-10, 0, 0}, {}});
        place(world, solid_sphere(0.1, 0.03, surface(0, 0.5)), "ball");
        Simulation sim(world);
        sim.run(1.2);
        const double hit = 27.5 * 1.0;  // near the middle it is at its fastest: 20 m/s * (0.5 + 3 u - 3 u^2)
        tell("speed of the ball, m/s", sim.states[1].v[3]);
        EXPECT_NEAR(sim.states[1].v[3], 1.5 * 20 * 1.25, 1.5);
        EXPECT_GT(sim.states[1].v[3], hit);
        EXPECT_NEAR(sim.states[1].v[4], 0, 1e-6);
    }
}

/// A VelocityControl moves it; it does not feel the box that it pushes over a rough floor.
TEST(Kinematic, OneWithAVelocityControlGoesAsItIsTold) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    ModelSpec plough = actor(box_shape({0.1, 1, 0.4}, surface(0.2)), {});
    plough.onboard.clear();
    VelocityControlSpec control;
    control.initial_linear = {0.5, 0, 0};
    plough.onboard.push_back({"control", control, {}});
    place(world, plough, "plough", {{0, 0, 0.2}, from_rpy(0, 0, kPi / 2)});
    place(world, solid_box(50, {0.2, 0.2, 0.2}, surface(0.6)), "box", {{0, 0.5, 0.1}, {}});
    Simulation sim(world);
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[1], 1.5, 1e-9) << "along its own x axis";
    EXPECT_NEAR(sim.states[1].q[1], 1.65, 1e-3);
    EXPECT_NEAR(sim.states[1].v[4], 0.5, 1e-6);
    const Order stop{sim.tick, ClientId(0u), 1, RobotId(std::size_t{0}), Command{0, {0, 0, 0, 0, 0, 0}}};
    sim.step(std::span(&stop, 1));
    sim.run(1);
    EXPECT_NEAR(sim.states[0].q[1], 1.5, 1e-9);
    EXPECT_NEAR(sim.states[1].v[4], 0, 1e-9);
}

/// Actors that go round in a crowd: some start late, one jumps back to its start.
World crowd_with_actors(std::uint64_t seed) {
    World world = random_crowd(seed, 12);
    world.sleep = true;
    const Quat q = from_rpy(0, 0, 2);
    place(world,
          actor(cylinder_shape(0.1, 0.8, surface(0.3)),
                {{0, {{-1, -1, 0}, {}}}, {0.5, {{0, 0, 0}, q}}, {1, {{-1, -1, 0}, {}}}}, true, 0.2),
          "walker", {{0, 0, 0.4}, {}});
    place(world,
          actor(box_shape({0.3, 0.2, 0.4}, surface(0.3)), {{0, {{1, 1, 0}, {}}}, {0.4, {{-0.5, 0, 0}, q}}},
                true, 0.1),
          "jumper", {{0, 0, 0.2}, {}});
    return world;
}

TEST(Kinematic, GroupingAndLanesChangeNoBit) {
    for (const std::uint64_t seed : {3u, 4u}) {
        const World world = crowd_with_actors(seed);
        Simulation together(world), grouped(world), alone(world);
        alone.scratch.use_lanes(1);
        GroupedStepper stepper;
        std::size_t islands = 0;
        int contacts = 0;
        for (int i = 0; i < 1000; ++i) {
            contacts += together.step().contacts;
            alone.step();
            islands = std::max(islands, stepper.step(grouped));
            ASSERT_EQ(together.hash(), alone.hash()) << "lanes, tick " << i;
            ASSERT_EQ(together.hash(), grouped.hash()) << "islands, tick " << i;
        }
        EXPECT_GT(islands, 2u);
        EXPECT_GT(contacts, 1000);
    }
}

}  // namespace
}  // namespace roboss::test
