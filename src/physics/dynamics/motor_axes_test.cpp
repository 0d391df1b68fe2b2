// Motors on every kind of axis: hinge, slide, screw, both axes of universal and revolute2 joints, ball
// joints, and joints that close loops.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

/// An arm on the ground with every kind of joint, a ball joint at its end.
World arm_of_all_kinds() {
    ModelSpec m = ring_of_all_kinds(JointSpecKind::kBall);
    m.joints.back() = joint(JointSpecKind::kBall, "ball", "tip", "bob", {{0, 0.1, 0}, from_rpy(0.2, 0, 0.4)});
    m.links.push_back(link("bob", 0.5, Mat3::diagonal(0.02, 0.03, 0.025), {{0, 0.05, 0.02}, {}}));
    m.joints.push_back(joint(JointSpecKind::kFixed, "ground", "world", "base", {}));
    for (JointSpec& j : m.joints)
        for (AxisSpec& axis : j.axes) axis.damping = axis.spring_stiffness = 0;
    World world = empty_world(1e-3, {});
    place(world, m, "arm");
    return world;
}

class MotorAxis : public testing::TestWithParam<std::size_t> {
  protected:
    MotorAxis() : sim_(arm_of_all_kinds()) {}
    double& v() { return sim_.states[0].v[GetParam()]; }
    bool is_ball() const {
        const Dof& dof = sim_.type(0).dofs[GetParam()];
        return sim_.type(0).bodies[static_cast<std::size_t>(dof.body)].joint == JointKind::kBall;
    }
    void set(MotorMode mode, double target, double max_effort) {
        sim_.states[0].motors[GetParam()] = {mode, target, max_effort};
    }
    Simulation sim_;
};

TEST_P(MotorAxis, StallForceIsExact) {
    Simulation pushed(arm_of_all_kinds());
    pushed.states[0].motors[GetParam()] = {MotorMode::kEffort, 0.7, 10};
    set(MotorMode::kVelocity, 1e3, 0.7);
    pushed.step();
    sim_.step();
    ASSERT_GT(v(), 0);
    for (std::size_t i = 0; i < sim_.states[0].v.size(); ++i)
        EXPECT_NEAR(sim_.states[0].v[i], pushed.states[0].v[i], 1e-9 * v()) << "entry " << i;
}

TEST_P(MotorAxis, VelocityIsReachedAndKept) {
    set(MotorMode::kVelocity, 0.3, 1e4);
    sim_.run(0.2);
    EXPECT_NEAR(v(), 0.3, 1e-6);
}

TEST_P(MotorAxis, PositionIsReachedAndKept) {
    if (is_ball()) return;  // takes no position order per axis (order.cpp)
    for (std::size_t d = 0; d < sim_.states[0].motors.size(); ++d)
        sim_.states[0].motors[d] = {MotorMode::kVelocity, 0, 1e4};  // the others stand
    set(MotorMode::kPosition, 0.2, 50);
    sim_.run(2);
    const Body& body = sim_.type(0).bodies[static_cast<std::size_t>(sim_.type(0).dofs[GetParam()].body)];
    EXPECT_NEAR(sim_.states[0].q[static_cast<std::size_t>(body.q_index)], 0.2, 1e-7);
    EXPECT_NEAR(v(), 0, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(All, MotorAxis, testing::Range(std::size_t{0}, std::size_t{11}));

TEST(MotorAxes, ThereAreElevenOfThem) {
    const Simulation sim(arm_of_all_kinds());
    EXPECT_EQ(sim.type(0).dofs.size(), 11u) << "1 + 1 + 1 + 2 + 2 + 1 + 3";
}

/// The closing hinge of a linkage driven by its own motor, against the same linkage cut at another joint.
TEST(MotorAxes, MotorOfAJointThatClosesALoopPushesAsOneInTheTree) {
    const auto speed = [](bool in_tree) {
        ModelSpec m = four_bar();
        if (in_tree) std::swap(m.joints[0], m.joints[3]);
        World world = empty_world(1e-4, {});
        place(world, m, "linkage");
        Simulation sim(world);
        const RobotType& type = sim.type(0);
        const JointId closing = *type.find_joint("closing");
        EXPECT_EQ(type.joints[closing.index()].loop < 0, in_tree);
        sim.states[0].motors[type.motor_index(type.joints[closing.index()], 0)] = {MotorMode::kVelocity, 1e3,
                                                                                   0.4};
        sim.step();
        return joint_state(type, sim.states[0], closing).velocity;
    };
    const double of_tree = speed(true), of_loop = speed(false);
    tell("relative difference of the first tick's speed", of_loop / of_tree - 1);
    EXPECT_GT(of_tree, 0);
    EXPECT_NEAR(of_loop / of_tree, 1, 2e-5) << "as exact as Accuracy::compliance";
}

}  // namespace
}  // namespace roboss::test
