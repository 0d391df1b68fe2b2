// Grippers and detachable joints in the step: what they take, bear, lose and let go.
#include <gtest/gtest.h>

#include <support/bonds.h>

namespace roboss::test {
namespace {

GripperSpec cup() {
    GripperSpec gripper;
    gripper.link = {"hand"};
    gripper.X_LC = {{0, 0, -0.05}, {}};  // the middle of the hand's lower side
    return gripper;
}

World gripper_world(const OnboardParameters& parameters, double z_box = 1.845) {
    World world = empty_world(1e-3);
    ModelSpec crane = gantry();
    crane.onboard.push_back({"gripper", parameters, {}});
    place(world, crane, "crane", {{0, 0, 2}, {}});
    place(world, solid_box(3.0, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0, 0, z_box}, {}});
    return world;
}

void hold_still(Simulation& sim) {
    for (std::size_t d = 0; d < 4; ++d) sim.set_motor(0, d, MotorMode::kVelocity, 0);
}

void command(Simulation& sim, const std::string& channel, std::vector<double> values = {}) {
    const auto number = sim.type(0).find_channel(channel);
    ASSERT_TRUE(number.has_value()) << channel;
    const Order order = order_for(sim, 0, Command{static_cast<std::uint32_t>(*number), std::move(values)});
    const Result<> checked = check_order(*sim.model, order);
    ASSERT_TRUE(checked.ok()) << checked.error().text();
    sim.step({&order, 1});
}

std::size_t held_by(const Simulation& sim) {
    return sim.states[0].bonds.size();
}

TEST(Gripper, TakesWhatIsInReachOnCommandAndLetsGo) {
    Simulation sim(gripper_world(cup()));
    hold_still(sim);
    ASSERT_NO_FATAL_FAILURE(command(sim, "hand/grip", {1}));
    ASSERT_EQ(held_by(sim), 1u);
    EXPECT_EQ(sim.states[0].bonds[0].other, 1u);
    const double z = sim.states[1].q[2];
    sim.run(1);
    EXPECT_NEAR(sim.states[1].q[2], z, 1e-6);
    EXPECT_NEAR(sim.states[0].bonds[0].force_impulse.z, 3 * 9.81e-3, 1e-9);
    ASSERT_NO_FATAL_FAILURE(command(sim, "hand/grip", {0}));
    EXPECT_EQ(held_by(sim), 0u);
    sim.run(0.5);
    EXPECT_NEAR(sim.states[1].q[2], z - 0.5 * 9.81 * 0.25, 2e-2);
}

TEST(Gripper, FindsNothingBeyondItsReachAndTakesWhatComesNear) {
    GripperSpec gripper = cup();
    gripper.on = true, gripper.reach = 0.004;
    Simulation sim(gripper_world(gripper));  // the box is 5 mm below the cup
    hold_still(sim);
    sim.states[1].v[5] = 0.3;  // and comes up
    sim.step();
    EXPECT_EQ(held_by(sim), 0u);
    sim.run(0.1);
    EXPECT_EQ(held_by(sim), 1u);
}

TEST(Gripper, CatchesWhatFliesByWithMoreThanItsForce) {
    GripperSpec gripper = cup();
    gripper.on = true, gripper.max_force = 60;
    Simulation sim(gripper_world(gripper));
    hold_still(sim);
    sim.states[1].v = {0, 0, 0, 0.3, 0, 0};  // 900 N in one tick
    sim.step();
    ASSERT_EQ(held_by(sim), 1u);
    sim.run(0.5);
    EXPECT_EQ(held_by(sim), 1u) << "the blow does not count";
}

TEST(Gripper, LetsGoAtItsForceAndWaitsForACommand) {
    GripperSpec gripper = cup();
    gripper.on = true, gripper.max_force = 40;
    Simulation sim(gripper_world(gripper));
    hold_still(sim);
    sim.step();
    ASSERT_EQ(held_by(sim), 1u);
    double pull = 0;
    while (held_by(sim) == 1 && sim.time() < 10) {
        pull += 4e-3;
        const Order order = order_for(sim, 1, ApplyWrench{kFirstLink, {0, 0, -pull}, {}, 1});
        sim.step({&order, 1});
    }
    EXPECT_NEAR(pull + 3 * 9.81, 40, 0.4);
    sim.states[1].q[2] = 1.846, sim.states[1].v.assign(6, 0.0);
    sim.step();
    EXPECT_EQ(held_by(sim), 0u) << "it does not take again what it lost";
    sim.states[1].q[2] = 1.846, sim.states[1].v.assign(6, 0.0);
    ASSERT_NO_FATAL_FAILURE(command(sim, "hand/grip", {1}));
    EXPECT_EQ(held_by(sim), 1u);
}

TEST(Gripper, HoldsItselfToTheScenery) {
    GripperSpec gripper = cup();
    gripper.link = {"box"}, gripper.X_LC = {{0, 0, 0.1}, {}}, gripper.on = true;
    for (const bool plane : {false, true}) {
        World world = empty_world(1e-3);
        ModelSpec climber = solid_box(2.0, {0.2, 0.2, 0.2}, surface(0.5));
        climber.onboard.push_back({"gripper", gripper, {}});
        place(world, climber, "climber", {{0, 0, 0.895}, {}});
        ModelSpec ceiling = scenery(plane ? collision(GeometryKind::kPlane, surface(0.5))
                                          : box_shape({4, 4, 0.2}, surface(0.5)));
        place(world, ceiling, "ceiling",
              plane ? Pose{{0, 0, 1}, from_rpy(3.14159265358979, 0, 0)} : Pose{{0, 0, 1.1}, {}});
        Simulation sim(world);
        sim.run(2);
        ASSERT_EQ(held_by(sim), 1u) << plane;
        EXPECT_EQ(sim.states[0].bonds[0].other, RobotId::kNone);
        EXPECT_NEAR(sim.states[0].q[2], 0.895, 1e-9);
        EXPECT_NEAR(sim.states[0].bonds[0].force_impulse.z, -2 * 9.81e-3, 1e-6) << "it pulls the ceiling";
        ASSERT_NO_FATAL_FAILURE(command(sim, "box/grip", {0}));
        sim.run(0.1);
        EXPECT_LT(sim.states[0].q[2], 0.88);
    }
}

DetachableJointSpec hook(const std::string& child = "box") {
    DetachableJointSpec spec;
    spec.parent_link = {"hand"}, spec.child_model = child, spec.child_link = "box";
    return spec;
}

TEST(DetachableJoint, HoldsFromTheStartAndObeysCommands) {
    Simulation sim(gripper_world(hook(), 1.5));  // no collision shape touches: there is no limit of distance
    hold_still(sim);
    sim.run(1);
    ASSERT_EQ(held_by(sim), 1u);
    EXPECT_NEAR(sim.states[1].q[2], 1.5, 1e-6);
    ASSERT_NO_FATAL_FAILURE(command(sim, "detachable_joint/detach"));
    EXPECT_EQ(held_by(sim), 0u);
    sim.run(0.2);
    EXPECT_LT(sim.states[1].q[2], 1.35);
    ASSERT_NO_FATAL_FAILURE(command(sim, "detachable_joint/attach"));
    ASSERT_EQ(held_by(sim), 1u);
    const double z = sim.states[1].q[2];
    sim.run(0.5);
    EXPECT_NEAR(sim.states[1].q[2], z, 1e-2) << "where it was at that moment";
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
}

TEST(DetachableJoint, OfAChildThatIsNotThereDoesNothing) {
    Simulation sim(gripper_world(hook("crate"), 1.5));
    sim.run(0.5);
    EXPECT_EQ(held_by(sim), 0u);
}

}  // namespace
}  // namespace roboss::test
