// Controllers of joints in the step: against closed forms and an independent integration of a PID controller.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kDt = 1e-3, kInertia = 0.02;
const RobotId kFirst(std::size_t{0});

/// Wheels on vertical axles on a base that is fixed to the world: q = angle, v = speed, inertia kInertia.
ModelSpec rotor(int count = 1) {
    ModelSpec m;
    m.name = "rotor";
    m.canonical_link = "base";
    m.links.push_back(link("base", 1.0, Mat3::identity()));
    m.joints.push_back(joint(JointSpecKind::kFixed, "weld", "world", "base", {}, {0, 0, 1}));
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        m.links.push_back(
            link("wheel_" + n, 1.0, Mat3::diagonal(kInertia, kInertia, kInertia), {{1.0 * i, 0, 1}, {}}));
        m.joints.push_back(joint(JointSpecKind::kContinuous, "axle_" + n, "base", "wheel_" + n,
                                 {{1.0 * i, 0, 1}, {}}, {0, 0, 1}));
    }
    return m;
}

World world_of(ModelSpec model) {
    World world = empty_world(kDt, {});
    place(world, std::move(model), "robot");
    return world;
}

template <class Spec>
ModelSpec with(ModelSpec model, const Spec& spec) {
    model.onboard.push_back({"plugin", spec, {}});
    return model;
}

Order command(const Simulation& sim, std::vector<double> values, std::uint32_t channel = 0) {
    return {sim.tick, ClientId(std::size_t{0}), 0, kFirst, Command{channel, std::move(values)}};
}

void give(Simulation& sim, std::vector<double> values, std::uint32_t channel = 0) {
    const Order order = command(sim, std::move(values), channel);
    const Result<> checked = check_order(*sim.model, order);
    ASSERT_TRUE(checked.ok()) << checked.error().text();
    sim.step({&order, 1});
}

double angle(const Simulation& sim, std::size_t joint = 0) {
    return sim.states[0].q[7 + joint];
}
double speed(const Simulation& sim, std::size_t joint = 0) {
    return sim.states[0].v[joint];
}

/// A wheel of kInertia under a PID controller, by itself: not the code under test.
struct ReferenceWheel {
    PidGains gains;
    double q = 0, v = 0, sum = 0, last = 0;

    double effort(double error) {
        sum = std::min(std::max(sum + gains.i * error * kDt, gains.i_min), gains.i_max);
        const double slope = (error - last) / kDt;
        last = error;
        const double u = gains.cmd_offset - (gains.p * error + sum + gains.d * slope);
        return std::min(std::max(u, gains.cmd_min), gains.cmd_max);
    }
    void step(double effort) { v += effort * kDt / kInertia, q += v * kDt; }
};

TEST(JointController, TurnsWithTheInitialVelocityThenWithTheCommanded) {
    JointControllerSpec spec;
    spec.joints = {"axle_0", "axle_1"};
    spec.initial_velocity = 5;
    Simulation sim(world_of(with(rotor(2), spec)));
    sim.run(0.1);
    EXPECT_NEAR(speed(sim, 0), 5, 1e-6);
    EXPECT_NEAR(speed(sim, 1), 5, 1e-6);
    give(sim, {-1});
    sim.run(0.5);
    EXPECT_NEAR(speed(sim, 0), -1, 1e-6);
    EXPECT_NEAR(speed(sim, 1), -1, 1e-6);
}

TEST(JointController, HoldsAJointBeforeTheFirstCommand) {
    JointControllerSpec spec;
    spec.joints = {"hinge"};
    World world = empty_world(kDt);
    place(world, with(pendulum(), spec), "robot");
    Simulation sim(world);
    sim.states[0].q[7] = 1;
    sim.run(1);
    EXPECT_NEAR(angle(sim), 1, 1e-4);
}

TEST(JointController, InForceModeFollowsItsPidController) {
    JointControllerSpec spec;
    spec.joints = {"axle_0"};
    spec.use_force_commands = true;
    spec.pid = {0.3, 0.8, 1e-4, 0.02, -0.02, 1.5, -1.5, 0.001};
    Simulation sim(world_of(with(rotor(), spec)));
    ReferenceWheel wheel{spec.pid};
    double worst = 0;
    for (int i = 0; i < 1500; ++i) {
        const double target = i < 300 ? 0 : i < 900 ? 10 : -4;
        if (i == 300 || i == 900)
            give(sim, {target});
        else
            sim.step();
        wheel.step(wheel.effort(wheel.v - target));
        worst = std::max(worst, std::fabs(speed(sim) - wheel.v));
    }
    tell("largest difference from the reference, rad/s", worst);
    EXPECT_LT(worst, 1e-4);
    EXPECT_NEAR(wheel.v, -4, 0.1);  // the reference itself reached the target
}

TEST(JointController, DoesNotBrakeIfItMayNot) {
    JointControllerSpec spec;
    spec.joints = {"axle_0"};
    spec.use_force_commands = true, spec.disable_braking = true;
    Simulation sim(world_of(with(rotor(), spec)));
    give(sim, {3});
    sim.run(0.5);
    const double fast = speed(sim);
    EXPECT_NEAR(fast, 3, 0.1);
    give(sim, {1});
    sim.run(0.5);
    EXPECT_NEAR(speed(sim), fast, 1e-9);
    give(sim, {0});
    sim.run(0.5);
    EXPECT_NEAR(speed(sim), fast, 1e-9);
}

TEST(JointController, TakesItsPlaceInTheListOfActuators) {
    JointControllerSpec first, second;
    first.joints = {"axle_0"}, second.joints = {"axle_1"};
    first.use_actuator_msg = second.use_actuator_msg = true;
    first.actuator_number = 2, second.actuator_number = 0;
    Simulation sim(world_of(with(with(rotor(2), first), second)));
    ASSERT_EQ(sim.type(0).channels.size(), 1u);
    EXPECT_EQ(sim.type(0).channels[0].channel.name, "actuators");
    give(sim, {7, 8, 9});
    EXPECT_NEAR(speed(sim, 0), 9, 1e-4);  // within one tick
    EXPECT_NEAR(speed(sim, 1), 7, 1e-4);
    give(sim, {7});  // too short for the first
    EXPECT_NEAR(speed(sim, 0), 0, 1e-4);
}

TEST(JointPositionController, FollowsItsPidController) {
    JointPositionControllerSpec spec;
    spec.joints = {"axle_0"};
    spec.pid = {1.5, 0.4, 0.15, 0.1, -0.1, 0.6, -0.5, 0};
    spec.initial_position = 0.5;
    Simulation sim(world_of(with(rotor(), spec)));
    ReferenceWheel wheel{spec.pid};
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const double target = i < 1500 ? 0.5 : -1.2;
        if (i == 1500)
            give(sim, {target});
        else
            sim.step();
        wheel.step(wheel.effort(wheel.q - target));
        worst = std::max(worst, std::fabs(angle(sim) - wheel.q));
    }
    tell("largest difference from the reference, rad", worst);
    EXPECT_LT(worst, 1e-4);
    EXPECT_NEAR(angle(sim), -1.2, 0.05);
}

TEST(JointPositionController, WithoutLimitsPushesWithAtMostAThousand) {
    JointPositionControllerSpec spec;
    spec.joints = {"axle_0"};
    spec.pid.p = 1e6, spec.initial_position = 100;
    Simulation sim(world_of(with(rotor(), spec)));
    sim.step();
    EXPECT_NEAR(speed(sim), 1000 * kDt / kInertia, 1e-3);
}

TEST(JointPositionController, ByVelocityArrivesInOneTickOrAtItsFastest) {
    JointPositionControllerSpec spec;
    spec.joints = {"axle_0"};
    spec.use_velocity_commands = true, spec.initial_position = 0.25;
    Simulation at_once(world_of(with(rotor(), spec)));
    at_once.step();
    EXPECT_NEAR(angle(at_once), 0.25, 1e-6);
    spec.pid.cmd_max = 2;
    Simulation limited(world_of(with(rotor(), spec)));
    limited.run(0.1);
    EXPECT_NEAR(speed(limited), 2, 1e-6);
    EXPECT_NEAR(angle(limited), 0.2, 1e-3);
    limited.run(0.1);
    EXPECT_NEAR(angle(limited), 0.25, 1e-6);
}

TEST(ApplyJointForce, GivesTheEffortUntilTheNextCommand) {
    ApplyJointForceSpec spec;
    spec.joints = {"axle_0"};
    Simulation sim(world_of(with(rotor(), spec)));
    sim.run(0.1);
    EXPECT_EQ(speed(sim), 0);
    give(sim, {0.04});
    sim.run(0.499);
    EXPECT_NEAR(speed(sim), 0.04 / kInertia * 0.5, 1e-6);
    give(sim, {0});
    const double kept = speed(sim);
    sim.run(0.5);
    EXPECT_NEAR(speed(sim), kept, 1e-9);
}

TEST(ApplyJointForce, ApproachesTorqueOverDamping) {
    ApplyJointForceSpec spec;
    spec.joints = {"axle_0"};
    ModelSpec model = with(rotor(), spec);
    model.joints[1].axes[0].damping = 0.02;  // time constant 1 s
    Simulation sim(world_of(model));
    give(sim, {0.1});
    sim.run(0.999);
    EXPECT_NEAR(speed(sim), 5 * (1 - std::exp(-1.0)), 5e-3);
}

TEST(JointEfforts, AddUpAndCountMoreThanVelocities) {
    ApplyJointForceSpec force;
    force.joints = {"axle_0"};
    JointControllerSpec hold;
    hold.joints = {"axle_0"};
    Simulation sim(world_of(with(with(with(with(rotor(), hold), force), hold), force)));
    give(sim, {0.01}, 1);
    sim.run(0.199);
    EXPECT_NEAR(speed(sim), 2 * 0.01 / kInertia * 0.2, 1e-6);  // both forces, on one channel
}

JointTrajectoryControllerSpec trajectory() {
    JointTrajectoryControllerSpec spec;
    spec.joints = {"axle_0", "axle_1"};
    spec.initial_positions = {0.3};
    spec.position.p = {8, 4}, spec.position.d = {0.8, 0.4};
    return spec;
}

TEST(JointTrajectoryController, HoldsTheInitialPositionsByItsGains) {
    Simulation sim(world_of(with(rotor(2), trajectory())));
    sim.run(3);
    EXPECT_NEAR(angle(sim, 0), 0.3, 1e-3);
    EXPECT_NEAR(angle(sim, 1), 0, 1e-12);
}

TEST(JointTrajectoryController, PassesThroughItsPointsAndStaysAtTheLast) {
    Simulation sim(world_of(with(rotor(2), trajectory())));
    using Spec = JointTrajectoryControllerSpec;
    const auto memory = [&](int k) {
        return sim.states[0].onboard[static_cast<std::size_t>(sim.type(0).onboard[0].memory_index + k)];
    };
    sim.run(0.5);
    const double points[3][2] = {{1, -0.5}, {-0.7, 0.2}, {0.1, 0.4}};
    std::vector<double> rows;
    for (int k = 0; k < 3; ++k)
        rows.insert(rows.end(), {2.0 * (k + 1), points[k][0], 0, 0, points[k][1], 0, 0});
    give(sim, rows);
    EXPECT_NEAR(memory(Spec::kProgress), 1.0 / 3, 1e-15);
    sim.run(1.999);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(angle(sim, 0), points[k][0], 1e-3) << k;
        EXPECT_NEAR(angle(sim, 1), points[k][1], 1e-3) << k;
        EXPECT_EQ(memory(Spec::kIsActive), k < 2 ? 1 : 0) << k;
        sim.run(2);
    }
    EXPECT_EQ(memory(Spec::kProgress), 1);
    EXPECT_NEAR(angle(sim, 0), points[2][0], 1e-6);
}

TEST(JointTrajectoryController, FollowsVelocitiesAndEfforts) {
    JointTrajectoryControllerSpec spec;
    spec.joints = {"axle_0", "axle_1"};
    spec.velocity.p = {1}, spec.velocity.cmd_min = {-0.5}, spec.velocity.cmd_max = {0.5};
    Simulation sim(world_of(with(rotor(2), spec)));
    give(sim, {0.5, 9, 2, 0, 9, 0, 0.01});  // no gains of position
    sim.run(0.999);
    EXPECT_NEAR(speed(sim, 0), 2, 1e-4);
    EXPECT_NEAR(speed(sim, 1), 0.01 / kInertia, 1e-6);
}

TEST(JointTrajectoryController, ANewTrajectoryReplacesTheOldOne) {
    Simulation sim(world_of(with(rotor(2), trajectory())));
    give(sim, {1, 1, 0, 0, 1, 0, 0, 3, 2, 0, 0, 2, 0, 0});
    sim.run(0.5);
    give(sim, {1, -1, 0, 0, -1, 0, 0});
    sim.run(4);
    EXPECT_NEAR(angle(sim, 0), -1, 1e-3);
    give(sim, {});  // no point: the targets stay
    sim.run(1);
    EXPECT_NEAR(angle(sim, 0), -1, 1e-3);
}

TEST(JointPoseTrajectory, PutsTheJointsAtItsPointsAndLetsThemMoveInBetween) {
    JointPoseTrajectorySpec spec;
    spec.joints = {"axle_0", "axle_1"};
    Simulation sim(world_of(with(rotor(2), spec)));
    sim.states[0].v[1] = 2;
    sim.run(0.1);
    give(sim, {0.05, 1, 3, 0.02, -1, 4});
    EXPECT_NEAR(angle(sim, 0), 1, 1e-12);
    EXPECT_NEAR(angle(sim, 1), 3 + 2 * kDt, 1e-9);
    sim.run(0.049);
    EXPECT_NEAR(angle(sim, 1), 3.1, 1e-9);
    sim.step();
    EXPECT_NEAR(angle(sim, 0), -1, 1e-12);
    EXPECT_NEAR(angle(sim, 1), 4 + 2 * kDt, 1e-9);
    sim.run(1);
    EXPECT_NEAR(angle(sim, 0), -1, 1e-12);
}

/// All controllers of joints on one robot of eight wheels, with commands.
World all_controllers() {
    ModelSpec model = rotor(8);
    JointControllerSpec velocity, force;
    velocity.joints = {"axle_0"}, velocity.initial_velocity = 2;
    force.joints = {"axle_1"}, force.use_force_commands = true, force.pid = {0.3, 0.5, 0, 1, -1, 5, -5, 0};
    JointPositionControllerSpec position, abs;
    position.joints = {"axle_2", "axle_3"}, abs.joints = {"axle_4"};
    abs.use_velocity_commands = true, abs.pid.cmd_max = 3;
    JointTrajectoryControllerSpec path = trajectory();
    path.joints = {"axle_5", "axle_6"};
    ApplyJointForceSpec push;
    push.joints = {"axle_7"};
    model = with(with(with(with(with(with(model, velocity), force), position), abs), path), push);
    World world = empty_world(kDt);
    for (int i = 0; i < 9; ++i) {
        world.instances.push_back({"robot_" + std::to_string(i), 0, {{0, 2.0 * i, 0}, {}}, {}});
    }
    world.prototypes.push_back(std::move(model));
    return world;
}

TEST(JointControllers, GiveTheSameBitsInLanesAndOneByOneAndAcrossBytes) {
    const World world = all_controllers();
    Simulation lanes(world), single(world);
    single.scratch.use_lanes(1);
    for (int i = 0; i < 400; ++i) {
        std::vector<Order> orders;
        for (std::uint32_t c = 0; i == 50 && c < 6; ++c)
            for (std::uint32_t r = 0; r < 9; ++r) {
                std::vector<double> values{0.1 * (r + 1)};
                if (c == 4) values = {0.1, 1, 0, 0, 0.5, 0, 0.01 * r, 0.2, -1, 0, 0, 0.1, 0.2, 0};
                orders.push_back({50, ClientId(std::size_t{0}), 9 * c + r, RobotId(r), Command{c, values}});
            }
        lanes.step(orders), single.step(orders);
        ASSERT_EQ(lanes.hash(), single.hash()) << i;
        if (i % 100 != 99) continue;
        for (std::size_t r = 0; r < single.states.size(); ++r) {  // as if it had moved to another Simulator
            std::vector<std::uint8_t> bytes;
            encode(single.states[r], bytes);
            single.states[r] = decode_state(bytes, single.type(r)).value();
        }
    }
    EXPECT_NE(lanes.states[1].v[7], lanes.states[2].v[7]);
}

}  // namespace
}  // namespace roboss::test
