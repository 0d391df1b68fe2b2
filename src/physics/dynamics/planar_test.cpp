// A planar joint: two translations in a plane and a turn about its normal, against closed form.
#include <gtest/gtest.h>

#include <cmath>

#include <support/mechanisms.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kMass = 2, kInertia = 0.1;
constexpr LinkId kPuck{0u};

/// A puck on the plane through the model's origin; its centre of mass stands 0.1 m beside its origin.
ModelSpec puck(const Quat& plane = {}) {
    LinkSpec l = link("puck", kMass, Mat3::diagonal(0.06, 0.07, kInertia), {{}, plane});
    l.p_LC = {0.1, 0, 0};
    ModelSpec m = one_link(l);
    m.joints.push_back(planar_joint("plane", "world", "puck", {{}, plane}, {0, 0, 1}));
    return m;
}

World with(const ModelSpec& model, const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(1e-3, gravity);
    place(world, model, "robot");
    return world;
}

Vec3 centre_of(const Simulation& sim) {
    return link_pose(sim.type(0), sim.states[0], kPuck) * Vec3{0.1, 0, 0};
}

TEST(Planar, FreePuckGoesStraightAndSpinsEvenly) {
    Simulation sim(with(puck()));
    ASSERT_EQ(sim.type(0).nv, 3);
    sim.states[0].v = {0.5, -0.3, 2.0};
    const double energy = sim.energy();
    sim.run(3);
    // The centre starts at (0.1, 0) with the velocity of the origin and w x arm.
    EXPECT_LT(norm(centre_of(sim) - Vec3{0.1 + 3 * 0.5, 3 * (-0.3 + 2.0 * 0.1), 0}), 1e-9)
        << "gravity across the plane does nothing";
    EXPECT_NEAR(sim.states[0].q[9], 6, 1e-10);
    EXPECT_NEAR(sim.energy() / energy, 1, 1e-10);
}

TEST(Planar, PuckFallsAlongATiltedPlane) {
    const double tilt = 0.4;
    Simulation sim(with(puck(from_rpy(0, tilt, 0))));
    sim.run(1);
    const double fallen = 0.5 * 9.81 * std::sin(tilt);
    EXPECT_NEAR(sim.states[0].q[7], fallen, 1e-9) << "x of the plane points down by the tilt";
    EXPECT_NEAR(sim.states[0].q[8], 0, 1e-12);
    EXPECT_NEAR(sim.states[0].q[9], 0, 1e-12);
}

TEST(Planar, EachAxisHasItsOwnMotor) {
    Simulation sim(with(puck()));
    sim.set_motor(0, 0, MotorMode::kEffort, 3);
    sim.run(1);
    const Vec3 pushed = centre_of(sim);
    // The force acts at the origin's joint, along x through the centre: it does not turn the puck.
    EXPECT_NEAR(sim.states[0].v[0], 3 / kMass, 1e-9);
    EXPECT_NEAR(pushed.x - 0.1, 0.5 * 3 / kMass, 2e-3);
    EXPECT_NEAR(sim.states[0].q[9], 0, 1e-9);

    Simulation turned(with(puck()));
    for (const std::size_t axis : {0, 1}) turned.set_motor(0, axis, MotorMode::kVelocity, 0);
    turned.set_motor(0, 2, MotorMode::kEffort, 0.2);
    turned.run(1);
    EXPECT_NEAR(turned.states[0].v[2] / (0.2 / (kInertia + kMass * 0.01)), 1, 1e-6)
        << "about its held origin";

    Simulation led(with(puck()));
    const double targets[] = {0.3, -0.2, 1.0};
    for (std::size_t axis = 0; axis < 3; ++axis) led.set_motor(0, axis, MotorMode::kPosition, targets[axis]);
    led.run(3);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(led.states[0].q[7 + axis], targets[axis], 1e-6);
}

TEST(Planar, OrdersCountItsThreeAxes) {
    Simulation sim(with(puck()));
    const auto allowed = [&](int axis, MotorMode mode) {
        SetJoint action;
        action.joint = JointId(0u);
        action.axis = axis, action.mode = mode, action.target = 0.5;
        Order order;
        order.robot = RobotId(0u), order.action = action;
        return check_order(*sim.model, order).ok();
    };
    for (const int axis : {0, 1, 2}) EXPECT_TRUE(allowed(axis, MotorMode::kPosition)) << axis;
    EXPECT_FALSE(allowed(3, MotorMode::kVelocity));
}

TEST(Planar, DampingAndLimitsAreOfAnAxis) {
    ModelSpec m = puck();
    m.links[0].p_LC = {};
    m.joints[0].axes[0].damping = 4;
    m.joints[0].axes[1].upper = 0.2;
    Simulation sim(with(m));
    sim.states[0].v = {1, 1, 1};
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0], std::exp(-4 / kMass), 2e-3);
    EXPECT_NEAR(sim.states[0].q[8], 0.2, 1e-5);
    EXPECT_NEAR(sim.states[0].v[2], 1, 1e-9) << "nothing brakes the turn";
}

/// A rod that hangs below a puck: nothing but the plane holds them.
TEST(Planar, PendulumOnAPuckKeepsEnergyAndHorizontalMomentum) {
    ModelSpec m = puck();
    m.links.push_back(rod("rod", 1.0, 0.6, {{0.05, 0.02, 0}, {}}));
    m.joints.push_back(
        joint(JointSpecKind::kRevolute, "hinge", "puck", "rod", m.links.back().X_ML, {0.3, 1, 0}));
    m.joints.back().axes[0].initial_position = 1.2;
    Simulation sim(with(m));
    sim.states[0].v = {0.4, -0.2, 1.5, 0.5};
    const double energy = sim.energy();
    const Momentum before = sim.momentum();
    sim.run(5);
    const Momentum after = sim.momentum();
    EXPECT_NEAR(sim.energy() - energy, 0, 1e-8);
    EXPECT_NEAR(after.linear.x, before.linear.x, 1e-8);
    EXPECT_NEAR(after.linear.y, before.linear.y, 1e-8);
    EXPECT_NEAR(after.angular.z, before.angular.z, 1e-8) << "the plane gives no torque about its normal";
}

/// The tree starts at the world and the file's child, so that it walks the planar joint backwards.
TEST(Planar, CoordinatesAreThoseOfTheFileInEitherDirection) {
    ModelSpec m;
    m.name = "pair";
    m.canonical_link = "child";
    m.links.push_back(link("child", 1.0, Mat3::diagonal(0.01, 0.02, 0.025)));
    m.links.push_back(
        link("parent", 2.0, Mat3::diagonal(0.04, 0.03, 0.05), {{0.4, 0, 0}, from_rpy(0, 0, 1)}));
    const Pose X_MJ{{0.15, 0.1, 0}, from_rpy(0.3, 0.2, 0.1)};
    m.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "child", {}, {0, 0, 1}));
    m.joints.push_back(planar_joint("plane", "parent", "child", X_MJ, {0, 0, 1}));
    Simulation sim(with(m, {}));
    const RobotType& type = sim.type(0);
    const JointId id = *type.find_joint("plane");
    const Joint& plane = type.joints[id.index()];
    ASSERT_TRUE(plane.reversed);
    RobotState& state = sim.states[0];
    const double q[] = {0.3, -0.2, 0.7}, v[] = {0.5, 0.4, -1.1};
    for (int axis = 0; axis < 3; ++axis) {
        const int at = plane.axis_offset(axis);
        state.q[static_cast<std::size_t>(plane.q_index + at)] = q[axis];
        state.v[static_cast<std::size_t>(plane.v_index + at)] = v[axis];
        EXPECT_EQ(joint_state(type, state, id, axis).position, q[axis]);
        EXPECT_EQ(joint_state(type, state, id, axis).velocity, v[axis]);
    }
    const LinkId parent = *type.find_link("parent"), child = *type.find_link("child");
    const Transform X_J = to_transform(X_MJ);
    const Transform X_WJp = link_pose(type, state, parent) * inverse(to_transform(m.links[1].X_ML)) * X_J;
    const Transform X_WJc = link_pose(type, state, child) * X_J;
    const Transform X = inverse(X_WJp) * X_WJc;
    EXPECT_LT(norm(X.p - Vec3{q[0], q[1], 0}), 1e-14);
    const Mat3 R = to_matrix(axis_angle({0, 0, 1}, q[2]));
    for (std::size_t r = 0; r < 3; ++r) EXPECT_LT(norm(X.R.row(r) - R.row(r)), 1e-14);
}

/// A crank on a ball at the world carries a puck on a ball; only the planar joint, which closes the loop,
/// holds both against gravity.
TEST(Planar, HoldsTheLoopThatItCloses) {
    ModelSpec m;
    m.name = "crank";
    m.canonical_link = "crank";
    m.links.push_back(rod_between("crank", {0, 0, 0}, {0.5, 0, 0}));
    m.links.push_back(link("puck", kMass, Mat3::diagonal(0.06, 0.07, kInertia), {{0.5, 0, 0}, {}}));
    m.joints.push_back(joint(JointSpecKind::kBall, "root", "world", "crank", {}));
    m.joints.push_back(joint(JointSpecKind::kBall, "tip", "crank", "puck", {{0.5, 0, 0}, {}}));
    m.joints[0].ball_damping = m.joints[1].ball_damping = 0;
    m.joints.push_back(planar_joint("plane", "world", "puck", {{0.5, 0, 0}, {}}, {0, 0, 1}));
    Simulation sim(with(m));
    const RobotType& type = sim.type(0);
    const JointId id = *type.find_joint("plane");
    ASSERT_GE(type.joints[id.index()].loop, 0) << "of equals the last joint is cut";
    const double turning = 2;
    sim.states[0].v[2] = turning;
    const double energy = sim.energy();
    sim.run(2);
    const LinkId tip = *type.find_link("puck");
    const Transform X = link_pose(type, sim.states[0], tip);
    EXPECT_NEAR(X.p.z, 0, 1e-9);
    EXPECT_NEAR(X.R.r2.z, 1, 1e-9) << "it stays level";
    EXPECT_NEAR(norm(X.p), 0.5, 1e-9);
    EXPECT_NEAR(sim.energy() / energy, 1, 1e-6);
    const double x = joint_state(type, sim.states[0], id, 0).position;
    const double y = joint_state(type, sim.states[0], id, 1).position;
    EXPECT_NEAR(x, X.p.x - 0.5, 1e-9);
    EXPECT_NEAR(y, X.p.y, 1e-9);
    const double angle = joint_state(type, sim.states[0], id, 2).position;
    EXPECT_NEAR(std::sin(angle), X.R.r1.x, 1e-9);
}

}  // namespace
}  // namespace roboss::test
