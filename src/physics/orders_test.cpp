// The four levels of orders in a step: pose, velocity, force and torque, joint setpoint.
#include <gtest/gtest.h>

#include <functional>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const RobotId kFirst(std::size_t{0});
const LinkId kLink(std::size_t{0});

Order order(Tick tick, Action action, std::uint64_t sequence = 0) {
    return {tick, ClientId(std::size_t{0}), sequence, kFirst, std::move(action)};
}

World floating_box() {
    World world = empty_world(1e-3, {});
    place(world, solid_box(2.0, {0.1, 0.2, 0.3}, surface(0.5)), "box", {{0, 0, 1}, {}});
    return world;
}

void step_with(Simulation& sim, std::vector<Order> orders) {
    for (const Order& o : orders) {
        const Result<> checked = check_order(*sim.model, o);
        ASSERT_TRUE(checked.ok()) << checked.error().text();
    }
    sim.step(orders);
}

TEST(Orders, SetPosePutsTheModelFrameThere) {
    World world = empty_world(1e-3, {});
    place(world, car(), "car");  // its chassis is 5 cm above the model frame
    Simulation sim(world);
    const Pose X_WM{{3, -2, 1}, from_rpy(0.1, 0.2, 2)};
    sim.run(0.01);
    step_with(sim, {order(sim.tick, SetPose{X_WM})});
    const Transform X = link_pose(sim.type(0), sim.states[0], kLink);
    const Pose expected = X_WM * Pose{{0, 0, 0.05}, {}};
    EXPECT_LT(norm(X.p - expected.p), 1e-12);
    EXPECT_LT(norm(X.R.r0 - to_matrix(expected.q).r0), 1e-12);
}

TEST(Orders, SetPoseKeepsJointsAndVelocities) {
    World world = empty_world(1e-3, {});
    place(world, car(), "car");
    Simulation sim(world);
    sim.states[0].q[8] = 0.7;
    sim.states[0].v[7] = 0;
    sim.states[0].v[3] = 0.5;
    step_with(sim, {order(0, SetPose{{{1, 0, 0}, {}}})});
    EXPECT_NEAR(sim.states[0].q[8], 0.7, 1e-14);
    EXPECT_NEAR(sim.states[0].v[3], 0.5, 1e-14);
    EXPECT_NEAR(sim.states[0].q[0], 1.0005, 1e-12);
}

TEST(Orders, SetVelocitySetsTheBaseVelocity) {
    Simulation sim(floating_box());
    step_with(sim, {order(0, SetVelocity{{1, 2, 3}, {0, 0, 0}})});
    for (int i = 1; i < 1000; ++i) sim.step();
    EXPECT_NEAR(sim.states[0].q[0], 1, 1e-12);
    EXPECT_NEAR(sim.states[0].q[1], 2, 1e-12);
    EXPECT_NEAR(sim.states[0].q[2], 4, 1e-12);
}

TEST(Orders, ForceGivesMassTimesAccelerationForItsDurationAndNoLonger) {
    Simulation sim(floating_box());
    step_with(sim, {order(0, ApplyWrench{kLink, {3, 0, -1}, {}, 100})});
    for (int i = 1; i < 100; ++i) sim.step();
    EXPECT_NEAR(sim.states[0].v[3], 3.0 / 2 * 0.1, 1e-13);
    EXPECT_NEAR(sim.states[0].v[5], -1.0 / 2 * 0.1, 1e-13);
    EXPECT_TRUE(sim.states[0].wrenches.empty());
    const double v = sim.states[0].v[3];
    sim.run(0.1);
    EXPECT_EQ(sim.states[0].v[3], v);
}

TEST(Orders, TorqueGivesAngularAccelerationAboutAPrincipalAxis) {
    Simulation sim(floating_box());
    step_with(sim, {order(0, ApplyWrench{kLink, {}, {0, 0.2, 0}, 500})});
    for (int i = 1; i < 500; ++i) sim.step();
    const double inertia = box_inertia(2.0, {0.1, 0.2, 0.3})(1, 1);
    EXPECT_NEAR(sim.states[0].v[1] / (0.2 * 0.5 / inertia), 1, 1e-10);
    EXPECT_LT(norm(Vec3{sim.states[0].v[3], sim.states[0].v[4], sim.states[0].v[5]}), 1e-12);
}

TEST(Orders, ForceActsAtTheCentreOfMassOfTheLink) {
    World world = floating_box();
    world.prototypes[0].links[0].p_LC = {0.3, 0, 0};
    Simulation sim(world);
    step_with(sim, {order(0, ApplyWrench{kLink, {0, 0, 4}, {}, 1})});
    EXPECT_NEAR(sim.states[0].v[5], 4.0 / 2 * 1e-3, 1e-15);
    EXPECT_NEAR(sim.states[0].v[1], 0, 1e-15);
}

TEST(Orders, WrenchesOfOneTickAddUp) {
    Simulation sim(floating_box());
    step_with(sim, {order(0, ApplyWrench{kLink, {1, 0, 0}, {}, 1}),
                    order(0, ApplyWrench{kLink, {2, 0, 0}, {}, 2}, 1)});
    EXPECT_NEAR(sim.states[0].v[3], 3.0 / 2 * 1e-3, 1e-15);
    sim.step();
    EXPECT_NEAR(sim.states[0].v[3], 5.0 / 2 * 1e-3, 1e-15);
}

TEST(Orders, JointSetpointLatchesAndTheLastOrderOfATickWins) {
    World world = empty_world(1e-3, {});
    ModelSpec model = pendulum();
    model.joints[0].axes[0].max_effort = 10;
    place(world, model, "pendulum");
    Simulation sim(world);
    const JointId joint(std::size_t{0});
    step_with(sim, {order(0, SetJoint{joint, 0, MotorMode::kVelocity, 5, 3}),
                    order(0, SetJoint{joint, 0, MotorMode::kVelocity, 0.5, 100}, 1)});
    const MotorSetpoint& motor = sim.states[0].motors[0];
    EXPECT_EQ(motor.mode, MotorMode::kVelocity);
    EXPECT_EQ(motor.target, 0.5);
    EXPECT_EQ(motor.max_effort, 10) << "never more than the axis' effort";
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0], 0.5, 1e-9);
}

TEST(Orders, AMotorKeepsItsLoadFromOrderToOrderOfAModeAndLosesItWithTheMode) {
    World world = empty_world(1e-3, {});
    place(world, pendulum(), "pendulum");
    Simulation sim(world);
    MotorSetpoint& motor = sim.states[0].motors[0];
    motor = {MotorMode::kPosition, 0, 10, 0.5, 0.25};
    const auto drive = [&](MotorMode mode) {
        apply_order(*sim.model, order(0, SetJoint{JointId(std::size_t{0}), 0, mode, 1, 3}), sim.states[0]);
    };
    drive(MotorMode::kPosition);
    EXPECT_EQ(motor, (MotorSetpoint{MotorMode::kPosition, 1, 3, 0.5, 0.25}));
    drive(MotorMode::kPassive);
    EXPECT_EQ(motor, (MotorSetpoint{MotorMode::kPassive, 1, 3}));
}

TEST(Orders, OrdersForRobotsOutsideTheIslandAreLeftAlone) {
    Simulation sim(floating_box());
    Order other = order(0, SetVelocity{{1, 0, 0}, {}});
    other.robot = RobotId(std::size_t{7});
    sim.step({&other, 1});
    EXPECT_EQ(sim.states[0].v[3], 0);
}

/// The step tells whose state is not finite: the lowest robot, and the joint or the base.
TEST(NotFinite, NamesTheLowestRobotAndItsJoint) {
    World world = empty_world(1e-3);
    for (int i = 0; i < 4; ++i) place(world, car(), "car_" + std::to_string(i), {{10.0 * i, 0, 5}, {}});
    const auto report_of = [&](const std::function<void(Simulation&)>& spoil) {
        Simulation sim(world);
        spoil(sim);
        return sim.step();
    };
    constexpr std::size_t kWheel = 2, kBase = 6;
    StepReport report =
        report_of([](Simulation& sim) { sim.states[3].v[5] = sim.states[1].v[kBase + kWheel] = 1e308; });
    EXPECT_EQ(report.not_finite, RobotId(1u));
    EXPECT_EQ(report.not_finite_joint, JointId(kWheel));
    EXPECT_TRUE(report.beyond_numbers);
    report = report_of([](Simulation& sim) { sim.states[3].v[5] = 1e308; });
    EXPECT_EQ(report.not_finite, RobotId(3u));
    EXPECT_FALSE(report.not_finite_joint.valid()) << "its base";
    EXPECT_FALSE(report_of([](Simulation&) {}).not_finite.valid());
}

TEST(NotFinite, NamesTheFirstJointWhereTheStepItselfLeadsToInfinity) {
    World world = empty_world(1e-3);
    place(world, arm(), "arm");
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kEffort, 1);  // without a row it would spin on
    sim.states[0].v[2] = 1e200;                  // it has no shapes, so nothing shows before the step
    const StepReport& report = sim.step();
    EXPECT_EQ(report.not_finite, RobotId(0u));
    EXPECT_EQ(report.not_finite_joint, JointId(0u)) << "all its joints are coupled";
    EXPECT_FALSE(report.beyond_numbers);
}

}  // namespace
}  // namespace roboss::test
