// Contact reports and joint reactions against closed forms.
#include "physics/probe.h"

#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81;

StepProbe probe_of(const Simulation& sim) {
    StepProbe probe(*sim.model);
    const std::vector<const RobotState*> states(sim.pointers.begin(), sim.pointers.end());
    probe.step(sim.tick, states);
    return probe;
}

TEST(ContactReports, ABoxAtRestPressesWithItsWeight) {
    for (const bool sleeps : {false, true}) {
        World world = empty_world(2e-3);
        world.sleep = sleeps;
        place(world, ground(surface(0.5)), "ground");
        place(world, solid_box(3.0, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0, 0, 0.1}, {}});
        Simulation sim(world);
        sim.run(2);
        ASSERT_EQ(sim.states[0].rest.asleep, sleeps);
        const StepProbe probe = probe_of(sim);
        ASSERT_EQ(probe.contacts().size(), 4u);
        double sum = 0;
        for (const ContactReport& c : probe.contacts()) {
            sum += c.impulse;
            EXPECT_EQ(c.robot_a, RobotId(0u));
            EXPECT_EQ(c.link_a, LinkId(0u));
            EXPECT_FALSE(c.robot_b.valid());
            EXPECT_EQ(sim.model->statics[c.scenery].name, "ground::link::collision");
            EXPECT_NEAR(c.normal.z, 1, 1e-12);
            EXPECT_NEAR(std::fabs(c.p_W.x), 0.1, 1e-6);
        }
        EXPECT_NEAR(sum / (3.0 * kG * 2e-3), 1, 1e-6);
    }
}

TEST(ContactReports, OnASlopeFrictionHoldsTheRest) {
    const double angle = 0.3;
    const Quat tilt = from_rpy(0, angle, 0);
    World world = empty_world(1e-3);
    place(world, ground(surface(0.9)), "ground", {{}, tilt});
    place(world, solid_box(2.0, {0.2, 0.2, 0.1}, surface(0.9)), "box",
          {rotate(tilt, Vec3{0, 0, 0.05}), tilt});
    Simulation sim(world);
    sim.run(1);
    const StepProbe probe = probe_of(sim);
    Vec3 total;
    double normal = 0;
    for (const ContactReport& c : probe.contacts())
        total += c.normal * c.impulse + c.friction, normal += c.impulse;
    EXPECT_NEAR(normal / (2.0 * kG * std::cos(angle) * 1e-3), 1, 1e-5);
    EXPECT_NEAR(norm(total - Vec3{0, 0, 2.0 * kG * 1e-3}), 0, 1e-6 * 2.0 * kG * 1e-3);
}

TEST(ContactReports, AreTheImpulsesOfTheVeryNextTick) {
    World world = empty_world(2e-3);
    world.accuracy.push_back({"high", {}, {}});  // what friction is off by is missing from its reports
    place(world, ground(surface(0.6)), "ground");
    for (int i = 0; i < 5; ++i)
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box_" + std::to_string(i),
              {{0.03 * i, 0.02 * i, 0.15 + 0.25 * i}, {}});
    Simulation sim(world);
    for (int i = 0; i < 500; ++i) {
        const Vec3 before = sim.momentum().linear;
        const StepProbe probe = probe_of(sim);
        sim.step();
        Vec3 gained;
        for (const ContactReport& c : probe.contacts())
            if (!c.robot_b.valid()) gained += c.normal * c.impulse + c.friction;
        const Vec3 expected = sim.momentum().linear - before - Vec3{0, 0, -5 * kG * 2e-3};
        ASSERT_LT(norm(gained - expected), 1e-5) << "tick " << i;
        ASSERT_EQ(probe.contacts().size(), static_cast<std::size_t>(sim.report.contacts));
    }
}

const JointReaction& of(const Simulation& sim, const std::vector<JointReaction>& reactions,
                        const char* name) {
    const JointId id = *sim.type(0).find_joint(name);
    for (const JointReaction& r : reactions)
        if (r.joint == id) return r;
    ADD_FAILURE() << "no reaction of " << name;
    return reactions.front();
}

/// A rod of 2 kg and 1 m on a hinge about y at the origin, hanging along x at angle 0.
World pendulum(double dt_s) {
    World world = empty_world(dt_s);
    ModelSpec arm = one_link(link("rod", 2.0, box_inertia(2.0, {1, 0.02, 0.02}), {{0.5, 0, 0}, {}}));
    arm.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "rod", {}, {0, 1, 0}));
    place(world, arm, "pendulum");
    return world;
}

TEST(JointReactions, OfAPendulumAtTheBottom) {
    Simulation sim(pendulum(1e-4));
    while (sim.states[0].q[7] < kPi / 2) sim.step();  // let go from the horizontal, down to the bottom
    const StepProbe probe = probe_of(sim);
    const std::vector<JointReaction> reactions = probe.joint_reactions(RobotId(0u));
    ASSERT_EQ(reactions.size(), 1u);
    const double v = 0.5 * sim.states[0].v[0];
    EXPECT_NEAR(reactions[0].force.z / (2 * (kG + v * v / 0.5)), 1, 1e-6);
    EXPECT_NEAR(v * v / (0.25 * 2 * kG * 0.5 / (1.0 / 3)), 1, 1e-3) << "it has fallen half a metre";
    EXPECT_NEAR(reactions[0].torque.y, 0, 1e-9) << "the hinge is free";
}

TEST(JointReactions, OfAHeldArmAreWeightAndTorque) {
    Simulation sim(pendulum(1e-3));
    sim.set_motor(0, 0, MotorMode::kPosition, 0);
    sim.run(0.5);
    const std::vector<JointReaction> reactions = probe_of(sim).joint_reactions(RobotId(0u));
    ASSERT_EQ(reactions.size(), 1u);
    EXPECT_NEAR(norm(reactions[0].force - Vec3{0, 0, 2 * kG}), 0, 1e-4);
    EXPECT_NEAR(reactions[0].torque.y, -2 * kG * 0.5, 1e-4) << "about +y the weight turns by + m g / 2";
}

TEST(JointReactions, OfAStandingCarsAxlesBearTheChassis) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, car(), "car");
    Simulation sim(world);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, 0);
    sim.run(1);
    const std::vector<JointReaction> reactions = probe_of(sim).joint_reactions(RobotId(0u));
    ASSERT_EQ(reactions.size(), 4u);
    double sum = 0;
    for (const JointReaction& r : reactions) sum += r.force.z;
    EXPECT_NEAR(sum / (-5 * kG), 1, 1e-4) << "the chassis weighs down on the wheels";
}

/// A beam of 2 kg on two hanging rods; one of its four hinges closes the loop.
TEST(JointReactions, OfABeamThatHangsOnTwoRodsShareItsWeight) {
    ModelSpec m = parallelogram();
    double rods = 0, beam = 0;
    for (LinkSpec& l : m.links) (l.name == "coupler" ? beam : rods) += l.mass;
    World world = empty_world(1e-3);
    place(world, m, "swing", {{0, 0, 2}, from_rpy(kPi, 0, 0)});  // upside down: the cranks hang
    Simulation sim(world);
    ASSERT_EQ(sim.type(0).loops.size(), 1u);
    sim.run(0.1);
    const StepProbe probe = probe_of(sim);
    const std::vector<JointReaction> reactions = probe.joint_reactions(RobotId(0u));
    ASSERT_EQ(reactions.size(), 4u);
    for (const char* top : {"crank", "rocker"})
        EXPECT_LT(norm(of(sim, reactions, top).force - Vec3{0, 0, 0.5 * (beam + rods) * kG}), 1e-4) << top;
    for (const char* end : {"elbow", "closing"})
        EXPECT_LT(norm(of(sim, reactions, end).force - Vec3{0, 0, 0.5 * beam * kG}), 1e-4) << end;
    for (const JointReaction& r : reactions) EXPECT_LT(norm(r.torque), 1e-4) << "free hinges in one plane";
}

/// What the coupler of a driven four-bar linkage gains in momentum, its two hinges and its weight give it.
TEST(JointReactions, OfADrivenLoopMoveItsCouplerAsNewtonSays) {
    constexpr double kDt = 1e-4;
    World world = empty_world(kDt);
    place(world, four_bar(), "linkage");
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kVelocity, 5);
    sim.run(0.2);
    const LinkId coupler = *sim.type(0).find_link("coupler");
    const LinkSpec& spec = sim.world.prototypes[0].links[coupler.index()];
    const auto momentum = [&] {
        const Twist twist = link_twist(sim.type(0), sim.states[0], coupler);
        const Vec3 arm = link_pose(sim.type(0), sim.states[0], coupler).R * spec.p_LC;
        return (twist.linear + cross(twist.angular, arm)) * spec.mass;
    };
    for (int i = 0; i < 50; ++i) {
        const StepProbe probe = probe_of(sim);
        const std::vector<JointReaction> reactions = probe.joint_reactions(RobotId(0u));
        const Vec3 force = of(sim, reactions, "elbow").force + of(sim, reactions, "closing").force;
        const Vec3 before = momentum();
        sim.run(kDt);
        const Vec3 expected = (momentum() - before) / kDt + Vec3{0, 0, spec.mass * kG};
        EXPECT_LT(norm(force - expected), 2e-3 * norm(expected)) << "tick " << sim.tick;
        sim.run(20 * kDt);
    }
}

/// The rod of `pendulum`, with a head of 0.5 kg welded to its end, 0.2 m beyond it.
World hammer(double dt_s, bool head_is_child) {
    World world = pendulum(dt_s);
    ModelSpec& arm = world.prototypes[0];
    arm.links.push_back(link("head", 0.5, box_inertia(0.5, {0.1, 0.2, 0.05}), {{1.2, 0.1, 0}, {}}));
    const char* parent = head_is_child ? "rod" : "head";
    const char* child = head_is_child ? "head" : "rod";
    arm.joints.push_back(joint(JointSpecKind::kFixed, "weld", parent, child, {{1, 0, 0}, {}}));
    return world;
}

TEST(JointReactions, OfAWeldAreWhatTheLinkBehindItWeighs) {
    for (const bool head_is_child : {true, false}) {
        const double side = head_is_child ? 1 : -1;
        Simulation sim(hammer(1e-3, head_is_child));
        ASSERT_EQ(sim.type(0).bodies.size(), 1u) << "one body of two links";
        sim.set_motor(0, 0, MotorMode::kPosition, 0);
        sim.run(0.5);
        const std::vector<JointReaction> reactions = probe_of(sim).joint_reactions(RobotId(0u));
        ASSERT_EQ(reactions.size(), 2u);
        const JointReaction& weld = of(sim, reactions, "weld");
        const double weight = 0.5 * kG;
        EXPECT_NEAR(norm(weld.force * side - Vec3{0, 0, weight}), 0, 1e-4);
        EXPECT_NEAR(norm(weld.torque * side - Vec3{0.1 * weight, -0.2 * weight, 0}), 0, 1e-4);
        EXPECT_NEAR(of(sim, reactions, "hinge").force.z, 2.5 * kG, 1e-4) << "which bears both";
    }
}

TEST(JointReactions, OfAWeldThatSwingsMoveTheLinkBehindItAsNewtonAndEulerSay) {
    constexpr double kDt = 1e-4;
    Simulation sim(hammer(kDt, true));
    const LinkId head = *sim.type(0).find_link("head");
    const Mat3 own = sim.world.prototypes[0].links[head.index()].inertia_C;
    struct Momentum {
        Vec3 linear, angular;  // the latter about the head's centre
    };
    const auto momentum = [&] {
        const Twist twist = link_twist(sim.type(0), sim.states[0], head);
        const Mat3 R = link_pose(sim.type(0), sim.states[0], head).R;
        return Momentum{twist.linear * 0.5, R * own * transpose(R) * twist.angular};
    };
    for (int i = 0; i < 20; ++i) {
        sim.run(200 * kDt);
        const Vec3 centre = link_pose(sim.type(0), sim.states[0], head).p;
        const Vec3 at = link_pose(sim.type(0), sim.states[0], *sim.type(0).find_link("rod")).p * 2.0;
        const JointReaction weld = of(sim, probe_of(sim).joint_reactions(RobotId(0u)), "weld");
        const Momentum before = momentum();
        sim.run(kDt);
        const Momentum after = momentum();
        const Vec3 force = (after.linear - before.linear) / kDt + Vec3{0, 0, 0.5 * kG};
        const Vec3 torque = (after.angular - before.angular) / kDt + cross(centre - at, force);
        EXPECT_LT(norm(weld.force - force), 1e-3 * norm(force)) << "tick " << sim.tick;
        EXPECT_LT(norm(weld.torque - torque), 1e-3 * norm(torque)) << "tick " << sim.tick;
    }
}

/// A stand welded to the world, a plate welded upon it, a box lying on the plate, a hand pushing the plate.
TEST(JointReactions, OfWeldsToTheWorldBearAllThatStandsOnThem) {
    World world = empty_world(1e-3);
    ModelSpec stand = one_link(link("post", 4.0, box_inertia(4.0, {0.1, 0.1, 1}), {{0, 0, 0.5}, {}}));
    stand.links.push_back(link("plate", 1.0, box_inertia(1.0, {0.4, 0.4, 0.1}), {{0, 0, 1.05}, {}}));
    stand.links.back().collisions.push_back(box_shape({0.4, 0.4, 0.1}, surface(0.5)));
    stand.joints.push_back(joint(JointSpecKind::kFixed, "bolts", "world", "post", {}));
    stand.joints.push_back(joint(JointSpecKind::kFixed, "weld", "post", "plate", {{0, 0, 1}, {}}));
    place(world, stand, "stand");
    place(world, solid_box(3.0, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0.05, 0, 1.2}, {}});
    Simulation sim(world);
    sim.run(1);
    const std::vector<JointReaction> calm = probe_of(sim).joint_reactions(RobotId(0u));
    ASSERT_EQ(calm.size(), 2u);
    EXPECT_NEAR(norm(of(sim, calm, "weld").force - Vec3{0, 0, 4 * kG}), 0, 1e-3);
    EXPECT_NEAR(norm(of(sim, calm, "weld").torque - Vec3{0, -0.05 * 3 * kG, 0}), 0, 1e-3);
    EXPECT_NEAR(norm(of(sim, calm, "bolts").force - Vec3{0, 0, 8 * kG}), 0, 1e-3);
    sim.states[0].wrenches.push_back({*sim.type(0).find_link("plate"), {7, 0, 0}, {}, 100000});
    const std::vector<JointReaction> pushed = probe_of(sim).joint_reactions(RobotId(0u));
    EXPECT_NEAR(of(sim, pushed, "weld").force.x, -7, 1e-3);
    EXPECT_NEAR(of(sim, pushed, "bolts").torque.y - of(sim, calm, "bolts").torque.y, -7 * 1.05, 1e-3);
}

}  // namespace
}  // namespace roboss::test
