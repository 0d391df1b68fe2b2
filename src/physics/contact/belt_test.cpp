// Belts, tracks and turntables: what lies on a surface in motion is carried as Coulomb's law says.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kEdge = 0.2, kTop = 0.5;

OnboardSpec surface_velocity(const std::string& link, const Vec3& linear, const Vec3& angular = {},
                             bool fixed = false) {
    SurfaceVelocitySpec spec;
    spec.link = LinkNames{link};
    spec.linear = linear, spec.angular = angular, spec.fixed = fixed;
    return {"surface_velocity", spec, {}};
}

/// A static box whose top is at kTop.
ModelSpec belt(const Vec3& linear, double mu, const Vec3& angular = {}, bool fixed = false) {
    ModelSpec m = scenery(box_shape({20, 2, 1}, surface(mu)));
    m.onboard.push_back(surface_velocity("link", linear, angular, fixed));
    return m;
}

void put_box(World& world, const std::string& name, const Vec3& p, double mu, double mass = 1) {
    place(world, solid_box(mass, {kEdge, kEdge, kEdge}, surface(mu)), name,
          {{p.x, p.y, p.z + kTop + 0.5 * kEdge}, {}});
}

std::size_t robot(const Simulation& sim, const std::string& name) {
    return sim.model->find_robot(name)->index();
}

Order command(const Simulation& sim, const std::string& name, std::vector<double> values,
              std::uint32_t channel = 0) {
    return {sim.tick, ClientId(0u), 1, RobotId(robot(sim, name)), Command{channel, std::move(values)}};
}

TEST(Belt, ABoxDroppedOnItSlipsAsFarAsFrictionSaysAndThenRides) {
    constexpr double kMu = 0.4, kSpeed = 1.5;
    for (const bool fixed : {false, true}) {
        for (const double dt_s : {1e-3, 4e-3}) {
            World world = empty_world(dt_s);
            place(world, belt({kSpeed, 0, 0}, kMu, {}, fixed), "belt");
            put_box(world, "box", {}, 1.0);
            Simulation sim(world);
            const RobotState& box = sim.states[robot(sim, "box")];
            const double slip = kSpeed * kSpeed / (2 * kMu * kG);
            sim.run(1);
            tell("slip against v^2 / (2 mu g)", (kSpeed * sim.time() - box.q[0]) / slip);
            EXPECT_NEAR((kSpeed * sim.time() - box.q[0]) / slip, 1, dt_s == 1e-3 ? 3e-3 : 2e-2);
            EXPECT_NEAR(box.v[3], kSpeed, 1e-9);
            const double x = box.q[0];
            sim.run(2);
            EXPECT_NEAR(box.q[0] - x, 2 * kSpeed, 1e-8) << "rides without slip";
            EXPECT_NEAR(box.q[1], 0, 1e-9);
            EXPECT_NEAR(box.q[2], kTop + 0.5 * kEdge, 1e-6);
            EXPECT_EQ(sim.model->robots.size(), fixed ? 1u : 2u) << "a belt without commands is scenery";
        }
    }
}

TEST(Belt, PressesABoxAgainstAWallWithItsFriction) {
    constexpr double kMu = 0.3, kMass = 2;
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        world.sleep = true;
        place(world, belt({1, 0, 0}, kMu), "belt");
        place(world, scenery(box_shape({0.1, 2, 2}, surface(0))), "wall", {{0.3, 0, kTop + 1}, {}});
        put_box(world, "box", {}, 1.0, kMass);
        Simulation sim(world);
        const std::size_t box = robot(sim, "box");
        sim.run(2);
        const double x = sim.states[box].q[0];
        sim.run(3);
        EXPECT_NEAR(sim.states[box].q[0], x, 1e-9) << "stands still";
        EXPECT_NEAR(x + 0.5 * kEdge, 0.25, 1e-4);
        EXPECT_FALSE(sim.states[box].rest.asleep);
        double force = 0;
        for (const ContactMemory& c : sim.states[box].contacts)
            if (sim.model->statics[c.other_shape].name.starts_with("wall")) force += c.impulse / dt_s;
        tell("force on the wall against mu m g", force / (kMu * kMass * kG));
        EXPECT_NEAR(force / (kMu * kMass * kG), 1, 1e-6);
    }
}

/// One belt along x and one along y under the same box, each under half of it: it moves along both.
TEST(Belt, TwoCrossingBeltsHandABoxOver) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        ModelSpec first = scenery(box_shape({4, 1, 1}, surface(0.6)));
        first.onboard.push_back(surface_velocity("link", {0.8, 0, 0}));
        ModelSpec second = scenery(box_shape({1, 8, 1}, surface(0.6)));
        second.onboard.push_back(surface_velocity("link", {0, 0.5, 0}));
        place(world, first, "first", {{-2, 0, 0}, {}});
        place(world, second, "second", {{0.5, 0, 0}, {}});
        put_box(world, "box", {-1.5, 0, 0}, 1.0);
        Simulation sim(world);
        const RobotState& box = sim.states[robot(sim, "box")];
        sim.run(1.2);
        EXPECT_NEAR(box.v[3], 0.8, 1e-6) << "on the first";
        sim.run(3.8);
        EXPECT_NEAR(box.v[3], 0, 1e-6) << "on the second";
        EXPECT_NEAR(box.v[4], 0.5, 1e-6);
        EXPECT_GT(box.q[1], 0.5);
    }
}

TEST(Belt, ATurntableCarriesWhatFrictionCanHoldOnItsCircle) {
    constexpr double kMu = 0.5, kRadius = 0.6;
    for (const double dt_s : {1e-3, 4e-3}) {
        for (const double omega : {1.5, 2.5}) {  // holds up to sqrt(mu g / r) = 2.86 rad/s
            World world = empty_world(dt_s);
            place(world, belt({}, kMu, {0, 0, omega}), "table");
            put_box(world, "box", {kRadius, 0, 0}, 1.0);
            Simulation sim(world);
            RobotState& box = sim.states[robot(sim, "box")];
            box.v = {0, 0, omega, 0, omega * kRadius, 0};
            sim.run(10);
            const double r = std::hypot(box.q[0], box.q[1]);
            tell("radius after 10 s on the turntable", r);
            EXPECT_NEAR(r, kRadius, 2e-3);
            EXPECT_NEAR(box.v[2], omega, 1e-4);
            EXPECT_NEAR(std::hypot(box.v[3], box.v[4]), omega * kRadius, 5e-3 * omega * kRadius);
        }
        World world = empty_world(dt_s);
        place(world, belt({}, kMu, {0, 0, 3.3}), "table");
        put_box(world, "box", {kRadius, 0, 0}, 1.0);
        Simulation sim(world);
        RobotState& box = sim.states[robot(sim, "box")];
        box.v = {0, 0, 3.3, 0, 3.3 * kRadius, 0};
        sim.run(2);
        EXPECT_GT(std::hypot(box.q[0], box.q[1]), 1.0) << "slides off";
    }
}

/// On a smooth plane: friction between the two is all that pushes them.
TEST(Belt, OnARobotThatIsFreeToMoveItKeepsTheMomentum) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        place(world, ground(surface(0)), "ground");
        ModelSpec cart = solid_box(4, {2, 0.6, 0.5}, surface(0.5));
        cart.onboard.push_back(surface_velocity("box", {1, 0, 0}));
        cart.name = "cart";
        place(world, cart, "cart", {{0, 0, 0.25}, {}});
        put_box(world, "box", {-0.6, 0, 0}, 0.5);
        Simulation sim(world);
        const RobotState &on = sim.states[robot(sim, "box")], &below = sim.states[robot(sim, "cart")];
        sim.run(1);
        EXPECT_NEAR(on.v[3] - below.v[3], 1, 1e-6) << "rides at the belt's speed";
        EXPECT_NEAR(on.v[3] + 4 * below.v[3], 0, 1e-8) << "momentum";
        EXPECT_NEAR(on.v[3], 0.8, 1e-6);
        EXPECT_NEAR(below.v[3], -0.2, 1e-6);
    }
}

/// A body with a track on each side, of which the surfaces run about the y axis.
ModelSpec tracked_vehicle() {
    ModelSpec m;
    m.name = m.canonical_link = "body";
    m.links.push_back(link("body", 10, box_inertia(10, {0.5, 0.3, 0.2}), {{0, 0, 0.25}, {}}));
    for (const double y : {0.25, -0.25}) {
        LinkSpec track =
            link(y > 0 ? "left" : "right", 3, box_inertia(3, {0.8, 0.1, 0.2}), {{0, y, 0.1}, {}});
        track.collisions.push_back(box_shape({0.8, 0.1, 0.2}, surface(0.8)));
        m.joints.push_back(joint(JointSpecKind{}, track.name + "_weld", "body", track.name, track.X_ML));
        TrackControllerSpec spec;
        spec.link = LinkNames{track.name};
        spec.max_acceleration = 2, spec.min_acceleration = -2;
        m.onboard.push_back({track.name, spec, {}});
        m.links.push_back(std::move(track));
    }
    return m;
}

TEST(Belt, ATrackedVehicleDrivesAsFastAsItsTracksRun) {
    for (const double dt_s : {1e-3, 4e-3}) {
        World world = empty_world(dt_s);
        place(world, ground(surface(1)), "ground");
        place(world, tracked_vehicle(), "vehicle");
        Simulation sim(world);
        const RobotState& vehicle = sim.states[0];
        sim.run(0.2);
        EXPECT_NEAR(vehicle.v[3], 0, 1e-9);
        const Order go[] = {command(sim, "vehicle", {0.6}, 0), command(sim, "vehicle", {0.6}, 2)};
        sim.step(go);
        sim.run(1);
        EXPECT_NEAR(vehicle.v[3], 0.6, 1e-6);
        EXPECT_NEAR(vehicle.v[2], 0, 1e-6);
        EXPECT_NEAR(vehicle.q[0], 0.6 * (1 + dt_s) - 0.5 * 0.6 * 0.6 / 2, 1e-3) << "at its limit";
        const Order turn[] = {command(sim, "vehicle", {-0.4}, 0), command(sim, "vehicle", {0.4}, 2)};
        sim.step(turn);
        sim.run(3);
        EXPECT_GT(vehicle.v[2], 0.2) << "turns to the left";
        EXPECT_NEAR(vehicle.q[1], 0, 0.05) << "on the spot";
        EXPECT_NEAR(vehicle.q[2], 0.25, 1e-4);
    }
}

TEST(Belt, ATrackWithACentreOfRotationTurnsAboutIt) {
    World world = empty_world(1e-3);
    place(world, ground(surface(1)), "ground");
    place(world, tracked_vehicle(), "vehicle");
    Simulation sim(world);
    const RobotState& vehicle = sim.states[0];
    // About a point 1 m to the left: the tracks' corners are 0.85 and 1.31 m from it.
    const Order go[] = {command(sim, "vehicle", {0.3}, 0), command(sim, "vehicle", {0, 1, 0}, 1),
                        command(sim, "vehicle", {0.5}, 2), command(sim, "vehicle", {0, 1, 0}, 3)};
    sim.step(go);
    sim.run(3);
    EXPECT_GT(vehicle.v[2], 0.3 / 0.85);
    EXPECT_LT(vehicle.v[2], 0.5 / 1.31);
    EXPECT_NEAR(std::hypot(vehicle.q[0], vehicle.q[1] - 1), 1, 0.02);
}

TEST(Belt, ACommandWakesWhatSleepsOnItAndLetsItSleepAgain) {
    World world = empty_world(2e-3);
    world.sleep = true;
    place(world, belt({}, 0.5), "belt");
    put_box(world, "box", {-3, 0, 0}, 1.0);
    put_box(world, "on top", {-3, 0, kEdge}, 1.0);
    Simulation sim(world);
    const RobotState &box = sim.states[robot(sim, "box")], &top = sim.states[robot(sim, "on top")];
    sim.run(2);
    ASSERT_TRUE(box.rest.asleep && top.rest.asleep);
    const Order go[] = {command(sim, "belt", {0.5, 0, 0, 0, 0, 0})};
    sim.step(go);
    EXPECT_FALSE(box.rest.asleep || top.rest.asleep);
    sim.run(4);
    EXPECT_FALSE(box.rest.asleep || top.rest.asleep) << "what rides is not at rest";
    EXPECT_NEAR(box.v[3], 0.5, 1e-6);
    EXPECT_NEAR(top.v[3], 0.5, 1e-6);
    const Order stop[] = {command(sim, "belt", {0, 0, 0, 0, 0, 0})};
    sim.step(stop);
    sim.run(3);
    EXPECT_TRUE(box.rest.asleep && top.rest.asleep);
    EXPECT_NEAR(box.v[3], 0, 0);
}

/// A belt slower than what counts as rest carries all the same.
TEST(Belt, ACreepingBeltCarriesWhatWouldOtherwiseSleep) {
    World world = empty_world(2e-3);
    world.sleep = true;
    place(world, belt({5e-4, 0, 0}, 0.5, {}, true), "belt");
    put_box(world, "box", {}, 1.0);
    Simulation sim(world);
    sim.run(10);
    EXPECT_NEAR(sim.states[0].q[0], 5e-3, 1e-6);
}

/// Boxes on several belts, cars, and a turntable.
World crowd_on_belts(std::uint64_t seed) {
    World world = random_crowd(seed, 14);
    world.sleep = true;
    ModelSpec first = scenery(box_shape({6, 0.8, 0.1}, surface(0.6)));
    first.onboard.push_back(surface_velocity("link", {0.7, 0, 0}));
    ModelSpec second = scenery(box_shape({0.8, 6, 0.1}, surface(0.6)));
    second.onboard.push_back(surface_velocity("link", {0, -0.5, 0}, {}, true));
    ModelSpec table = scenery(cylinder_shape(0.5, 0.1, surface(0.6)));
    table.onboard.push_back(surface_velocity("link", {}, {0, 0, 2}));
    place(world, first, "first belt", {{0, -0.6, 0.02}, {}});
    place(world, second, "second belt", {{-0.8, 0, 0.02}, {}});
    place(world, table, "turntable", {{0.3, 0.6, 0.02}, {}});
    place(world, tracked_vehicle(), "vehicle", {{-0.2, 2, 0.05}, {}});
    return world;
}

TEST(Belt, GroupingThreadsAndLanesChangeNoBit) {
    for (const std::uint64_t seed : {1u, 2u}) {
        const World world = crowd_on_belts(seed);
        Simulation together(world), grouped(world), alone(world);
        alone.scratch.use_lanes(1);
        GroupedStepper stepper;
        std::size_t islands = 0;
        for (Simulation* sim : {&together, &grouped, &alone})
            for (std::size_t r = 0; r < sim->states.size(); ++r)
                for (std::size_t d = 0; d < sim->states[r].motors.size(); ++d)
                    sim->set_motor(r, d, MotorMode::kVelocity, 3.0 * static_cast<double>(d % 3));
        for (int i = 0; i < 800; ++i) {
            std::vector<Order> orders;
            if (i == 300) {
                for (Simulation* sim : {&together, &grouped, &alone}) {
                    const RobotId id(robot(*sim, "vehicle"));
                    const Order go{sim->tick, ClientId(0u), 1, id, Command{0, {0.5}}};
                    apply_order(*sim->model, go, sim->states[id.index()]);
                }
            }
            together.step();
            alone.step();
            islands = std::max(islands, stepper.step(grouped));
            ASSERT_EQ(together.hash(), alone.hash()) << "lanes, tick " << i;
            ASSERT_EQ(together.hash(), grouped.hash()) << "islands, tick " << i;
        }
        EXPECT_GT(islands, 2u);
    }
}

}  // namespace
}  // namespace roboss::test
