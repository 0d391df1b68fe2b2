// Sleep: who falls asleep, who wakes, what it costs, and that none of it depends on who else is in the call.
#include <gtest/gtest.h>

#include <support/scenes.h>

namespace roboss::test {
namespace {

constexpr double kEdge = 0.2;

World sleepy_world(double dt_s = 2e-3) {
    World world = empty_world(dt_s);
    world.sleep = true;
    place(world, ground(surface(0.7)), "ground");
    return world;
}

/// Boxes one upon the other; the lowest is robot 0.
World sleepy_stack(int boxes) {
    World world = sleepy_world();
    const std::size_t box = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)));
    for (int i = 0; i < boxes; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i), box, {{0.01 * i, 0, kEdge * (0.5 + i)}, {}}, {}});
    return world;
}

std::size_t count_asleep(const Simulation& sim) {
    std::size_t n = 0;
    for (const RobotState& s : sim.states) n += s.rest.asleep ? 1 : 0;
    return n;
}

/// Steps until all sleep; false if they do not within `seconds`.
bool fall_asleep(Simulation& sim, double seconds) {
    while (sim.time() < seconds && count_asleep(sim) < sim.states.size()) sim.step();
    return count_asleep(sim) == sim.states.size();
}

Order order_for(const Simulation& sim, std::size_t robot, Action action) {
    return {sim.tick, ClientId(0u), 1, RobotId(robot), std::move(action)};
}

std::vector<std::uint8_t> bytes_of(const Simulation& sim) {
    std::vector<std::uint8_t> bytes;
    for (const RobotState& s : sim.states) encode(s, bytes);
    return bytes;
}

World falling_heap(int boxes) {
    World world = sleepy_world();
    const std::size_t first = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {0.2, 0.3, 0.1}, surface(0.6)));
    world.prototypes.push_back(solid_box(0.5, {0.15, 0.15, 0.15}, surface(0.7)));
    Random random(7);
    for (int i = 0; i < boxes; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i),
             first + static_cast<std::size_t>(i % 2),
             {{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.2 + 0.12 * i}, random.rotation()},
             {}});
    return world;
}

TEST(Sleep, AHeapFallsAsleepAndThenChangesNoBit) {
    Simulation sim(falling_heap(24));
    ASSERT_TRUE(fall_asleep(sim, 60));
    tell("a heap of 24 boxes sleeps after, s", sim.time());
    const std::vector<std::uint8_t> before = bytes_of(sim);
    sim.run(1);
    EXPECT_EQ(sim.report.asleep, 24);
    EXPECT_EQ(bytes_of(sim), before);
}

TEST(Sleep, TakesNoMoreEnergyThanItsThresholdAllows) {
    World world = sleepy_world();
    place(world, solid_sphere(2.0, 0.1, surface(0.5)), "slow ball", {{0, 0, 0.1}, {}});
    place(world, solid_sphere(2.0, 0.1, surface(0.5)), "faster ball", {{3, 0, 0.1}, {}});
    Simulation sim(world);
    for (const std::size_t r : {0u, 1u}) {
        const double v = r == 0 ? 4e-4 : 2e-3;
        sim.states[r].v = {0, v / 0.1, 0, v, 0, 0};
    }
    const double before = sim.energy(0);
    sim.run(2);
    ASSERT_TRUE(sim.states[0].rest.asleep);
    EXPECT_FALSE(sim.states[1].rest.asleep) << "2 mm/s is motion";
    tell("energy taken by falling asleep, J a kg", (before - sim.energy(0)) / 2);
    EXPECT_GT(before, sim.energy(0));
    EXPECT_LT((before - sim.energy(0)) / 2, 1e-6);
}

TEST(Sleep, TakingTheLowestAwayWakesTheStack) {
    Simulation sim(sleepy_stack(5));
    ASSERT_TRUE(fall_asleep(sim, 10));
    const double top = sim.states[4].q[2];
    const Order away[] = {order_for(sim, 0, SetPose{{{30, 0, 0.1}, {}}})};
    sim.step(away);
    EXPECT_EQ(count_asleep(sim), 0u);
    sim.run(0.15);
    EXPECT_LT(sim.states[4].q[2], top - 0.1) << "they fall";
    EXPECT_TRUE(fall_asleep(sim, 30)) << "and sleep again";
}

TEST(Sleep, TakingTheLowestAwayWakesTheRestAlsoWhenItIsSteppedElsewhere) {
    // The order takes effect at the first tick of a window: box 0 is far away before anybody looks, and steps
    // in a call of its own.
    Simulation together(sleepy_stack(5)), apart(sleepy_stack(5));
    ASSERT_TRUE(fall_asleep(together, 10));
    ASSERT_TRUE(fall_asleep(apart, 10));
    StepScratch here, there;
    for (int i = 0; i < 600; ++i) {
        std::vector<Order> orders;
        if (i == 0) orders = {order_for(together, 0, SetPose{{{30, 0, 0.1}, {}}})};
        together.step(orders);
        std::vector<Aabb> bounds(4), bound(1);
        const std::span<const RobotId> ids(apart.ids);
        const std::span<RobotState* const> states(apart.pointers);
        step_island(*apart.model, apart.tick, ids.subspan(1), states.subspan(1), orders, bounds, here);
        step_island(*apart.model, apart.tick, ids.first(1), states.first(1), orders, bound, there);
        ++apart.tick;
        ASSERT_EQ(together.hash(), apart.hash()) << "tick " << i;
    }
}

/// Boxes side by side, so near that one that wakes wakes the next, too far to have touched.
World sleepy_row(int boxes, int falling_far_away) {
    World world = sleepy_world();
    const std::size_t box = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)));
    for (int i = 0; i < boxes; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i), box, {{(kEdge + 1.5e-3) * i, 0, 0.5 * kEdge}, {}}, {}});
    for (int i = 0; i < falling_far_away; ++i)
        world.instances.push_back({"far_" + std::to_string(i), box, {{10.0 * i, 1000, 1e4}, {}}, {}});
    return world;
}

TEST(Sleep, AWholeRowWakesInOneTickWhoeverElseIsThere) {
    constexpr std::size_t kBoxes = 150;
    Simulation alone(sleepy_row(kBoxes, 0)), in_company(sleepy_row(kBoxes, 20));
    for (Simulation* sim : {&alone, &in_company}) {
        while (sim->time() < 5 && count_asleep(*sim) < kBoxes) sim->step();
        ASSERT_EQ(count_asleep(*sim), kBoxes);
        const Order push[] = {order_for(*sim, 0, SetVelocity{{0.5, 0, 0}, {}})};
        sim->step(push);
        EXPECT_EQ(count_asleep(*sim), 0u);
        for (int i = 0; i < 20; ++i) sim->step();
    }
    ASSERT_EQ(alone.tick, in_company.tick);
    for (std::size_t i = 0; i < kBoxes; ++i) {
        std::vector<std::uint8_t> a, b;
        encode(alone.states[i], a), encode(in_company.states[i], b);
        EXPECT_EQ(a, b) << "box " << i;
    }
}

TEST(Sleep, AHitWakesAndMomentumIsHandedOn) {
    World world = sleepy_world(1e-3);
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0)), "box", {{0, 0, 0.5 * kEdge}, {}});
    place(world, solid_sphere(1.0, 0.05, surface(0)), "ball", {{-2, 0, 0.1}, {}});
    Simulation sim(world);
    // The ball keeps rolling about until it is sent on.
    while (!sim.states[0].rest.asleep && sim.time() < 5) {
        sim.states[1].q[0] = -2, sim.states[1].q[2] = 0.1, sim.states[1].v[3] = 1;
        sim.step();
    }
    ASSERT_TRUE(sim.states[0].rest.asleep);
    sim.states[1].q = {-0.5, 0, 0.1, 1, 0, 0, 0};
    sim.states[1].v = {0, 0, 0, 2, 0, 0.3};
    while (sim.states[0].rest.asleep && sim.time() < 8) sim.step();
    sim.run(0.05);
    EXPECT_NEAR(sim.momentum().linear.x, 2, 1e-6);
    EXPECT_GT(sim.states[0].v[3], 0.5);
}

TEST(Sleep, WhatPassesByDoesNotWake) {
    World world = sleepy_world();
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)), "box", {{0, 0, 0.5 * kEdge}, {}});
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0)), "slider", {{-3, 0.205, 0.5 * kEdge}, {}});
    Simulation sim(world);
    while (!sim.states[0].rest.asleep && sim.time() < 5) {
        sim.states[1].q[0] = -3, sim.states[1].v[3] = 1.5;
        sim.step();
    }
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        ASSERT_TRUE(sim.states[0].rest.asleep) << "at x = " << sim.states[1].q[0];
    }
    EXPECT_GT(sim.states[1].q[0], 1);
}

TEST(Sleep, AnyOrderWakes) {
    const Action actions[] = {SetPose{{{0, 0, 0.1}, {}}}, SetVelocity{{0, 0, 0}, {0, 0, 0}},
                              ApplyWrench{LinkId(0u), {0, 0, 0}, {}, 1}};
    for (const Action& action : actions) {
        Simulation sim(sleepy_stack(3));
        ASSERT_TRUE(fall_asleep(sim, 10));
        const Order order[] = {order_for(sim, 0, action)};
        sim.step(order);
        EXPECT_EQ(count_asleep(sim), 0u);
        EXPECT_TRUE(fall_asleep(sim, 20));
    }
}

TEST(Sleep, ABrakedCarSleepsADrivenOneDoesNot) {
    for (const double target : {0.0, 8.0}) {
        World world = sleepy_world();
        place(world, scenery(box_shape({0.2, 4, 1}, surface(0.1))), "wall", {{0.5, 0, 0}, {}});
        place(world, car(), "car");
        Simulation sim(world);
        for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, target);
        sim.states[0].motors[0].max_effort = sim.states[0].motors[1].max_effort = 0.02;
        sim.run(6);
        EXPECT_EQ(sim.states[0].rest.asleep, target == 0);
    }
}

/// An arm of one hinge that a servo with gains holds level; gravity makes it droop by several degrees.
World drooping_arm() {
    World world = sleepy_world(1e-3);
    ModelSpec arm = pendulum();
    arm.joints[0].axes[0].position_gain = 60;
    arm.joints[0].axes[0].velocity_gain = 10;
    place(world, arm, "arm", {{0, 0, 2}, {}});
    return world;
}

TEST(Sleep, AServoThatDroopsSleepsAndWakesByANewTarget) {
    Simulation sim(drooping_arm());
    sim.set_motor(0, 0, MotorMode::kPosition, -kPi / 2);
    ASSERT_TRUE(fall_asleep(sim, 10));
    const double q = sim.states[0].q[7];
    EXPECT_GT(std::fabs(q + kPi / 2), 0.05) << "it droops";
    const Order order = order_for(sim, 0, SetJoint{JointId(0u), 0, MotorMode::kPosition, -1.0, -1});
    sim.step({&order, 1});
    EXPECT_FALSE(sim.states[0].rest.asleep);
    ASSERT_TRUE(fall_asleep(sim, sim.time() + 10));
    EXPECT_GT(std::fabs(sim.states[0].q[7] - q), 0.3);
}

TEST(Sleep, AServoThatApproachesSlowlyArrivesFirst) {
    World world = sleepy_world(1e-3);
    ModelSpec arm = pendulum();
    arm.joints[0].axes[0].max_velocity = 2e-3;
    place(world, arm, "arm", {{0, 0, 2}, {}});
    Simulation sim(world);
    sim.set_motor(0, 0, MotorMode::kPosition, 5e-3);
    ASSERT_TRUE(fall_asleep(sim, 10));
    EXPECT_GT(sim.time(), 2.5);
    EXPECT_NEAR(sim.states[0].q[7], 5e-3, 1e-4);
}

/// A slider of 1 kg on a vertical rail.
ModelSpec slider() {
    ModelSpec model = one_link(link("cart", 1.0, box_inertia(1.0, {0.1, 0.1, 0.1}), {{0, 0, 5}, {}}));
    model.joints.push_back(
        joint(JointSpecKind::kPrismatic, "rail", "world", "cart", {{0, 0, 5}, {}}, {0, 0, 1}));
    return model;
}

TEST(Sleep, AJointThatADamperSlowsDownCreepsOn) {
    // Half a millimetre a second: slower than rest. A damper of the joint, then one of its motor.
    for (const bool by_motor : {false, true}) {
        World world = sleepy_world(2e-3);
        ModelSpec cart = slider();
        (by_motor ? cart.joints[0].axes[0].velocity_gain : cart.joints[0].axes[0].damping) = 20000;
        place(world, cart, "cart");
        Simulation sim(world);
        if (by_motor) sim.set_motor(0, 0, MotorMode::kVelocity, 0);
        sim.run(10);
        EXPECT_FALSE(sim.states[0].rest.asleep);
        EXPECT_NEAR(sim.states[0].q[7], -9.81 / 20000 * 10,
                    1e-6);  // m g = damping * v, but for the first tick
    }
}

TEST(Sleep, AJointThatADamperBringsToItsSpringSleepsThere) {
    World world = sleepy_world(2e-3);
    ModelSpec cart = slider();
    cart.joints[0].axes[0].damping = 200,
    cart.joints[0].axes[0].spring_stiffness = 400;  // 0.5 s to a share of 1 / e
    place(world, cart, "cart");
    Simulation sim(world);
    ASSERT_TRUE(fall_asleep(sim, 20));
    EXPECT_NEAR(sim.states[0].q[7], -9.81 / 400, 5e-5);
}

TEST(Sleep, APendulumAtItsTurningPointAndASlowDriftStayAwake) {
    World world = sleepy_world(1e-3);
    world.gravity = {0, 0, -1e-5};  // so slow that its turn takes seconds
    ModelSpec arm = one_link(link("rod", 1.0, box_inertia(1.0, {1, 0.1, 0.1}), {{0.5, 0, 5}, {}}));
    arm.joints.push_back(
        joint(JointSpecKind::kRevolute, "hinge", "world", "rod", {{0, 0, 5}, {}}, {0, 1, 0}));
    place(world, arm, "pendulum");
    place(world, solid_sphere(1, 0.1, surface(0.5)), "drifting", {{3, 0, 8}, {}});
    Simulation sim(world);
    sim.states[1].v[3] = 5e-4;
    for (int i = 0; i < 3000; ++i) {
        sim.step();
        ASSERT_EQ(count_asleep(sim), 0u) << "tick " << i;
    }
}

/// A box of 1 m and 1 kg at that height of its centre, over a plane.
World box_in_the_ground(double height, double max_vel = -1) {
    World world = sleepy_world(1e-3);
    SurfaceSpec s = surface(0.6);
    s.max_vel = max_vel;
    place(world, solid_box(1.0, {1, 1, 1}, s), "box", {{0, 0, height}, {}});
    return world;
}

TEST(Sleep, WhatIsPushedOutOfTheGroundStaysAwakeUntilItIsOut) {
    struct Case {
        double height, max_vel, seconds;
    };
    // The deepest, at 2 m/s; at 1 cm/s; so slowly that the speed alone would count as rest.
    for (const Case& c : {Case{-1.5, -1, 4}, Case{0.45, 0.01, 8}, Case{0.499, 5e-4, 6}}) {
        Simulation sim(box_in_the_ground(c.height, c.max_vel));
        while (sim.time() < c.seconds && !sim.states[0].rest.asleep) sim.step();
        EXPECT_TRUE(sim.states[0].rest.asleep) << "from " << c.height;
        EXPECT_NEAR(sim.states[0].q[2], 0.5 - 1e-5, 1e-5) << "from " << c.height;
    }
}

TEST(Sleep, WhatMayNotBePushedOutSleeps) {
    Simulation sim(box_in_the_ground(0.45, 0));
    ASSERT_TRUE(fall_asleep(sim, 2));
    EXPECT_NEAR(sim.states[0].q[2], 0.45, 1e-9);
}

TEST(Sleep, APoleOnABaseThatIsPushedOutFallsOver) {
    World world = sleepy_world(1e-3);
    ModelSpec robot = solid_box(10.0, {0.6, 0.6, 0.1}, surface(0.6));
    robot.links.push_back(link("pole", 1.0, box_inertia(1.0, {0.05, 0.05, 0.8}), {{0, 0, 0.5}, {}}));
    robot.joints.push_back(
        joint(JointSpecKind::kRevolute, "hinge", robot.links[0].name, "pole", {{0, 0, 0.1}, {}}, {0, 1, 0}));
    robot.joints[0].axes[0].lower = -2, robot.joints[0].axes[0].upper = 2;
    place(world, robot, "robot", {{0, 0, -1.2}, {}});
    World sleepless = world;
    sleepless.sleep = false;
    Simulation sleepy(world), awake(sleepless);
    for (Simulation* sim : {&sleepy, &awake}) {
        sim->states[0].q[7] = 0.3;
        sim->run(10);
    }
    EXPECT_GT(std::fabs(awake.states[0].q[7]), 1.5);
    EXPECT_NEAR(sleepy.states[0].q[7], awake.states[0].q[7], 5e-3);
    EXPECT_NEAR(sleepy.states[0].q[2], awake.states[0].q[2], 1e-3);
}

TEST(Sleep, CanBeForbiddenForAModelAndForTheWorld) {
    for (const bool model : {true, false}) {
        World world = sleepy_stack(3);
        if (model) {
            world.prototypes[1].may_sleep = false;
        } else {
            world.sleep = false;
        }
        Simulation sim(world);
        sim.run(4);
        EXPECT_EQ(count_asleep(sim), 0u);
    }
}

TEST(Sleep, ARobotFixedToTheWorldBearsSleepersAndWakesThemWhenItIsMoved) {
    World world = sleepy_world();
    ModelSpec table = solid_box(5.0, {0.6, 0.6, 0.1}, surface(0.6));
    table.joints.push_back(joint(JointSpecKind::kFixed, "bolt", "world", "box", {}));
    place(world, table, "table", {{0, 0, 0.5}, {}});
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)), "box", {{-0.15, 0, 0.65}, {}});
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)), "late", {{0.15, 0, 3}, {}});
    Simulation sim(world);
    while (!sim.states[1].rest.asleep && sim.time() < 5) {
        sim.states[2].q[2] = 3;
        sim.step();
    }
    ASSERT_TRUE(sim.states[1].rest.asleep);
    for (int i = 0; i < 1000; ++i) {
        sim.step();
        ASSERT_TRUE(sim.states[1].rest.asleep) << "the other falls on the table, not on the box";
    }
    ASSERT_TRUE(fall_asleep(sim, 10) || count_asleep(sim) == 2);
    const Order order[] = {order_for(sim, 0, SetPose{{{9, 0, 0.5}, {}}})};
    sim.step(order);
    EXPECT_EQ(count_asleep(sim), 0u);
    sim.run(0.3);
    EXPECT_LT(sim.states[1].q[2], 0.4);
}

/// Heaps that sleep, and cars that drive into them one after the other.
World heaps_and_cars() {
    World world = falling_heap(8);
    const std::size_t box = 1;
    for (int i = 0; i < 3; ++i)
        world.instances.push_back(
            {"other_" + std::to_string(i), box, {{4, 0.02 * i, 0.06 + 0.11 * i}, {}}, {}});
    for (int i = 0; i < 3; ++i) place(world, car(), "car_" + std::to_string(i), {{-2.0 - 1.5 * i, 0, 0}, {}});
    return world;
}

TEST(Sleep, GroupingBytesAndScratchChangeNoBit) {
    Simulation whole(heaps_and_cars()), grouped(heaps_and_cars()), through_bytes(heaps_and_cars());
    GroupedStepper stepper;
    std::size_t slept = 0, woken = 0, before = 0;
    for (int i = 0; i < 7000; ++i) {
        for (Simulation* sim : {&whole, &grouped, &through_bytes})
            for (std::size_t c = 11; c < 14; ++c)
                if (i == 2000 * static_cast<int>(c - 10))
                    for (std::size_t wheel = 0; wheel < 4; ++wheel) {
                        sim->states[c].rest = {};
                        sim->set_motor(c, wheel, MotorMode::kVelocity, 20);
                    }
        whole.step();
        stepper.step(grouped);
        if (i % 10 == 0)
            for (std::size_t r = 0; r < through_bytes.states.size(); ++r) {
                std::vector<std::uint8_t> bytes;
                encode(through_bytes.states[r], bytes);
                through_bytes.states[r] = decode_state(bytes, through_bytes.type(r)).value();
            }
        through_bytes.scratch = StepScratch();
        through_bytes.step();
        ASSERT_EQ(whole.hash(), grouped.hash()) << "tick " << i;
        ASSERT_EQ(whole.hash(), through_bytes.hash()) << "tick " << i;
        const std::size_t now = count_asleep(whole);
        slept += now > before ? now - before : 0;
        woken += now < before ? before - now : 0;
        before = now;
    }
    tell("robots that fell asleep", static_cast<double>(slept));
    tell("robots that woke", static_cast<double>(woken));
    EXPECT_GT(slept, 14u);
    EXPECT_GT(woken, 8u);
}

TEST(Sleep, BoundsOfSleepersAreInteractionBounds) {
    Simulation sim(sleepy_stack(4));
    ASSERT_TRUE(fall_asleep(sim, 10));
    sim.step();
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        EXPECT_EQ(interaction_bound(*sim.model, sim.ids[r], sim.states[r]), sim.bounds[r]);
}

/// What it costs is counted here and timed by the benchmark stacks_asleep.
TEST(Sleep, NoWorkIsDoneOfAThousandSleepersAndOnlyThatOfOneThatIsAwake) {
    World world = sleepy_world();
    const std::size_t box = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)));
    for (int i = 0; i < 1000; ++i)  // stacks of four
        world.instances.push_back({"box_" + std::to_string(i),
                                   box,
                                   {{0.3 * (i / 4 % 16), 0.3 * (i / 64), kEdge * (0.5 + i % 4)}, {}},
                                   {}});
    Simulation sim(world);
    sim.step();
    EXPECT_EQ(sim.report.placed, 1000);
    ASSERT_TRUE(fall_asleep(sim, 3));
    sim.step();
    EXPECT_EQ(sim.report.asleep, 1000);
    EXPECT_EQ(sim.report.placed, 0);
    EXPECT_EQ(sim.report.iterations, 0);
    const Order order[] = {order_for(sim, 999, SetPose{{{-5, 0, 1e4}, {}}})};
    sim.step(order);
    EXPECT_EQ(sim.report.placed, 4) << "those it lay on have lost a neighbour";
    sim.run(1);
    EXPECT_EQ(sim.report.asleep, 999);
    EXPECT_EQ(sim.report.placed, 1);
}

}  // namespace
}  // namespace roboss::test
