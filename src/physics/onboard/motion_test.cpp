// VelocityControl, ApplyLinkWrench, TrajectoryFollower, DriveToPoseController and planar move in the step.
#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

namespace roboss::test {
namespace {

/// A box of 2 kg that nothing pulls, 1 m above the origin.
World floating(OnboardParameters parameters) {
    World world = empty_world(1e-3, {});
    place(world, with_onboard(solid_box(2.0, {0.4, 0.2, 0.1}, surface(0.5)), std::move(parameters)), "box",
          {{0, 0, 1}, {}});
    return world;
}

TEST(VelocityControl, ACommandInTheRobotsAxesGivesACircle) {
    Simulation sim(floating(VelocityControlSpec{}));
    const double v = 0.5, w = 0.8, t = 3;
    give(sim, "cmd_vel", {v, 0, 0.1, 0, 0, w});
    sim.run(t - sim.model->dt_s);
    EXPECT_NEAR(stand(sim).x, v / w * std::sin(w * t), 1e-3);
    EXPECT_NEAR(stand(sim).y, v / w * (1 - std::cos(w * t)), 1e-3);
    EXPECT_NEAR(stand(sim).heading, w * t, 1e-9);
    EXPECT_NEAR(sim.states[0].q[2], 1 + 0.1 * t, 1e-9);
}

TEST(VelocityControl, InitialVelocitiesHoldUntilTheFirstCommand) {
    VelocityControlSpec spec;
    spec.initial_linear = {0.3, 0, 0}, spec.initial_angular = {0, 0, -0.1};
    Simulation sim(floating(spec));
    sim.run(1);
    EXPECT_NEAR(stand(sim).heading, -0.1, 1e-9);
    EXPECT_NEAR(stand(sim).x, 3 * std::sin(0.1), 1e-3);
    give(sim, "cmd_vel", {0, 0, 0, 0, 0, 0});
    const Stand at = stand(sim);
    sim.run(1);
    EXPECT_EQ(stand(sim).x, at.x);
}

TEST(VelocityControl, WithoutACommandTheRobotIsFrozenButForOneTickOfGravity) {
    World world = floating(VelocityControlSpec{});
    world.gravity = {0, 0, -10};
    Simulation sim(world);
    sim.states[0].v[3] = 2;
    sim.run(1);
    EXPECT_NEAR(sim.states[0].q[0], 0, 1e-12);
    EXPECT_NEAR(sim.states[0].q[2], 1 - 0.5 * 10 * 1e-3, 1e-9) << "on average it falls with g dt / 2";
}

TEST(VelocityControl, ALinksCommandMovesTheWholeRobotSoThatTheLinkHasIt) {
    VelocityControlSpec spec;
    spec.links = {"left"};
    World world = empty_world(1e-3, {});
    place(world, with_onboard(two_wheeler(), spec), "robot", {{0, 0, 1}, from_rpy(0, 0, 0.4)});
    Simulation sim(world);
    sim.states[0].v[6] = 2;  // its wheel turns
    sim.run(0.01);
    EXPECT_NEAR(stand(sim).x, 0, 1e-9) << "before the first command it moves freely";
    give(sim, "link/left/cmd_vel", {0.2, 0, 0.1, 0, 0, 0.5});
    const LinkId left = *sim.type(0).find_link("left");
    const Twist twist = link_twist(sim.type(0), sim.states[0], left);
    const Mat3 R = link_pose(sim.type(0), sim.states[0], left).R;
    const Vec3 linear = transpose_times(R, twist.linear), angular = transpose_times(R, twist.angular);
    EXPECT_NEAR(linear.x, 0.2, 2e-3);
    EXPECT_NEAR(linear.z, 0.1, 2e-3);
    EXPECT_NEAR(angular.z, 0.5, 2e-3);
    EXPECT_NEAR(angular.y, 0, 2e-3);
}

TEST(ApplyLinkWrench, APersistentForceActsAtTheLinksOriginAndIsCleared) {
    ApplyLinkWrenchSpec spec;
    spec.persistent.push_back({"box", "model", {4, 0, 0}, {0, 0, 0.5}});
    Simulation sim(floating(spec));
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[3], 4.0 / 2, 1e-9) << "F t / m";
    EXPECT_NEAR(sim.states[0].v[2], 0.5 / (2.0 / 12 * (0.16 + 0.04)), 1e-6) << "T t / I";
    give(sim, "wrench/clear", {1});
    const double v = sim.states[0].v[3];
    sim.run(0.1);
    EXPECT_NEAR(sim.states[0].v[3], v, 1e-12);
}

TEST(ApplyLinkWrench, OneTicksWrenchGivesItsImpulseOnce) {
    Simulation sim(floating(ApplyLinkWrenchSpec{}));
    sim.run(0.01);
    give(sim, "wrench", {1000, 0, 0, 0, 0, 0, 0, 0.1, 0});
    EXPECT_NEAR(sim.states[0].v[3], 1000 * 1e-3 / 2, 1e-9) << "F dt / m";
    const double turn = -0.1 * 1000 * 1e-3 / (2.0 / 12 * (0.16 + 0.04));
    EXPECT_NEAR(sim.states[0].v[2], turn, std::fabs(turn) * 1e-3) << "r x F dt / I";
    sim.run(0.01);
    EXPECT_NEAR(sim.states[0].v[3], 0.5, 1e-9);
    give(sim, "wrench/persistent", {0, 2, 0, 0, 0, 0, 0, 0, 0});
    sim.run(0.1 - 1e-3);
    EXPECT_NEAR(sim.states[0].v[4], 0.1, 1e-6);
    give(sim, "wrench/clear", {1});
    sim.run(0.1);
    EXPECT_NEAR(sim.states[0].v[4], 0.1, 1e-6);
}

TEST(TrajectoryFollower, PushesABoxFromWaypointToWaypoint) {
    TrajectoryFollowerSpec spec;
    spec.link = {"box"}, spec.waypoints = {1.5, 0, 1.5, 1.5}, spec.force = 12, spec.torque = 1.5;
    World world = empty_world(1e-3);
    place(world, ground(surface(0.4)), "ground");
    place(world, with_onboard(solid_box(2.0, {0.4, 0.4, 0.1}, surface(0.4)), spec), "robot",
          {{0, 0, 0.05}, {}});
    Simulation sim(world);
    double nearest = 1e9;
    for (int i = 0; i < 20000; ++i) {
        sim.step();
        nearest = std::fmin(nearest, std::hypot(stand(sim).x - 1.5, stand(sim).y));
    }
    EXPECT_LT(nearest, 0.51) << "within range_tolerance of the first";
    EXPECT_LT(std::hypot(stand(sim).x - 1.5, stand(sim).y - 1.5), 0.51) << "and of the last";
    EXPECT_EQ(memory(sim)[TrajectoryFollowerSpec::kIdle], 1) << "where it may sleep";
}

TEST(TrajectoryFollower, PausedItDoesNothing) {
    TrajectoryFollowerSpec spec;
    spec.link = {"box"}, spec.line_length = 3;
    Simulation sim(floating(spec));
    give(sim, "trajectory_follower/pause", {1});
    sim.run(0.2);
    EXPECT_EQ(stand(sim).x, 0);
    give(sim, "trajectory_follower/pause", {0});
    sim.run(0.2);
    EXPECT_GT(stand(sim).x, 0.1) << "60 N move 2 kg";
}

TEST(DriveToPose, TheDriveTakesTheRobotToThePoseAndStops) {
    ModelSpec m = two_wheeler();
    DiffDriveSpec drive = diff_drive();
    drive.linear = {-0.8, 0.8, -2, 2, -INFINITY, INFINITY},
    drive.angular = {-1, 1, -4, 4, -INFINITY, INFINITY};
    m = with_onboard(with_onboard(m, DriveToPoseSpec{}), drive);
    Simulation sim(on_plane(m));
    sim.run(0.3);
    give(sim, "cmd_pose", {1.2, -0.9, 2.0});
    sim.run(15);
    EXPECT_LT(std::hypot(stand(sim).x - 1.2, stand(sim).y + 0.9), 0.11) << "linear_deviation";
    EXPECT_NEAR(stand(sim).heading, 2.0, 0.06) << "angular_deviation";
    EXPECT_EQ(memory(sim)[DriveToPoseSpec::kActive], 0);
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 0, 1e-6) << "a last command of zero";
}

TEST(PlanarMove, FollowsTheCommandInThePlaneAndTimesOut) {
    PlanarMoveSpec spec;
    spec.timeout = 1;
    Simulation sim(floating(spec));
    const double v = 0.4, side = 0.2, w = 0.5, t = 0.8;
    give(sim, "cmd_vel", {v, side, 7, 0, 0, w});
    sim.run(t - sim.model->dt_s);
    EXPECT_NEAR(stand(sim).heading, w * t, 1e-6);
    EXPECT_NEAR(stand(sim).x, (v * std::sin(w * t) - side * (1 - std::cos(w * t))) / w, 1e-3);
    EXPECT_NEAR(stand(sim).y, (side * std::sin(w * t) + v * (1 - std::cos(w * t))) / w, 1e-3);
    EXPECT_NEAR(sim.states[0].q[2], 1, 1e-9);
    sim.run(1);
    const Stand at = stand(sim);
    sim.run(0.5);
    EXPECT_NEAR(stand(sim).x, at.x, 1e-9) << "older commands count as zero";
}

}  // namespace
}  // namespace roboss::test
