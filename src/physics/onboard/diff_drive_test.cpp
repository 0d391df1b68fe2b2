// DiffDrive in the step: lines and circles against closed forms, limits, odometry, and the same bits in
// lanes.
#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

namespace roboss::test {
namespace {

using Spec = DiffDriveSpec;

World drive_world(const DiffDriveSpec& spec) {
    return on_plane(with_onboard(two_wheeler(), spec));
}

TEST(DiffDrive, ALineFollowsTheClosedFormOfItsRamp) {
    DiffDriveSpec spec = diff_drive();
    spec.linear.max_acceleration = 1, spec.linear.max_velocity = 0.5;
    Simulation sim(drive_world(spec));
    sim.run(0.5);  // settles
    const double x = stand(sim).x;
    give(sim, "cmd_vel", {3, 0, 0, 0, 0, 0});
    sim.run(2 - sim.model->dt_s);
    // v^2 / 2a in the ramp, then v t
    const double v = 0.5, expected = v * v / 2 + v * (2 - v);
    tell("way beyond the closed form, m", stand(sim).x - x - expected);
    EXPECT_NEAR(stand(sim).x - x, expected, 1e-3);
    EXPECT_NEAR(stand(sim).y, 0, 1e-6);
    EXPECT_NEAR(stand(sim).heading, 0, 1e-6);
}

TEST(DiffDrive, ACircleFollowsTheClosedForm) {
    Simulation sim(drive_world(diff_drive()));
    sim.run(0.5);
    give(sim, "cmd_vel", {0.4, 0, 0, 0, 0, 0.8});
    sim.run(0.2);  // the wheels take hold
    const Stand from = stand(sim);
    const double t = 3, v = 0.4, w = 0.8;
    sim.run(t);
    const Stand at = stand(sim);
    const double turned = from.heading + w * t;
    tell("heading beyond the closed form, rad", std::remainder(at.heading - turned, 2 * kPi));
    EXPECT_NEAR(std::remainder(at.heading - turned, 2 * kPi), 0, 3e-3);
    EXPECT_NEAR(at.x - from.x, v / w * (std::sin(turned) - std::sin(from.heading)), 2e-3);
    EXPECT_NEAR(at.y - from.y, -v / w * (std::cos(turned) - std::cos(from.heading)), 2e-3);
}

TEST(DiffDrive, OdometryFollowsTheTruePose) {
    DiffDriveSpec spec = diff_drive();
    spec.linear.max_acceleration = spec.angular.max_acceleration = 2;
    spec.linear.min_acceleration = spec.angular.min_acceleration = -2;
    Simulation sim(drive_world(spec));
    sim.run(0.5);
    const double twists[][2] = {{0.5, 0.3}, {0.4, -1.0}, {-0.3, 0.5}, {0, 1.5}, {0.6, 0}};
    double far = 0, turned = 0;
    for (const auto& [v, w] : twists) {
        give(sim, "cmd_vel", {v, 0, 0, 0, 0, w});
        for (int i = 0; i < 1500; ++i) {
            const Stand before = stand(sim);  // odometry is that of the start of the tick
            sim.step();
            const auto odometry = memory(sim);
            far = std::fmax(far, std::hypot(odometry[0] - before.x, odometry[1] - before.y));
            turned = std::fmax(turned, std::fabs(std::remainder(odometry[2] - before.heading, 2 * kPi)));
        }
        EXPECT_NEAR(memory(sim)[3], v, 1e-6);
        EXPECT_NEAR(memory(sim)[4], w, 1e-6);
    }
    tell("largest distance of odometry from the true place on 3 m, m", far);
    tell("largest error of its heading, rad", turned);
    EXPECT_LT(far, 5e-3);
    EXPECT_LT(turned, 5e-3);
    EXPECT_GT(std::hypot(memory(sim)[0], memory(sim)[1]), 0.5) << "it went somewhere";
}

TEST(DiffDrive, WheelsKeepAllLimitsAtEveryTick) {
    DiffDriveSpec spec = diff_drive();
    spec.linear = {-0.2, 0.6, -1.5, 1, -20, 10};
    spec.angular = {-0.7, 0.5, -3, 2, -30, 40};
    Simulation sim(drive_world(spec));
    const double dt = sim.model->dt_s;
    const double twists[][2] = {{2, 1}, {-2, -1}, {0.3, 0.2}, {0, 0}};
    double speed[3] = {}, turn[3] = {};
    for (int i = 0; i < 4000; ++i) {
        const auto& [v, w] = twists[i / 1000];
        if (i % 1000 == 0)
            give(sim, "cmd_vel", {v, 0, 0, 0, 0, w});
        else
            sim.step();
        const double left = sim.states[0].motors[0].target * kWheelRadius,
                     right = sim.states[0].motors[1].target * kWheelRadius;
        speed[2] = speed[1], speed[1] = speed[0], speed[0] = 0.5 * (left + right);
        turn[2] = turn[1], turn[1] = turn[0], turn[0] = (right - left) / kSeparation;
        const auto expect_within = [&](const SpeedLimits& limits, const double* u) {
            const double a = (u[0] - u[1]) / dt, jerk = (u[0] - 2 * u[1] + u[2]) / (dt * dt);
            EXPECT_TRUE(u[0] >= limits.min_velocity - 1e-12 && u[0] <= limits.max_velocity + 1e-12) << i;
            EXPECT_TRUE(a >= limits.min_acceleration - 1e-9 && a <= limits.max_acceleration + 1e-9) << i;
            EXPECT_TRUE(jerk >= limits.min_jerk - 1e-6 && jerk <= limits.max_jerk + 1e-6) << i << " " << jerk;
        };
        expect_within(spec.linear, speed), expect_within(spec.angular, turn);
        if (HasFailure()) return;
        if (i == 999) {
            EXPECT_NEAR(speed[0], 0.6, 1e-12) << "it gets there";
        }
    }
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 0, 1e-6);
}

TEST(DiffDrive, BeforeTheFirstCommandTheWheelsAreHeldAndTheRobotMaySleep) {
    World world = on_plane(with_onboard(two_wheeler(), diff_drive()));
    world.gravity = {1.5, 0, -9.7};  // a slope
    world.sleep = true;
    Simulation sim(world);
    sim.run(2);
    EXPECT_NEAR(stand(sim).x, 0, 1e-3) << "it does not roll away";
    EXPECT_TRUE(sim.states[0].rest.asleep);
    EXPECT_EQ(sim.states[0].motors[0].mode, MotorMode::kVelocity);
    give(sim, "cmd_vel", {0.3, 0, 0, 0, 0, 0});
    sim.run(1);
    EXPECT_FALSE(sim.states[0].rest.asleep);
    EXPECT_NEAR(stand(sim).x, 0.3, 0.02) << "a command wakes it";
}

TEST(DiffDrive, DisabledItBrakesAndForgetsItsCommandEnabledItTakesTheNext) {
    Simulation sim(drive_world(diff_drive()));
    give(sim, "cmd_vel", {0.3, 0, 0, 0, 0, 0});
    sim.run(0.2);
    give(sim, "enable", {1});  // it was enabled: nothing changes
    sim.run(0.1);
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 3, 1e-6);
    give(sim, "enable", {0});
    give(sim, "cmd_vel", {0.5, 0, 0, 0, 0, 0});
    sim.run(0.1);
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 0, 1e-6);
    give(sim, "enable", {1});
    sim.run(0.1);
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 0, 1e-6) << "a command that came meanwhile is ignored";
    give(sim, "cmd_vel", {0.5, 0, 0, 0, 0, 0});
    sim.run(0.1);
    EXPECT_NEAR(joint_velocity(sim, "left_joint"), 5, 1e-6);
}

World skid_cars(int count) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, skid_car(), "car_0");
    for (int i = 1; i < count; ++i)
        world.instances.push_back({"car_" + std::to_string(i), 1, {{2.0 * i, 0, 0}, {}}, {}});
    return world;
}

void drive_all(Simulation& sim) {
    std::vector<Order> orders;
    for (std::size_t r = 0; r < sim.states.size(); ++r) {
        const double k = static_cast<double>(r);
        orders.push_back(command(sim, r, "cmd_vel", {0.3 + 0.01 * k, 0, 0, 0, 0, 0.1 * k - 0.4}));
    }
    sim.step(orders);
}

TEST(DiffDrive, AllWheelsOfASideTurnEquallyFast) {
    Simulation sim(skid_cars(1));
    give(sim, "cmd_vel", {0.4, 0, 0, 0, 0, 1});
    sim.run(1);
    const auto& motors = sim.states[0].motors;
    EXPECT_EQ(motors[0].target, motors[2].target);
    EXPECT_EQ(motors[1].target, motors[3].target);
    EXPECT_NEAR(motors[0].target, (0.4 - 0.13) / 0.05, 1e-9);
    EXPECT_NEAR(motors[1].target, (0.4 + 0.13) / 0.05, 1e-9);
}

TEST(DiffDrive, CarsStayInLanesAndLanesChangeNoBit) {
    Simulation lanes(skid_cars(16)), alone(skid_cars(16));
    alone.scratch.use_lanes(1);
    int placed = 0;
    for (int i = 0; i < 400; ++i) {
        if (i == 50) {
            drive_all(lanes), drive_all(alone);
        } else {
            placed += lanes.step().placed;
            alone.step();
        }
        ASSERT_EQ(lanes.hash(), alone.hash()) << "tick " << i;
    }
    if (lanes.scratch.lanes(Precision::kDouble) > 1) {
        EXPECT_GT(placed, 16 * 399 * 8 / 10) << "before the first command, and after it";
    }
}

TEST(DiffDrive, AStateThatWentThroughBytesContinuesWithTheSameBits) {
    DiffDriveSpec spec = diff_drive();
    spec.linear.max_jerk = 5, spec.linear.min_jerk = -5;
    Simulation straight(drive_world(spec)), moved(drive_world(spec));
    give(straight, "cmd_vel", {0.5, 0, 0, 0, 0, 0.4}), give(moved, "cmd_vel", {0.5, 0, 0, 0, 0, 0.4});
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint8_t> bytes;
        encode(moved.states[0], bytes);
        Result<RobotState> decoded = decode_state(bytes, moved.type(0));
        ASSERT_TRUE(decoded.ok()) << decoded.error().text();
        moved.states[0] = std::move(decoded).value();
        straight.step(), moved.step();
        ASSERT_EQ(straight.hash(), moved.hash()) << "tick " << i;
    }
}

}  // namespace
}  // namespace roboss::test
