// A screw: one degree of freedom that turns and slides, against closed form; and a ball joint that the tree
// walks backwards, which keeps the file's convention.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kPitch = 0.05;  // m per radian

/// A nut on a spindle along z, `mass` 2 kg, turned about its axis by its joint.
ModelSpec nut(double pitch) {
    LinkSpec l = link("nut", 2.0, Mat3::diagonal(0.02, 0.03, 0.004), {{0, 0, 1}, {}});
    ModelSpec m = one_link(l);
    m.joints.push_back(joint(JointSpecKind::kScrew, "thread", "world", "nut", {{0, 0, 1}, {}}, {0, 0, 1}));
    m.joints[0].screw_pitch = pitch;
    return m;
}

World with(const ModelSpec& model, const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(1e-3, gravity);
    place(world, model, "robot");
    return world;
}

TEST(Screw, NutFallsAsItsTurningMassAllows) {
    for (const double pitch : {kPitch, -kPitch}) {
        Simulation sim(with(nut(pitch)));
        sim.run(1);
        const double a = -9.81 / (1 + 0.004 / (2.0 * pitch * pitch));
        const Transform X = link_pose(sim.type(0), sim.states[0], LinkId(std::size_t{0}));
        EXPECT_NEAR((X.p.z - 1) / (0.5 * a), 1, 1e-12);
        EXPECT_NEAR(sim.states[0].v[0] / (a / pitch), 1, 1e-12)
            << "a right-handed thread turns clockwise down";
        const Twist twist = link_twist(sim.type(0), sim.states[0], LinkId(std::size_t{0}));
        EXPECT_NEAR(twist.linear.z / a, 1, 1e-12);
        EXPECT_NEAR(twist.angular.z, sim.states[0].v[0], 1e-12);
    }
}

TEST(Screw, TorqueOfAPitchTimesTheWeightHoldsTheNut) {
    Simulation sim(with(nut(kPitch)));
    sim.set_motor(0, 0, MotorMode::kEffort, 2.0 * 9.81 * kPitch);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].v[0], 0, 1e-12);
}

TEST(Screw, VelocityMotorLiftsTheNutExactly) {
    Simulation sim(with(nut(kPitch)));
    sim.set_motor(0, 0, MotorMode::kVelocity, 4.0);
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0], 4.0, 1e-6);
    EXPECT_NEAR(link_pose(sim.type(0), sim.states[0], LinkId(std::size_t{0})).p.z - 1, 4.0 * kPitch, 1e-6);
}

TEST(Screw, LimitIsAnAngle) {
    ModelSpec m = nut(kPitch);
    m.joints[0].axes[0].lower = -3;
    Simulation sim(with(m));
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[7], -3, 1e-5);
}

/// A spindle's nut that carries an arm, free in space: what the thread does inside changes neither momentum.
TEST(Screw, FreeMotionKeepsEnergyAndMomentum) {
    ModelSpec m;
    m.name = m.canonical_link = "spindle";
    m.links.push_back(link("spindle", 1.5, Mat3::diagonal(0.04, 0.03, 0.01)));
    m.links.push_back(link("nut", 0.7, Mat3::diagonal(0.004, 0.006, 0.005), {{0.1, 0.05, 0.2}, {}}));
    m.links[1].p_LC = {0.1, 0.02, 0.0};
    m.joints.push_back(joint(JointSpecKind::kScrew, "thread", "spindle", "nut",
                             {{0.1, 0.05, 0.2}, from_rpy(0.3, -0.2, 0.5)}, {0.2, 0.3, 1}));
    m.joints[0].screw_pitch = 0.03;
    Simulation sim(with(m, {}));
    sim.states[0].v = {1, -2, 0.5, 0.3, 0.2, -0.1, 6};
    const double energy = sim.energy();
    const Momentum before = sim.momentum();
    sim.run(5);
    const Momentum after = sim.momentum();
    EXPECT_NEAR(sim.energy() / energy, 1, 1e-9);
    EXPECT_LT(norm(after.linear - before.linear), 1e-9);
    EXPECT_LT(norm(after.angular - before.angular), 1e-9);
}

/// Two links on a ball joint; the tree starts at the world and the file's child, so that it walks the ball
/// joint backwards.
ModelSpec ball_pair() {
    ModelSpec m;
    m.name = "pair";
    m.canonical_link = "child";
    m.links.push_back(link("child", 1.0, Mat3::diagonal(0.01, 0.02, 0.025)));
    m.links.push_back(
        link("parent", 2.0, Mat3::diagonal(0.04, 0.03, 0.05), {{0.4, 0, 0}, from_rpy(0, 0, 1)}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "child", {}, {0, 0, 1}));
    m.joints.push_back(
        joint(JointSpecKind::kBall, "ball", "parent", "child", {{0.15, 0.1, 0}, from_rpy(0.3, 0.2, 0.1)}));
    return m;
}

TEST(ReversedBall, CoordinatesAndVelocitiesAreThoseOfTheFile) {
    Simulation sim(with(ball_pair(), {}));
    const RobotType& type = sim.type(0);
    const Joint& ball = type.joints[type.find_joint("ball")->index()];
    ASSERT_TRUE(ball.reversed);
    Random random(3);
    const Quat turned = random.rotation();
    RobotState& state = sim.states[0];
    const auto q = static_cast<std::size_t>(ball.q_index), v = static_cast<std::size_t>(ball.v_index);
    state.q[q] = turned.w, state.q[q + 1] = turned.x, state.q[q + 2] = turned.y, state.q[q + 3] = turned.z;
    const Vec3 w{0.3, -0.7, 1.1};
    for (std::size_t k = 0; k < 3; ++k) state.v[v + k] = w[k];
    state.v[0] = 0.4;
    const LinkId parent = *type.find_link("parent"), child = *type.find_link("child");
    // Joint frames fixed in both links, from the file's poses.
    const Transform X_MJ = to_transform(sim.world.prototypes[0].joints[1].X_MJ);
    const Transform X_MP = to_transform(sim.world.prototypes[0].links[1].X_ML);
    const Mat3 R_WJp = link_pose(type, state, parent).R * (inverse(X_MP) * X_MJ).R;
    const Mat3 R_WJc = link_pose(type, state, child).R * X_MJ.R;
    const Mat3 R = transpose(R_WJp) * R_WJc;
    for (std::size_t r = 0; r < 3; ++r) EXPECT_LT(norm(R.row(r) - to_matrix(turned).row(r)), 1e-14);
    const Vec3 relative = link_twist(type, state, child).angular - link_twist(type, state, parent).angular;
    EXPECT_LT(norm(transpose_times(R_WJp, relative) - w), 1e-14);
}

TEST(ReversedBall, FreeMotionKeepsEnergy) {
    Simulation sim(with(ball_pair()));
    for (std::size_t k = 0; k < sim.states[0].v.size(); ++k)
        sim.states[0].v[k] = 1.0 + static_cast<double>(k);
    const double energy = sim.energy();
    sim.run(3);
    EXPECT_NEAR(sim.energy() - energy, 0, 1e-7 * std::fabs(energy));
}

}  // namespace
}  // namespace roboss::test
