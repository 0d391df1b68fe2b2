// Free bodies that lie on scenery are stepped in lanes, with the bits of bodies by themselves.
#include <gtest/gtest.h>

#include <bit>

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

TEST(LaneBodies, FallAsleepAtTheSameTick) {
    World world = scattered(body_of(0, surface(0.5)), 11, 0.051);
    world.sleep = true;
    compare(world, stir_some, 500);
}

/// Of the steps of boxes that slide on ice, or rest if their speed is 0, the share that are taken in lanes.
double share_in_lanes(std::size_t width, double speed) {
    Simulation sim(scattered(body_of(0, surface(0.05)), static_cast<int>(width), 0.05));
    sim.run(50);
    std::vector<LaneRobot> robots;
    for (std::size_t r = 0; r < width; ++r) {
        EXPECT_TRUE(rests_in_lanes(*sim.model, sim.model->type_of(sim.ids[r]), sim.states[r]));
        sim.states[r].v[3] = speed;
        robots.push_back({sim.ids[r], &sim.states[r], &sim.bounds[r], false, {}});
    }
    const auto stepper = make_lane_stepper(Precision::kDouble, width);
    StepReport report;
    StageClock clock;
    int stepped = 0;
    constexpr int kTicks = 200;
    for (int i = 0; i < kTicks; ++i)
        stepped += std::popcount(stepper->step(*sim.model, robots, report, clock));
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
