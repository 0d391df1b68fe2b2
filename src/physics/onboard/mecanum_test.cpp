// MecanumDrive in the step: rollers are friction directions in the chassis' axes, so the robot moves
// sideways.
#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

namespace roboss::test {
namespace {

constexpr double kBase = 0.6;  // m, between the axles

/// Friction along one diagonal of the chassis, none across.
SurfaceSpec rollers(double diagonal) {
    SurfaceSpec s = surface(1);
    s.mu2 = 0, s.fdir1 = {1, diagonal, 0}, s.fdir1_link = "chassis";
    return s;
}

ModelSpec mecanum() {
    ModelSpec m;
    m.name = "mecanum";
    m.canonical_link = "chassis";
    m.links.push_back(link("chassis", 10, box_inertia(10, {0.6, 0.4, 0.1}), {{0, 0, kWheelRadius}, {}}));
    const double x = kBase / 2, y = kSeparation / 2;
    add_wheel(m, "front_left", "chassis", {x, y, kWheelRadius}, kWheelRadius, rollers(-1));
    add_wheel(m, "front_right", "chassis", {x, -y, kWheelRadius}, kWheelRadius, rollers(1));
    add_wheel(m, "back_left", "chassis", {-x, y, kWheelRadius}, kWheelRadius, rollers(1));
    add_wheel(m, "back_right", "chassis", {-x, -y, kWheelRadius}, kWheelRadius, rollers(-1));
    MecanumDriveSpec spec;
    spec.front_left = {"front_left_joint"}, spec.front_right = {"front_right_joint"};
    spec.back_left = {"back_left_joint"}, spec.back_right = {"back_right_joint"};
    spec.wheelbase = kBase, spec.wheel_separation = kSeparation, spec.wheel_radius = kWheelRadius;
    spec.linear.max_acceleration = spec.angular.max_acceleration = 2;
    spec.linear.min_acceleration = spec.angular.min_acceleration = -2;
    return with_onboard(m, spec);
}

TEST(MecanumDrive, MovesSidewaysAndDiagonallyWithoutTurning) {
    const double twists[][2] = {{0, 0.4}, {0.3, -0.3}, {0.4, 0}};
    for (const auto& [x, y] : twists) {
        Simulation sim(on_plane(mecanum()));
        sim.run(0.5);
        give(sim, "cmd_vel", {x, y, 0, 0, 0, 0});
        sim.run(0.5);
        const Stand from = stand(sim);
        sim.run(2);
        const Stand at = stand(sim);
        tell("sideways way beyond the closed form, m", at.y - from.y - 2 * y);
        EXPECT_NEAR(at.x - from.x, 2 * x, 0.01);
        EXPECT_NEAR(at.y - from.y, 2 * y, 0.01);
        EXPECT_NEAR(at.heading, 0, 0.01);
    }
}

TEST(MecanumDrive, TurnsWhileItMovesSideways) {
    Simulation sim(on_plane(mecanum()));
    sim.run(0.5);
    give(sim, "cmd_vel", {0, 0.3, 0, 0, 0, 0.5});
    sim.run(0.5);
    const Stand from = stand(sim);
    const double t = 2, v = 0.3, w = 0.5, turned = from.heading + w * t;
    sim.run(t);
    EXPECT_NEAR(stand(sim).heading, turned, 0.02);
    EXPECT_NEAR(stand(sim).x - from.x, v / w * (std::cos(turned) - std::cos(from.heading)), 0.02);
    EXPECT_NEAR(stand(sim).y - from.y, v / w * (std::sin(turned) - std::sin(from.heading)), 0.02);
}

TEST(MecanumDrive, OdometryFollowsTheTruePose) {
    Simulation sim(on_plane(mecanum()));
    sim.run(0.5);
    double far = 0;
    const double twists[][3] = {{0, 0.4, 0}, {0.3, -0.2, 0.5}, {0, 0, -1}};
    for (const auto& [x, y, w] : twists) {
        give(sim, "cmd_vel", {x, y, 0, 0, 0, w});
        for (int i = 0; i < 1500; ++i) {
            const Stand before = stand(sim);
            sim.step();
            far = std::fmax(far, std::hypot(memory(sim)[0] - before.x, memory(sim)[1] - before.y));
        }
        EXPECT_NEAR(memory(sim)[3], x, 1e-6);
        EXPECT_NEAR(memory(sim)[4], w, 1e-6);
        EXPECT_NEAR(memory(sim)[MecanumDriveSpec::kSideways], y, 1e-6);
    }
    tell("largest distance of odometry from the true place on 1.2 m, m", far);
    EXPECT_LT(far, 0.02);
    EXPECT_GT(std::hypot(memory(sim)[0], memory(sim)[1]), 0.4);
}

TEST(MecanumDrive, RollersInTheWheelsOwnFrameTurnWithThem) {
    // The direction counts in the frame that it is written in: without the link it would turn with the wheel.
    ModelSpec own = mecanum();
    for (LinkSpec& l : own.links)
        for (CollisionSpec& c : l.collisions) c.surface.fdir1_link.clear();
    Simulation sim(on_plane(own));
    sim.run(0.5);
    give(sim, "cmd_vel", {0, 0.4, 0, 0, 0, 0});
    sim.run(2.5);
    EXPECT_GT(std::fabs(stand(sim).y - 1.0) + std::fabs(stand(sim).heading), 0.1);
}

TEST(MecanumDrive, LanesChangeNoBit) {
    Simulation lanes(on_plane(mecanum())), alone(on_plane(mecanum()));
    alone.scratch.use_lanes(1);
    give(lanes, "cmd_vel", {0.2, 0.3, 0, 0, 0, 0.3}), give(alone, "cmd_vel", {0.2, 0.3, 0, 0, 0, 0.3});
    expect_same_run(lanes, alone, 0.5);
}

}  // namespace
}  // namespace roboss::test
