// Bonds and the grouping of robots: who shares a call changes no bit. And bonds and sleep.
#include <gtest/gtest.h>

#include <support/bonds.h>

namespace roboss::test {
namespace {

/// Attaches, detaches and teleports at random, the same in both simulations.
void meddle(Simulation& a, Simulation& b, Random& random) {
    const auto robots = static_cast<int>(a.states.size());
    const auto apply = [&](std::size_t robot, const Action& action) {
        const Order order = order_for(a, robot, action);
        ASSERT_TRUE(check_order(*a.model, order).ok());
        apply_order(*a.model, order, a.states[robot]);
        apply_order(*b.model, order, b.states[robot]);
    };
    const auto one = static_cast<std::size_t>(random.integer(0, robots - 1));
    const auto other = static_cast<std::size_t>(random.integer(0, robots - 1));
    const double dice = random.uniform(0, 1);
    if (dice < 0.5 && one != other) {
        Attach attach = attach_to(other, random.uniform(0, 0.3));
        if (random.uniform(0, 1) < 0.5) attach.max_force = random.uniform(1, 50);
        apply(one, attach);
    } else if (dice < 0.55) {
        apply(one, Detach{});
    } else if (dice < 0.6) {
        Pose X = base_pose(a.states[one]);
        X.p.x += random.uniform(-0.02, 0.02);
        set_base_pose(a.states[one], X), set_base_pose(b.states[one], X);
        a.states[one].rest = b.states[one].rest = {};
    }
}

void expect_same_in_groups(bool sleeps, std::uint64_t seeds, int ticks) {
    std::size_t islands = 0, robot_ticks = 0, bonds = 0, asleep = 0;
    GroupedStepper stepper;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        World world = random_crowd(seed, 2 + static_cast<int>(seed % 9));
        world.sleep = sleeps;
        Simulation whole(world), grouped(world);
        if (!sleeps) stir(whole, seed), stir(grouped, seed);
        Random random(seed + 7);
        for (int i = 0; i < ticks; ++i) {
            if (!sleeps || i % 50 == 0) {
                ASSERT_NO_FATAL_FAILURE(meddle(whole, grouped, random));
            }
            whole.step();
            islands += stepper.step(grouped);
            robot_ticks += whole.states.size();
            ASSERT_EQ(whole.hash(), grouped.hash()) << "seed " << seed << ", tick " << i;
            ASSERT_FALSE(whole.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
            asleep += static_cast<std::size_t>(whole.report.asleep);
            for (const RobotState& s : whole.states) bonds += s.bonds.size();
            ASSERT_LT(worst_slip(whole).distance, 1e-9) << "seed " << seed << ", tick " << i;
        }
    }
    tell("bonds a robot", static_cast<double>(bonds) / static_cast<double>(robot_ticks));
    tell("robots an island", static_cast<double>(robot_ticks) / static_cast<double>(islands));
    tell("share asleep", static_cast<double>(asleep) / static_cast<double>(robot_ticks));
    EXPECT_GT(bonds, robot_ticks / 16) << "bonds do form";
    EXPECT_GT(robot_ticks, islands + islands / 10) << "islands of several robots do occur";
    EXPECT_EQ(asleep > robot_ticks / 10, sleeps);
}

TEST(BondExact, GroupingByInteractionBoundsEqualsOneIsland) {
    expect_same_in_groups(false, 60, 60);
}

TEST(BondExact, GroupingWithSleepEqualsOneIsland) {
    expect_same_in_groups(true, 10, 1500);
}

TEST(BondExact, StateThroughBytesContinuesWithTheSameBits) {
    Simulation a(random_crowd(3, 8)), b(random_crowd(3, 8));
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        ASSERT_NO_FATAL_FAILURE(meddle(a, b, random));
        a.step();
        b.step();
        for (std::size_t r = 0; r < b.states.size(); ++r) {
            std::vector<std::uint8_t> bytes;
            encode(b.states[r], bytes);
            Result<RobotState> decoded = decode_state(bytes, b.type(r), b.states.size());
            ASSERT_TRUE(decoded.ok()) << decoded.error().text();
            b.states[r] = std::move(decoded).value();
        }
        ASSERT_EQ(a.hash(), b.hash()) << "tick " << i;
    }
}

TEST(BondExact, HoldersAndHeldLeaveTheLanesWithoutATrace) {
    World world = empty_world(1e-3);
    place(world, gantry(), "gantry_0", {{0, 0, 2}, {}});
    for (int i = 1; i < 12; ++i)
        world.instances.push_back({"gantry_" + std::to_string(i), 0, {{3.0 * i, 0, 2}, {}}, {}});
    for (int i = 0; i < 12; ++i)
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.5)), "box_" + std::to_string(i),
              {{3.0 * i, 0, 1.8}, {}});
    Simulation wide(world), single(world);
    single.scratch.use_lanes(1);
    for (Simulation* sim : {&wide, &single}) {
        for (std::size_t r = 0; r < 12; ++r)
            for (std::size_t d = 0; d < 4; ++d)
                sim->set_motor(r, d, MotorMode::kVelocity, 0.1 * static_cast<double>(r % 3));
        for (std::size_t r = 0; r < 12; r += 3) ASSERT_NO_FATAL_FAILURE(attach(*sim, r, r + 12, kHand));
        sim->run(0.5);
        EXPECT_EQ(sim->states[0].bonds.size(), 1u);
    }
    EXPECT_EQ(wide.hash(), single.hash());
}

World sleepy_pair() {
    World world = empty_world(2e-3);
    world.sleep = true;
    place(world, ground(surface(0.7)), "ground");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "a", {{0, 0, 0.1}, {}});
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "b", {{0.05, 0, 0.35}, {}});
    return world;
}

bool both_sleep(const Simulation& sim) {
    return sim.states[0].rest.asleep && sim.states[1].rest.asleep;
}

TEST(BondExact, BondedRobotsSleepAndWakeAsOne) {
    Simulation sim(sleepy_pair());  // the upper box touches nothing: the bond bears it
    ASSERT_NO_FATAL_FAILURE(attach(sim, 1, 0));
    sim.run(2);
    ASSERT_TRUE(both_sleep(sim));
    EXPECT_EQ(sim.states[0].rest.neighbours, std::vector<std::uint32_t>{1});
    EXPECT_EQ(sim.states[1].rest.neighbours, std::vector<std::uint32_t>{0});
    for (const std::size_t pushed : {0u, 1u}) {
        const Order order = order_for(sim, pushed, SetVelocity{{0.5, 0, 0}, {}});
        sim.step({&order, 1});
        EXPECT_FALSE(sim.states[0].rest.asleep || sim.states[1].rest.asleep) << pushed;
        sim.run(3);
        ASSERT_TRUE(both_sleep(sim)) << pushed;
        ASSERT_EQ(sim.states[1].bonds.size(), 1u);
    }
    const Order order = order_for(sim, 1, Detach{});
    sim.step({&order, 1});
    EXPECT_FALSE(sim.states[0].rest.asleep);
    sim.run(1);
    EXPECT_NEAR(sim.states[1].q[2], 0.3, 1e-3) << "it falls onto the other";
}

TEST(BondExact, ASleeperThatIsGraspedWakes) {
    World world = sleepy_pair();
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "c", {{0.5, 0, 0.1}, {}});
    Simulation sim(world);
    sim.run(3);
    ASSERT_TRUE(sim.states[0].rest.asleep && sim.states[2].rest.asleep);
    Attach action = attach_to(0, 0.5);
    const Order order = order_for(sim, 2, action);
    sim.step({&order, 1});
    EXPECT_EQ(sim.states[2].bonds.size(), 1u);
    EXPECT_FALSE(sim.states[0].rest.asleep);
    sim.run(3);
    EXPECT_TRUE(sim.states[0].rest.asleep);
}

TEST(BondExact, AStandWithoutJointsHoldsASleeperAndLetsItFall) {
    World world = sleepy_pair();
    ModelSpec stand = solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6));
    stand.name = "stand";
    stand.joints.push_back(joint(JointSpecKind::kFixed, "bolt", "world", "box", {}));
    place(world, stand, "stand", {{2, 0, 2}, {}});
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "held", {{2, 0, 1.7}, {}});
    Simulation sim(world);
    ASSERT_EQ(sim.type(2).nv, 0);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 2, 3));
    ASSERT_EQ(sim.states[2].bonds.size(), 1u);
    sim.run(2);
    EXPECT_TRUE(sim.states[3].rest.asleep);
    EXPECT_NEAR(sim.states[3].q[2], 1.7, 1e-6);
    ASSERT_EQ(sim.states[2].bonds.size(), 1u);
    sim.states[2].bonds[0].phase = BondPhase::kLoosed;  // as a gripper does without an order
    sim.step();
    EXPECT_FALSE(sim.states[3].rest.asleep);
    sim.run(0.3);
    EXPECT_LT(sim.states[3].q[2], 1.4);
}

}  // namespace
}  // namespace roboss::test
