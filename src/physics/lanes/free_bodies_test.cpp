// Free bodies that lie on scenery are stepped in lanes, with the bits of bodies by themselves.
#include <gtest/gtest.h>

#include <support/compare_lanes.h>
#include <support/meshes.h>

namespace roboss::test {
namespace {

/// Each kind of shape that is tried, about a tenth of a metre high.
ModelSpec body_of(int kind, const SurfaceSpec& s) {
    switch (kind) {
        case 0:
            return box_like(1.0, {0.12, 0.1, 0.1}, box_shape({0.12, 0.1, 0.1}, s));
        case 1:
            return ball_like(1.0, 0.05, sphere_shape(0.05, s));
        case 2:
            return box_like(1.0, {0.1, 0.1, 0.1}, cylinder_shape(0.05, 0.1, s));
        case 3:
            return box_like(1.0, {0.1, 0.1, 0.1}, mesh_shape(box_mesh({0.1, 0.1, 0.1}), s));
        default: {
            CollisionSpec capsule = cylinder_shape(0.05, 0.1, s);
            capsule.geometry.kind = GeometryKind::kCapsule;
            return box_like(1.0, {0.1, 0.1, 0.2}, capsule);
        }
    }
}

constexpr int kKinds = 5;

/// Some rest, some slide, some are dropped, some tip over their edges, some spin.
void stir_some(Simulation& sim) {
    if (sim.tick % 150 != 50) return;
    for (std::size_t r = 0; r < sim.states.size(); ++r) {
        RobotState& s = sim.states[r];
        const double x = static_cast<double>(r + 1);
        if (r % 5 == 1) s.v[3] = 0.1 * x;
        if (r % 5 == 2) s.v[4] = 0.3, s.v[2] = 0.2 * x;
        if (r % 5 == 3) s.v[5] = 0.05 * x;
        if (r % 5 == 4) s.v[0] = 0.4 * x;
    }
}

TEST(LaneBodies, RestSlideTipAndHopAlike) {
    for (int kind = 0; kind < kKinds; ++kind)
        for (const double bounce : {0.0, 0.5}) {
            SurfaceSpec s = surface(0.5);
            s.restitution = bounce;
            compare(scattered(body_of(kind, s), 13, 0.051), stir_some, 250);
        }
}

/// Blows at several points at once, with friction: some would add energy, if it were not guarded. Much the
/// same happens to all, so that they stay together.
TEST(LaneBodies, BounceOnTheirEdgesAlike) {
    SurfaceSpec s = surface(1.0);
    s.restitution = 0.7;
    World world = scattered(body_of(0, s), 9, 0.05);
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; sim.tick % 120 == 119 && r < sim.states.size(); ++r) {
            const double x = static_cast<double>(sim.tick) + 1e-3 * static_cast<double>(r);
            RobotState& state = sim.states[r];
            state.v = {fixed_sin(x),     fixed_sin(2.1 * x), 2 * fixed_sin(3.3 * x),
                       2 * fixed_cos(x), fixed_cos(2.3 * x), -0.5};
        }
    };
    compare(world, drive, 2000);
}

/// Bodies with their mass aside, which turn while they are swept towards walls.
TEST(LaneBodies, HitWallsWhileTheyTurnAlike) {
    World world = empty_world(2e-3);
    world.prototypes.push_back(body_of(0, surface(0.1)));
    world.prototypes.back().links[0].p_LC = {0.02, 0.01, 0};
    place(world, ground(surface(0.1)), "ground");
    for (int i = 0; i < 8; ++i) {
        world.instances.push_back(
            {"body_" + std::to_string(i), 0, {{0, 3.0 * i, 0.05}, from_rpy(0, 0, 0.7)}, {}});
        const CollisionSpec wall =
            i < 4 ? box_shape({0.1, 1, 1}, surface(0.1)) : mesh_shape(box_mesh({0.1, 1, 1}), surface(0.1));
        place(world, scenery(wall), "wall_" + std::to_string(i), {{0.5, 3.0 * i, 0.5}, {}});
    }
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; sim.tick == 10 && r < sim.states.size(); ++r)
            sim.states[r].v = {0, 0, 2, 3, 0, 0};
    };
    compare(world, drive, 200);
}

TEST(LaneBodies, OnSoftGroundAlike) {
    SurfaceSpec s = surface(0.5);
    s.stiffness = 2e4, s.damping = 100;
    compare(scattered(body_of(0, s), 11, 0.051), stir_some, 250);
}

/// Boxes and meshes under them, at the rims of which some lie.
TEST(LaneBodies, OnBlocksAlike) {
    for (int kind = 0; kind < kKinds; ++kind) {
        World world = scattered(body_of(kind, surface(0.5)), 11, 0.251);
        for (int i = 0; i < 11; ++i) {
            const Vec3 size{0.4, 0.4, 0.2};
            place(world,
                  scenery(i < 6 ? box_shape(size, surface(0.5)) : mesh_shape(box_mesh(size), surface(0.5))),
                  "block_" + std::to_string(i), {{5.0 * i + 0.02 * i, 0.3 * i, 0.1}, {}});
        }
        compare(world, stir_some, 250);
    }
}

/// Side by side, some pushed into their neighbours and apart again.
TEST(LaneBodies, NextToEachOtherAlike) {
    for (int kind = 0; kind < kKinds; ++kind) {
        World world = scattered(body_of(kind, surface(0.5)), 20, 0.05);
        for (int i = 0; i < 20; ++i)
            world.instances[world.instances.size() - 20 + static_cast<std::size_t>(i)].X_WM.p = {
                0.14 * (i % 5), 0.14 * (i / 5), 0.0501};
        compare(world, stir_some, 250);
    }
}

/// One shape and one surface for many bodies, on ground of one kind, kicked again and again.
World random_world(std::uint64_t seed) {
    Random random(seed);
    constexpr double kSteps[] = {1e-3, 2e-3, 4e-3};
    SurfaceSpec s = surface(random.uniform(0, 1.2));
    if (random.integer(0, 2) == 0) s.restitution = random.uniform(0, 1);
    if (random.integer(0, 4) == 0) s.stiffness = 2e4, s.damping = random.uniform(0, 200);
    World world = empty_world(kSteps[random.integer(0, 2)]);
    world.sleep = random.integer(0, 5) == 0;
    world.prototypes.push_back(body_of(random.integer(0, kKinds - 1), s));
    if (random.integer(0, 1) == 0) world.prototypes.back().links[0].p_LC = random.vector(0.02);
    const Quat tilt = from_rpy(0, random.uniform(0, 0.4), 0);
    switch (random.integer(0, 3)) {
        case 0:
            place(world, ground(s), "ground", {{}, tilt});
            break;
        case 1:
            place(world, scenery(box_shape({200, 200, 1}, s)), "slab", {{0, 0, -0.5}, tilt});
            break;
        case 2:
            place(world, ground(s), "ground", {{}, tilt});
            place(world, ground(s), "other", {{0, 0, -0.02}, from_rpy(0.3, 0, 0)});
            break;
        default:
            place(world,
                  scenery(
                      mesh_shape(sheet_mesh(200, 200, 20, 20, [](double x, double) { return 0.01 * x; }), s)),
                  "sheet");
    }
    for (int i = 0; i < 12; ++i) {
        const double x = 4.0 * (i % 4 - 1.5), y = 4.0 * (i / 4 - 1);
        const double z = 0.3 - x * (rotate(tilt, {1, 0, 0}).z < 0 ? 0.2 : 0.0);
        world.instances.push_back({"body_" + std::to_string(i), 0, {{x, y, z}, random.rotation()}, {}});
    }
    return world;
}

TEST(LaneBodies, InRandomWorldsAlike) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Drive kick = [&](Simulation& sim) {
            if (sim.tick % 60 != 59) return;
            Random random(seed * 1000 + static_cast<std::uint64_t>(sim.tick));
            const Vec3 turn = random.vector(random.integer(0, 3) == 0 ? 20 : 2), push = random.vector(2);
            for (RobotState& s : sim.states) {
                s.v = {turn.x, turn.y, turn.z, push.x, push.y, push.z};
                s.rest = {};
            }
        };
        compare(random_world(seed), kick, 240);
        if (HasFailure()) FAIL() << "seed " << seed;
    }
}

/// Where bodies touch two slopes Newton's method with friction bounds in between often fails: others solve
/// it.
TEST(LaneBodies, InGroovesFrictionKeepsItsTolerance) {
    World world = empty_world(2e-3);
    world.prototypes.push_back(body_of(0, surface(1.0)));
    for (int i = 0; i < 20; ++i) {
        const std::string number = std::to_string(i);
        for (const double side : {-1.0, 1.0})
            place(world, scenery(box_shape({4, 0.4, 0.1}, surface(1.0))),
                  (side < 0 ? "left_" : "right_") + number,
                  {{0, 3.0 * i + 0.14 * side, 0.14}, from_rpy(kPi / 4 * side, 0, 0)});
        world.instances.push_back(
            {"body_" + number, 0, {{0, 3.0 * i, 0.35}, from_rpy(0.3 * i, 0.5 * i, 0.7 * i)}, {}});
    }
    Simulation sim(world);
    sim.scratch.measure_stages([] { return std::uint64_t{0}; });
    SolverProfile all;
    for (int tick = 0; tick < 1000; ++tick) {
        for (std::size_t r = 0; tick % 200 == 199 && r < sim.states.size(); ++r) {
            const double x = static_cast<double>(r + 1) * tick;
            sim.states[r].v = {3 * fixed_sin(x),   3 * fixed_sin(1.7 * x), 3 * fixed_sin(2.9 * x),
                               fixed_sin(5.3 * x), fixed_sin(7.1 * x),     fixed_sin(9.7 * x)};
        }
        all += sim.step().profile.solver;
    }
    EXPECT_GT(all.friction_solves, 10000u);
    tell("worst error of friction", all.friction_error);
    EXPECT_LE(static_cast<double>(all.friction_misses), 1e-3 * static_cast<double>(all.friction_solves));
}

TEST(LaneBodies, FallAsleepAtTheSameTick) {
    World world = scattered(body_of(0, surface(0.5)), 11, 0.051);
    world.sleep = true;
    compare(world, stir_some, 500);
}

/// Of the steps of boxes that slide on ice, or rest if their speed is 0, the share that are taken in lanes.
double share_in_lanes(std::size_t width, double speed) {
    Simulation sim(scattered(body_of(0, surface(0.05)), static_cast<int>(width), 0.05));
    sim.run(50);
    for (std::size_t r = 0; r < width; ++r) {
        EXPECT_TRUE(rests_in_lanes(*sim.model, sim.model->type_of(sim.ids[r]), sim.states[r]));
        sim.states[r].v[3] = speed;
    }
    StepReport report;
    constexpr int kTicks = 200;
    const int stepped = step_only_in_lanes(sim, Precision::kDouble, width, kTicks, report);
    return stepped / (static_cast<double>(kTicks) * static_cast<double>(width));
}

/// They are of use at all.
TEST(LaneBodies, StayInTheirLanes) {
    for (const std::size_t width : kWidths)
        for (const double speed : {0.0, 0.5}) {
            if (!has_lanes(Precision::kDouble, width)) continue;
            const double share = share_in_lanes(width, speed);
            tell("share of steps at " + std::to_string(speed) + " m/s in " + std::to_string(width) + " lanes",
                 share);
            EXPECT_GT(share, 0.9);
        }
}

}  // namespace
}  // namespace roboss::test
