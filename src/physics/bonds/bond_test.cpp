// Bonds against closed forms: what they hold, what they bear, when they let go, and what they leave alone.
#include <gtest/gtest.h>

#include <support/bonds.h>

#include "physics/probe.h"

namespace roboss::test {
namespace {

World gantry_world(double dt_s, double load, double hand_mass = 1.0) {
    World world = empty_world(dt_s);
    place(world, gantry(hand_mass), "gantry", {{0, 0, 2}, {}});
    place(world, solid_box(load, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0.03, 0, 1.86}, {}});
    return world;
}

void hold_still(Simulation& sim) {
    for (std::size_t d = 0; d < 4; ++d) sim.set_motor(0, d, MotorMode::kVelocity, 0);
}

TEST(Bond, KeepsItsPlaceForAMinuteOnAWindingPath) {
    for (const double dt : {1e-3, 4e-3}) {
        Simulation sim(gantry_world(dt, 3.0));
        hold_still(sim);
        ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
        ASSERT_EQ(sim.states[0].bonds.size(), 1u);
        Slip worst;
        while (sim.time() < 60) {
            const double t = sim.time();
            sim.set_motor(0, 0, MotorMode::kVelocity, 1.5 * std::cos(2.0 * t));
            sim.set_motor(0, 1, MotorMode::kVelocity, 1.0 * std::sin(3.1 * t));
            sim.set_motor(0, 2, MotorMode::kVelocity, 0.4 * std::cos(5.0 * t));
            sim.set_motor(0, 3, MotorMode::kVelocity, 2.0 * std::sin(0.7 * t));
            sim.step();
            ASSERT_EQ(sim.states[0].bonds.size(), 1u) << "at " << t << " s";
            const Slip slip = slip_of(sim, 0);
            worst = {std::max(worst.distance, slip.distance), std::max(worst.angle, slip.angle)};
        }
        tell("worst slip, m", worst.distance);
        tell("worst slip, rad", worst.angle);
        EXPECT_LT(worst.distance, 1e-9);
        EXPECT_LT(worst.angle, 1e-9);
    }
}

TEST(Bond, BearsTheWeightOfWhatHangsOnIt) {
    for (const double load : {0.1, 3.0, 1000.0}) {
        Simulation sim(gantry_world(1e-3, load));
        hold_still(sim);
        ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
        const double z = sim.states[1].q[2];
        sim.run(2);
        const Vec3 force = sim.states[0].bonds[0].force_impulse / sim.model->dt_s;
        EXPECT_NEAR(force.z / (load * 9.81), 1, 1e-6) << load;
        EXPECT_NEAR(sim.states[1].q[2], z, 1e-5) << "a load of " << load << " kg sags";
        tell("sag, m", z - sim.states[1].q[2]);
    }
}

TEST(Bond, ForceOfATurnIsCentripetal) {
    Simulation sim(gantry_world(1e-3, 2.0));
    World world = empty_world(1e-3, {});
    place(world, gantry(), "gantry");
    place(world, solid_sphere(2.0, 0.05, surface(0.5)), "ball", {{0.15, 0, 0}, {}});
    Simulation turning(world);
    hold_still(turning);
    ASSERT_NO_FATAL_FAILURE(attach(turning, 0, 1, kHand));
    turning.set_motor(0, 3, MotorMode::kVelocity, 3.0);
    turning.run(1);
    const Vec3 force = turning.states[0].bonds[0].force_impulse / turning.model->dt_s;
    EXPECT_NEAR(norm(force), 2.0 * 9.0 * 0.15, 2.0 * 9.0 * 0.15 * 1e-3);
    const Vec3 arm{turning.states[1].q[0], turning.states[1].q[1], 0};
    EXPECT_NEAR(dot(force, arm) / (norm(force) * norm(arm)), -1, 1e-4);
}

TEST(Bond, LetsGoAtItsForce) {
    constexpr double kForce = 50, kWeight = 3.0 * 9.81;
    Simulation sim(gantry_world(1e-3, 3.0));
    hold_still(sim);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand, kForce));
    double pull = 0;
    while (!sim.states[0].bonds.empty() && sim.time() < 20) {
        pull += 5.0 * sim.model->dt_s;
        const Order order = order_for(sim, 1, ApplyWrench{kFirstLink, {0, 0, -pull}, {}, 1});
        sim.step({&order, 1});
    }
    EXPECT_NEAR(pull + kWeight, kForce, 0.01 * kForce);
    tell("let go at, N", pull + kWeight);
    const double v = sim.states[1].v[5];
    sim.run(0.1);
    EXPECT_NEAR(sim.states[1].v[5], v - 0.981, 1e-6) << "then it falls freely";
}

TEST(Bond, LetsGoAtItsTorque) {
    World world = empty_world(1e-3, {});
    place(world, gantry(), "gantry");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0, 0, -0.15}, {}});
    Simulation sim(world);
    hold_still(sim);
    Attach action = attach_to(1);
    action.link = kHand, action.max_torque = 4;
    const Order first = order_for(sim, 0, action);
    sim.step({&first, 1});
    double torque = 0;
    while (!sim.states[0].bonds.empty() && sim.time() < 20) {
        torque += 1e-3;
        const Order order = order_for(sim, 1, ApplyWrench{kFirstLink, {}, {torque, 0, 0}, 1});
        sim.step({&order, 1});
    }
    EXPECT_NEAR(torque, 4, 0.04);
}

/// Two boxes bonded in mid-air, and one body of the same mass.
TEST(Bond, TwoBodiesInFreeFlightMoveAsOne) {
    World world = empty_world(1e-3, {});
    const Vec3 size{0.2, 0.3, 0.1};
    place(world, solid_box(1.0, size, surface(0.5)), "a", {{-0.1, 0, 0}, {}});
    place(world, solid_box(2.0, size, surface(0.5)), "b", {{0.2, 0.1, 0.05}, from_rpy(0.3, 0.2, 0.1)});
    ModelSpec both;
    both.name = "both", both.canonical_link = "a";
    both.links.push_back(link("a", 1.0, box_inertia(1.0, size), {{-0.1, 0, 0}, {}}));
    both.links.push_back(link("b", 2.0, box_inertia(2.0, size), {{0.2, 0.1, 0.05}, from_rpy(0.3, 0.2, 0.1)}));
    both.joints.push_back(joint(JointSpecKind::kFixed, "weld", "a", "b", {}));
    place(world, both, "both", {{0, 50, 0}, {}});
    Simulation sim(world);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1));
    const Vec3 turning{0.7, -1.1, 2.0}, moving{0.3, 0.1, -0.2};
    const auto set = [&](std::size_t r, const Vec3& from) {
        const Vec3 p{sim.states[r].q[0], sim.states[r].q[1], sim.states[r].q[2]};
        const Vec3 v = moving + cross(turning, p - from);
        for (std::size_t i = 0; i < 3; ++i) sim.states[r].v[i] = turning[i], sim.states[r].v[3 + i] = v[i];
    };
    set(0, {}), set(1, {}), set(2, {0, 50, 0});
    const double energy = sim.energy(0) + sim.energy(1);
    const Momentum before = sim.momentum();
    double most = energy, least = energy;
    while (sim.time() < 10) {
        sim.step();
        most = std::max(most, sim.energy(0) + sim.energy(1));
        least = std::min(least, sim.energy(0) + sim.energy(1));
    }
    const Momentum after = sim.momentum();
    EXPECT_LT(norm(after.linear - before.linear), 1e-10);
    EXPECT_LT(norm(after.angular - before.angular), 1e-7);
    tell("relative growth of energy", most / energy - 1);
    tell("relative loss of energy", 1 - least / energy);
    EXPECT_LT(most / energy - 1, 1e-6);
    EXPECT_LT(1 - least / energy, 1e-4);
    const Vec3 a{sim.states[0].q[0], sim.states[0].q[1], sim.states[0].q[2]};
    const Vec3 as_one{sim.states[2].q[0], sim.states[2].q[1] - 50, sim.states[2].q[2]};
    tell("distance from one body after 10 s, m", norm(a - as_one));
    EXPECT_LT(norm(a - as_one), 1e-3);
}

TEST(Bond, MidAirGraspKeepsMomentum) {
    World world = empty_world(1e-3, {});
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.5)), "a");
    place(world, solid_box(3.0, {0.2, 0.2, 0.2}, surface(0.5)), "b", {{0.25, 0.05, 0}, {}});
    Simulation sim(world);
    sim.states[0].v = {0, 0, 1, 0.5, 0, 0};
    sim.states[1].v = {0, 2, 0, -0.3, 0.2, 0.1};
    const Momentum before = sim.momentum();
    const double energy = sim.energy();
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1));
    ASSERT_EQ(sim.states[0].bonds.size(), 1u);
    EXPECT_LT(sim.energy(), energy);
    sim.run(1);
    EXPECT_LT(norm(sim.momentum().linear - before.linear), 1e-12);
    EXPECT_LT(norm(sim.momentum().angular - before.angular), 1e-7);
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
}

TEST(Bond, ChainOfTenHangs) {
    World world = empty_world(2e-3);
    place(world, gantry(), "gantry", {{0, 0, 5}, {}});
    for (int i = 0; i < 10; ++i)
        place(world, solid_box(1.0, {0.1, 0.1, 0.1}, surface(0.5)), "box_" + std::to_string(i),
              {{0.02 * i, 0, 4.85 - 0.15 * i}, {}});
    Simulation sim(world);
    hold_still(sim);
    std::vector<Order> orders;
    for (std::size_t i = 0; i < 10; ++i) {
        Attach action = attach_to(i + 1);
        if (i == 0) action.link = kHand;
        orders.push_back(order_for(sim, i, action));
    }
    sim.step(orders);
    sim.set_motor(0, 0, MotorMode::kVelocity, 0.5);
    sim.run(2);
    sim.set_motor(0, 0, MotorMode::kVelocity, 0);
    sim.run(3);
    for (std::size_t i = 0; i < 10; ++i) {
        ASSERT_EQ(sim.states[i].bonds.size(), 1u);
        EXPECT_NEAR(sim.states[i].bonds[0].force_impulse.z / sim.model->dt_s,
                    9.81 * static_cast<double>(10 - i), 1e-4);
    }
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
    EXPECT_NEAR(sim.states[10].q[0], 0.18 + 1.0, 2e-3);
}

/// A passive pendulum with a ball bonded to its tip swings as one whose ball is welded on.
TEST(Bond, PendulumWithABondedBallSwingsAsAWeldedOne) {
    World world = empty_world(1e-3);
    place(world, pendulum(), "bonded");
    place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball", {{0, 0, -1.1}, {}});
    ModelSpec welded = pendulum();
    welded.links.push_back(link("ball", 1.0, sphere_inertia(1.0, 0.1), {{0, 0, -1.1}, {}}));
    welded.joints.push_back(joint(JointSpecKind::kFixed, "weld", "rod", "ball", {}));
    place(world, welded, "welded", {{0, 10, 0}, {}});
    Simulation sim(world);
    const Attach action = attach_to(1, 1.1);
    const Order order = order_for(sim, 0, action);
    sim.step({&order, 1});
    ASSERT_EQ(sim.states[0].bonds.size(), 1u);
    sim.states[0].v[0] = sim.states[2].v[0] = 3.0;
    sim.states[1].v = {0, 3.0, 0, -3.3, 0, 0};
    sim.states[0].q[7] = sim.states[2].q[7] = 0;
    sim.states[1].q = {0, 0, -1.1, 1, 0, 0, 0};
    const double energy = sim.energy(0) + sim.energy(1);
    double off = 0;
    while (sim.time() < 10) {
        sim.step();
        off = std::max(off, std::fabs(sim.states[0].q[7] - sim.states[2].q[7]));
    }
    tell("off the welded one, rad", off);
    tell("relative change of energy", (sim.energy(0) + sim.energy(1) - energy) / 9);
    EXPECT_LT(off, 2e-3);
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
}

TEST(Bond, OutOfReachNothingHappens) {
    Simulation sim(gantry_world(1e-3, 1.0));
    sim.states[1].q[2] = 1.0;
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
    EXPECT_TRUE(sim.states[0].bonds.empty());
}

TEST(Bond, TornByATeleportItLetsGo) {
    for (const double away : {0.005, 0.02, 5.0}) {
        Simulation sim(gantry_world(1e-3, 1.0));
        hold_still(sim);
        ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
        Pose X = base_pose(sim.states[1]);
        X.p.x += away;
        const Order order = order_for(sim, 1, SetPose{X});
        sim.step({&order, 1});
        EXPECT_EQ(sim.states[0].bonds.size(), away < 0.01 ? 1u : 0u) << away;
        sim.run(0.1);
        EXPECT_LT(worst_slip(sim).distance, 1e-9);
    }
}

TEST(Bond, DetachedBodiesKeepTheirVelocitiesAndCollideAgain) {
    World world = empty_world(1e-3, {});
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0)), "a");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0)), "b", {{0.18, 0, 0}, {}});  // 2 cm deep
    Simulation sim(world);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1));
    for (RobotState& s : sim.states) s.v = {0, 0, 0, 0.4, 0.1, 0};
    sim.run(1);
    EXPECT_NEAR(sim.states[1].q[0] - sim.states[0].q[0], 0.18, 1e-9) << "bonded links do not collide";
    const Order order = order_for(sim, 0, Detach{});
    sim.step({&order, 1});
    EXPECT_TRUE(sim.states[0].bonds.empty());
    double fastest = 0;
    for (int i = 0; i < 1000; ++i) {
        sim.step();
        fastest = std::max(fastest, std::fabs(sim.states[1].v[3] - sim.states[0].v[3]));
    }
    EXPECT_LT(fastest, 1e-3) << "no explosion";
    EXPECT_NEAR(sim.states[1].q[0] - sim.states[0].q[0], 0.2, 1e-3) << "pushed apart";
}

TEST(Bond, TwoHoldersOfOneBoxAndEachOtherAgree) {
    World world = empty_world(1e-3);
    place(world, gantry(), "left", {{-0.2, 0, 2}, {}});
    place(world, gantry(), "right", {{0.2, 0, 2}, {}});
    place(world, solid_box(4.0, {0.6, 0.2, 0.2}, surface(0.5)), "box", {{0, 0, 1.84}, {}});
    Simulation sim(world);
    Attach action = attach_to(2);
    action.link = kHand;
    std::vector<Order> orders{order_for(sim, 0, action), order_for(sim, 1, action)};
    action.other = RobotId(std::size_t{1}), action.other_link = kHand, action.reach = 1;
    orders.push_back(order_for(sim, 0, action));
    action.other = RobotId(std::size_t{0});
    orders.push_back(order_for(sim, 1, action));
    sim.step(orders);
    ASSERT_EQ(sim.states[0].bonds.size() + sim.states[1].bonds.size(), 4u);
    for (std::size_t r : {0u, 1u})
        for (std::size_t d = 0; d < 3; ++d) sim.set_motor(r, d, MotorMode::kVelocity, d == 0 ? 0.3 : 0);
    sim.run(2);
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
    EXPECT_NEAR(sim.states[2].q[0], 0.6, 1e-2);
    double z = 0;
    for (std::size_t r : {0u, 1u}) z += sim.states[r].bonds[0].force_impulse.z / sim.model->dt_s;
    EXPECT_NEAR(z, 4 * 9.81, 1e-3);
}

TEST(Bond, AForceSensorAtTheWristFeelsTheLoad) {
    Simulation sim(gantry_world(1e-3, 3.0));
    hold_still(sim);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
    sim.run(1);
    StepProbe probe(*sim.model);
    const std::vector<const RobotState*> states(sim.pointers.begin(), sim.pointers.end());
    probe.step(sim.tick, states);
    const std::vector<JointReaction> reactions = probe.joint_reactions(RobotId(std::size_t{0}));
    ASSERT_EQ(reactions.size(), 4u);
    EXPECT_NEAR(reactions[3].force.z, (3.0 + 1.0) * 9.81, 1e-4);   // load and hand
    EXPECT_NEAR(reactions[3].torque.y, -0.03 * 3.0 * 9.81, 1e-4);  // it hangs 3 cm beside the axis
}

TEST(Bond, HeldRobotKeepsItsOwnJoints) {
    World world = empty_world(1e-3);
    place(world, gantry(), "gantry", {{0, 0, 3}, {}});
    place(world, prismatic_chain(), "held", {{0, 0, 2.4}, {}});
    Simulation sim(world);
    hold_still(sim);
    Attach action = attach_to(1, 5);
    action.link = kHand;
    const Order order = order_for(sim, 0, action);
    sim.step({&order, 1});
    ASSERT_EQ(sim.states[0].bonds.size(), 1u);
    for (std::size_t d = 0; d < 3; ++d) sim.set_motor(1, d, MotorMode::kVelocity, d == 1 ? 0.2 : 0);
    const double q = sim.states[1].q[8];
    sim.run(1);
    EXPECT_NEAR(sim.states[1].q[8] - q, 0.2, 2e-3);
    EXPECT_LT(worst_slip(sim).distance, 1e-9);
}

}  // namespace
}  // namespace roboss::test
