// What a joint does by itself: limits, dry friction, damping, springs, gravity switched off, against closed
// form.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

template <class Change>
World hinge(const Vec3& gravity, double dt_s, Change change) {
    World world = empty_world(dt_s, gravity);
    ModelSpec model = pendulum(2.0, 0.8);
    change(model.joints[0].axes[0]);
    place(world, model, "hinge");
    return world;
}

double inertia_of(const World& world) {
    const LinkSpec& rod = world.prototypes[0].links[0];
    return rod.inertia_C(1, 1) + rod.mass * norm_squared(rod.p_LC);
}

TEST(JointLimit, FallingPendulumStopsAtItsLimit) {
    Simulation sim(hinge({0, 0, -9.81}, 1e-3, [](AxisSpec& axis) { axis.lower = -2, axis.upper = 0.7; }));
    sim.states[0].q[7] = -1.5;  // swings to +1.5 without the limit
    double largest = -9;
    for (int i = 0; i < 5000; ++i) {
        sim.step();
        largest = std::fmax(largest, sim.states[0].q[7]);
    }
    tell("largest way beyond the limit, rad", largest - 0.7);
    EXPECT_LT(largest, 0.7 + 1e-6);
    EXPECT_GT(largest, 0.7 - 1e-6) << "it does get there";
}

TEST(JointLimit, MotorCannotPushThroughALimit) {
    for (const double direction : {1.0, -1.0}) {
        Simulation sim(hinge(
            {}, 1e-3, [](AxisSpec& axis) { axis.lower = -0.5, axis.upper = 0.5, axis.max_effort = 200; }));
        sim.set_motor(0, 0, MotorMode::kVelocity, direction * 5);
        sim.run(2);
        EXPECT_NEAR(sim.states[0].q[7], direction * 0.5, 1e-5);
        EXPECT_NEAR(sim.states[0].v[0], 0, 1e-3);
    }
}

TEST(JointLimit, SliderStopsAtBothEnds) {
    World world = empty_world(1e-3, {});
    ModelSpec model = solid_box(1.0, {0.1, 0.1, 0.1}, surface(0.5));
    model.joints.push_back(joint(JointSpecKind::kPrismatic, "slide", "world", "box", {}, {1, 0, 0}));
    model.joints[0].axes[0].lower = -0.2;
    model.joints[0].axes[0].upper = 0.3;
    place(world, model, "slider");
    for (const double speed : {30.0, -30.0}) {
        Simulation sim(world);
        sim.states[0].v[0] = speed;
        for (int i = 0; i < 200; ++i) {
            sim.step();
            ASSERT_LE(sim.states[0].q[7], 0.3 + 1e-4);
            ASSERT_GE(sim.states[0].q[7], -0.2 - 1e-4);
        }
        EXPECT_NEAR(sim.states[0].v[0], 0, 1e-3);
    }
}

TEST(JointLimit, JointSpawnedBeyondItsLimitReturnsWithoutKeepingSpeed) {
    Simulation sim(hinge({}, 1e-3, [](AxisSpec& axis) { axis.lower = -0.5, axis.upper = 0.5; }));
    sim.states[0].q[7] = 0.6;
    sim.run(2);
    tell("angle 2 s after a spawn .1 rad beyond the limit", sim.states[0].q[7]);
    EXPECT_NEAR(sim.states[0].q[7], 0.5, 1e-3);
    EXPECT_LT(sim.energy(), 1e-9);
}

TEST(JointFriction, HoldsBelowItsBound) {
    Simulation sim(hinge({}, 1e-3, [](AxisSpec& axis) { axis.friction = 0.5; }));
    sim.set_motor(0, 0, MotorMode::kEffort, 0.49);
    sim.run(5);
    EXPECT_LT(std::fabs(sim.states[0].v[0]), 1e-8);
    EXPECT_LT(std::fabs(sim.states[0].q[7]), 1e-7);
}

TEST(JointFriction, SlipsAtItsBound) {
    const World world = hinge({}, 1e-3, [](AxisSpec& axis) { axis.friction = 0.5; });
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kEffort, 0.8);
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0] / (0.3 / inertia_of(world)), 1, 1e-6);
}

TEST(JointFriction, StopsAMovingJointWhereItShould) {
    const World world = hinge({}, 1e-3, [](AxisSpec& axis) { axis.friction = 0.5; });
    Simulation sim(world);
    sim.states[0].v[0] = 2;
    sim.run(5);
    EXPECT_NEAR(sim.states[0].q[7] / (0.5 * 4 * inertia_of(world) / 0.5), 1, 2e-3);
    EXPECT_LT(std::fabs(sim.states[0].v[0]), 1e-12);
}

TEST(JointDamping, VelocityDecaysByTheExponentialLaw) {
    const World world = hinge({}, 1e-3, [](AxisSpec& axis) { axis.damping = 0.6; });
    Simulation sim(world);
    sim.states[0].v[0] = 2;
    sim.run(1);
    const double rate = 0.6 / inertia_of(world);
    EXPECT_NEAR(sim.states[0].v[0], 2 * std::exp(-rate), 1e-10);
    EXPECT_NEAR(sim.states[0].q[7], 2 / rate * (1 - std::exp(-rate)), 1e-10);
}

TEST(JointDamping, OfABallJointIsTheSameInAllDirections) {
    World world = empty_world(1e-3, {});
    ModelSpec m = solid_sphere(2.0, 0.3, surface(0.5));
    m.joints.push_back(joint(JointSpecKind::kBall, "ball", "world", "sphere", {}));
    m.joints[0].ball_damping = 0.2;
    place(world, m, "ball");
    Simulation sim(world);
    const Vec3 w{2, -1, 0.5};
    for (std::size_t i = 0; i < 3; ++i) sim.states[0].v[i] = w[i];
    sim.run(1);
    const double left = std::exp(-0.2 / (0.4 * 2.0 * 0.3 * 0.3));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(sim.states[0].v[i], w[i] * left, 1e-9);
}

/// A bar between two ball joints turns about its length; the second joint closes a loop and damps as the
/// first.
TEST(JointDamping, OfABallJointThatClosesALoopActsToo) {
    World world = empty_world(1e-4, {});
    ModelSpec m = solid_box(2.0, {1, 0.2, 0.3}, surface(0.5));
    for (const double x : {0.5, -0.5}) {
        m.joints.push_back(
            joint(JointSpecKind::kBall, x > 0 ? "right" : "left", "world", "box", {{x, 0, 0}, {}}));
        m.joints.back().ball_damping = 0.02;
    }
    place(world, m, "bar");
    Simulation sim(world);
    ASSERT_EQ(sim.type(0).loops.size(), 1u);
    sim.states[0].v[0] = 2;
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0] / (2 * std::exp(-0.04 / box_inertia(2.0, {1, 0.2, 0.3}).r0.x)), 1, 1e-3);
}

TEST(JointSpring, SwingsByTheCosineAboutItsReference) {
    const World world =
        hinge({}, 1e-3, [](AxisSpec& axis) { axis.spring_stiffness = 50, axis.spring_reference = 0.3; });
    Simulation sim(world);
    sim.run(2);
    const double w = std::sqrt(50 / inertia_of(world));
    EXPECT_NEAR(sim.states[0].q[7], 0.3 - 0.3 * std::cos(2 * w), 1e-7);
}

TEST(JointArmature, AddsToTheInertia) {
    const World world = hinge({}, 1e-3, [](AxisSpec& axis) { axis.armature = 0.4; });
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kEffort, 1.0);
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0] / (1 / (inertia_of(world) + 0.4)), 1, 1e-9);
}

TEST(Gravity, LinkWithGravityOffFloats) {
    World world = empty_world(1e-3);
    ModelSpec model = solid_box(1.0, {0.1, 0.2, 0.3}, surface(0.5));
    model.links[0].gravity = false;
    place(world, model, "box", {{0, 0, 1}, {}});
    Simulation sim(world);
    sim.run(1);
    EXPECT_EQ(sim.states[0].q[2], 1);
}

/// A light and a heavy link welded 1 m apart; gravity pulls only the light one, so the pair falls slowly and
/// begins to turn.
TEST(Gravity, PullsAWeldedBodyWhereTheFeelingLinkIs) {
    World world = empty_world(1e-3);
    ModelSpec model = solid_box(3.0, {0.1, 0.1, 0.1}, surface(0.5));
    model.links[0].gravity = false;
    model.links.push_back(link("light", 1.0, box_inertia(1.0, {0.1, 0.1, 0.1}), {{1, 0, 0}, {}}));
    model.joints.push_back(joint(JointSpecKind::kFixed, "weld", "box", "light", {}));
    place(world, model, "pair");
    Simulation sim(world);
    sim.step();
    const double inertia = 3.0 * 0.25 * 0.25 + 1.0 * 0.75 * 0.75 + box_inertia(4.0, {0.1, 0.1, 0.1})(1, 1);
    EXPECT_NEAR(sim.states[0].v[1], 9.81 * 0.75 / inertia * 1e-3, 1e-9);
    const double centre_z = sim.states[0].v[5] - sim.states[0].v[1] * 0.25;
    EXPECT_NEAR(centre_z, -9.81 / 4 * 1e-3, 1e-9);
}

}  // namespace
}  // namespace roboss::test
