// Soft substeps of robots with joints, with `--accuracy fast`: piles come to rest, motors and limits hold,
// cars turn as with the exact solver, momentum and energy stay, and so do the bits.
#include <gtest/gtest.h>

#include <cmath>

#include <support/legged.h>
#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

#include "core/thread_pool.h"
#include "physics/soft/soft_tree.h"

namespace roboss::test {
namespace {

World world_with(const char* setting, const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(2e-3, gravity);
    AccuracySpec accuracy;
    accuracy.setting = setting;
    world.accuracy.push_back(accuracy);
    return world;
}

/// Of the bases.
double fastest(const Simulation& sim) {
    double most = 0;
    for (const RobotState& state : sim.states)
        for (std::size_t i = 0; i < 6; ++i) most = std::fmax(most, std::fabs(state.v[i]));
    return most;
}

double deepest(Simulation& sim) {
    double depth = 0;
    for (const ContactReport& c : read_contacts(sim.scratch)) depth = std::fmax(depth, -c.gap);
    return depth;
}

/// Robots with four legs, which fall onto each other between four walls.
World legged_heap(const char* setting, int per_side, int layers) {
    World world = world_with(setting);
    place(world, ground(surface(0.6)), "ground");
    const double side = 0.17 * per_side, height = 2;
    for (int k = 0; k < 4; ++k) {
        const double turn = k * kPi / 2;
        const Vec3 middle{0.5 * (side - 0.17), 0.5 * (side - 0.17), 0.5 * height};
        const Quat q = from_rpy(0, 0, turn);
        place(world, scenery(box_shape({0.1, side + 0.2, height}, surface(0.6))), "wall_" + std::to_string(k),
              {middle + rotate(q, {0.5 * side + 0.05, 0, 0}), q});
    }
    Random random(3);
    place_legged(world, per_side, layers, 0.15, random);
    return world;
}

/// Legs swing out by the damping of their joints, as with the exact solver.
TEST(SoftJoints, AHeapOfLeggedRobotsComesToRest) {
    constexpr int kPlaced = 50;  // ticks after which those that began in each other are apart
    Simulation sim(legged_heap("fast", 3, 4));
    sim.scratch.keep_reactions(true);
    double falling = 0, passed = 0;
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        ASSERT_FALSE(sim.report.not_finite.valid());
        if (i >= kPlaced) falling = std::fmax(falling, deepest(sim));
        for (const RobotState& state : sim.states)
            for (std::size_t d = 7; d < state.q.size(); ++d)
                passed = std::fmax(passed, std::fabs(state.q[d]) - 0.6);
    }
    tell("deepest overlap while falling, mm", 1e3 * falling);
    tell("deepest overlap at rest, mm", 1e3 * deepest(sim));
    tell("a joint's limit passed by, rad", passed);
    tell("fastest trunk after 4 s, m/s or rad/s", fastest(sim));
    EXPECT_LT(deepest(sim), 5e-4);
    EXPECT_LT(falling, 1e-2);
    EXPECT_LT(passed, 2e-3);
    EXPECT_LT(fastest(sim), 1e-4);
}

/// A box of 2 kg lies on a car: together they are an island of two, and the car is solved by soft substeps.
World laden_cars(const char* setting, int cars) {
    World world = world_with(setting);
    place(world, ground(surface(0.9)), "ground");
    world.prototypes.push_back(car({.max_effort = 2}));
    const std::size_t prototype = world.prototypes.size() - 1;
    for (int i = 0; i < cars; ++i) {
        const Pose X{{1.5 * i, 0, 0}, from_rpy(0, 0, 0.3 * i)};
        world.instances.push_back({"car_" + std::to_string(i), prototype, X, {}});
        place(world, solid_box(2, {0.2, 0.15, 0.1}, surface(0.9)), "load_" + std::to_string(i),
              X * Pose{{0, 0, 0.17}, {}});
    }
    return world;
}

/// Wheels of the two sides turn with other speeds, by car.
void steer(Simulation& sim, int cars) {
    for (int i = 0; i < cars; ++i)
        for (std::size_t wheel = 0; wheel < 4; ++wheel)
            sim.set_motor(2 * static_cast<std::size_t>(i), wheel, MotorMode::kVelocity,
                          wheel % 2 == 0 ? 2.0 + i : 6.0 + 3 * i);
}

double turned(const RobotState& state, double before) {
    const Quat& q = base_pose(state).q;
    return std::remainder(2 * std::atan2(q.z, q.w) - before, 2 * kPi);
}

TEST(SoftJoints, CarsTurnBySkidSteerAsWithTheExactSolver) {
    constexpr int kCars = 3;
    Simulation soft(laden_cars("fast", kCars)), exact(laden_cars("standard", kCars));
    double worst = 0;
    for (Simulation* sim : {&soft, &exact}) steer(*sim, kCars), sim->run(1.0);
    for (int i = 0; i < kCars; ++i) {
        const std::size_t robot = 2 * static_cast<std::size_t>(i);
        const double a = turned(soft.states[robot], 0.3 * i), b = turned(exact.states[robot], 0.3 * i);
        tell("turned by, rad", a), tell("  with the exact solver", b);
        worst = std::fmax(worst, std::fabs(a / b - 1));
    }
    tell("worst relative error", worst);
    EXPECT_LT(worst, 0.02);
}

TEST(SoftJoints, MotorsHoldAndFollowTheirTargets) {
    World world = world_with("fast");
    place(world, ground(surface(0.9)), "ground");
    ModelSpec model = car({.max_effort = 2});
    place(world, model, "car");
    place(world, solid_box(2, {0.2, 0.15, 0.1}, surface(0.9)), "load", {{0, 0, 0.17}, {}});
    Simulation sim(world);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, 5);
    sim.run(2);
    double off = 0;
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        off = std::fmax(off, std::fabs(sim.states[0].v[6 + wheel] - 5));
    tell("wheels off their speed, rad/s", off);
    EXPECT_LT(off, 1e-3);
    EXPECT_NEAR(sim.states[0].v[3], 0.25, 1e-3);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, 0);
    sim.run(1);
    const double x = sim.states[0].q[0];
    sim.run(10);
    tell("creep of a parked car in 10 s, m", sim.states[0].q[0] - x);
    EXPECT_NEAR(sim.states[0].q[0], x, 1e-5);
}

/// Robots in a heap hold their legs at their targets.
TEST(SoftJoints, PositionMotorsHoldInAHeap) {
    Simulation sim(legged_heap("fast", 3, 3));
    const auto target = [](std::size_t robot, std::size_t leg) {
        return 0.1 * static_cast<double>((robot + leg) % 7) - 0.3;
    };
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t leg = 0; leg < 4; ++leg)
            sim.states[r].motors[leg] = {MotorMode::kPosition, target(r, leg), 5};
    sim.run(4);
    double off = 0;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t leg = 0; leg < 4; ++leg)
            off = std::fmax(off, std::fabs(sim.states[r].q[7 + leg] - target(r, leg)));
    tell("legs off their targets, rad", off);
    tell("fastest trunk, m/s or rad/s", fastest(sim));
    EXPECT_LT(off, 1e-3);
    EXPECT_LT(fastest(sim), 1e-2);
}

/// Robots fly at each other with nothing else around.
TEST(SoftJoints, KeepMomentumAndGainNoEnergy) {
    World world = world_with("fast", {});
    Random random(5);
    place_legged(world, 3, 3, 0, random);
    Simulation sim(world);
    for (RobotState& state : sim.states) {
        const Pose X = base_pose(state);
        const Vec3 v = (X.p - Vec3{0.17, 0.17, 0.17}) * -4.0;
        state.v[3] = v.x, state.v[4] = v.y, state.v[5] = v.z;
    }
    const Momentum before = sim.momentum();
    double energy = sim.energy(), gained = 0, size = 0;
    int contacts = 0;
    for (const RobotState& state : sim.states) size += 0.7 * norm(Vec3{state.v[3], state.v[4], state.v[5]});
    for (int i = 0; i < 150; ++i) {
        contacts += sim.step().contacts;
        gained = std::fmax(gained, sim.energy() / energy - 1), energy = sim.energy();
    }
    const Momentum after = sim.momentum();
    tell("contacts", contacts);
    tell("energy gained in a tick, relative", gained);
    tell("linear momentum off by, relative", norm(after.linear - before.linear) / size);
    tell("angular momentum off by, relative", norm(after.angular - before.angular) / size);
    EXPECT_GT(contacts, 200);
    EXPECT_LT(norm(after.linear - before.linear) / size, 1e-12);
    EXPECT_LT(norm(after.angular - before.angular) / size, 1e-12);
    EXPECT_LT(gained, 1e-4);
}

/// Two fingers on slides press a box between them for a minute.
TEST(SoftJoints, AGripperHoldsABoxByFriction) {
    World world = world_with("fast");
    ModelSpec gripper;
    gripper.name = "gripper";
    gripper.canonical_link = "palm";
    gripper.links.push_back(link("palm", 1, box_inertia(1, {0.1, 0.1, 0.05}), {{0, 0, 1}, {}}));
    gripper.joints.push_back(
        joint(JointSpecKind::kPrismatic, "lift", "world", "palm", {{0, 0, 1}, {}}, {0, 0, 1}));
    gripper.joints.back().axes[0].max_effort = 200;
    for (const double side : {-1.0, 1.0}) {
        const std::string name = side < 0 ? "left" : "right";
        const Pose X{{0.045 * side, 0, 0.9}, {}};
        LinkSpec finger = link(name, 0.1, box_inertia(0.1, {0.01, 0.04, 0.1}), X);
        finger.collisions.push_back(box_shape({0.01, 0.04, 0.1}, surface(0.8)));
        gripper.links.push_back(finger);
        gripper.joints.push_back(
            joint(JointSpecKind::kPrismatic, "slide_" + name, "palm", name, X, {-side, 0, 0}));
        gripper.joints.back().axes[0].max_effort = 40;
    }
    place(world, gripper, "gripper");
    place(world, solid_box(0.5, {0.08, 0.06, 0.06}, surface(0.8)), "box", {{0, 0, 0.88}, {}});
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kVelocity, 0);
    for (std::size_t d = 1; d < 3; ++d) sim.set_motor(0, d, MotorMode::kEffort, 10);
    sim.run(0.5);
    const RobotState held = sim.states[1];
    sim.run(60);
    const Vec3 slip = base_pose(sim.states[1]).p - base_pose(held).p;
    tell("slipped in a minute, mm", 1e3 * norm(slip));
    EXPECT_LT(norm(slip), 1e-3);
    EXPECT_GT(base_pose(held).p.z, 0.87);
}

TEST(SoftJoints, NoBitDependsOnLanesOrTeam) {
    const auto hash = [](std::size_t lanes, unsigned threads) {
        ThreadPool pool(threads);
        Simulation sim(legged_heap("fast", 5, 5));
        sim.scratch.use_lanes(lanes);
        if (threads > 1) sim.scratch.use_team(Team(pool));
        sim.run(0.5);
        return sim.hash();
    };
    const std::uint64_t one = hash(1, 1);
    EXPECT_EQ(one, hash(4, 1));
    EXPECT_EQ(one, hash(8, 2));
}

/// Other robots in the call do not change a heap.
TEST(SoftJoints, NoBitDependsOnOtherHeaps) {
    World world = legged_heap("fast", 2, 3);
    Simulation alone(world);
    Random random(4);
    for (int i = 0; i < 8; ++i)
        world.instances.push_back(
            {"other_" + std::to_string(i),
             world.instances.back().prototype,
             {{20 + 0.1 * (i % 2), 0.1 * (i / 2 % 2), 0.2 + 0.2 * (i / 4)}, random.rotation()},
             {}});
    Simulation both(world);
    alone.run(0.5), both.run(0.5);
    for (std::size_t r = 0; r < alone.states.size(); ++r)
        EXPECT_EQ(state_hash(RobotId(r), 1, alone.states[r]), state_hash(RobotId(r), 1, both.states[r])) << r;
}

}  // namespace
}  // namespace roboss::test
