// A step allocates nothing once its buffers have grown: operator new of this program is counted, then the
// same scene runs again.
#include <gtest/gtest.h>

#include <support/bonds.h>
#include <support/count_allocations.h>
#include <support/crowds.h>
#include <support/drives.h>
#include <support/joint_net.h>
#include <support/mechanisms.h>
#include <support/pressed_balls.h>
#include <support/scenes.h>
#include <algorithm>

#include "core/thread_pool.h"

namespace roboss::test {
namespace {

/// Runs the scene once to warm up, again from its start (states keep their capacity), and counts the second
/// run.
std::size_t allocations_of(Simulation& sim, int ticks) {
    const std::vector<RobotState> start = sim.states;
    for (int i = 0; i < ticks; ++i) sim.step();
    for (std::size_t r = 0; r < start.size(); ++r) sim.states[r] = start[r];
    sim.tick = 0;
    const std::size_t before = allocations;
    for (int i = 0; i < ticks; ++i) sim.step();
    return allocations - before;
}

TEST(Allocation, TheCounterCounts) {
    const std::size_t before = allocations;
    void* p = ::operator new(8);  // a call: a compiler may leave out new-expressions
    EXPECT_EQ(allocations, before + 1);
    ::operator delete(p);
    p = ::operator new (64, std::align_val_t{64});
    EXPECT_EQ(allocations, before + 2);
    ::operator delete (p, std::align_val_t{64});
}

TEST(Allocation, CarsOnAPlaneAllocateNothing) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, car(), "car_0");
    for (int i = 1; i < 20; ++i)
        world.instances.push_back({"car_" + std::to_string(i), 1, {{2.0 * i, 0, 0}, {}}, {}});
    Simulation sim(world);
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t d = 0; d < 4; ++d) sim.set_motor(r, d, MotorMode::kVelocity, d % 2 == 0 ? 4 : 10);
    EXPECT_EQ(allocations_of(sim, 500), 0u);
}

TEST(Allocation, RobotsOfVeryManyHullsAllocateNothing) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    ModelSpec model = with_hulls(spider(), 20, 0.1);
    model.self_collide = true;
    place(world, model, "a", {{0, 0, 0.3}, {}});
    world.instances.push_back({"b", 1, {{0.3, 0, 0.6}, {}}, {}});
    Simulation sim(world);
    allocations_of(sim, 300);  // the fronts of this pile trade buffers, so these grow in several runs
    EXPECT_EQ(allocations_of(sim, 300), 0u);
}

TEST(Allocation, CarsWithAnOnboardDriveAllocateNothing) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, skid_car(), "car_0");
    for (int i = 1; i < 20; ++i)
        world.instances.push_back({"car_" + std::to_string(i), 1, {{2.0 * i, 0, 0}, {}}, {}});
    Simulation sim(world);
    for (std::size_t r = 0; r < sim.states.size(); ++r) {
        const Order order = command(sim, r, "cmd_vel", {0.4, 0, 0, 0, 0, 0.1 * static_cast<double>(r)});
        sim.step({&order, 1});
    }
    EXPECT_EQ(allocations_of(sim, 500), 0u);
}

TEST(Allocation, ARobotThatIsPushedOnboardAllocatesNothing) {
    TrajectoryFollowerSpec spec;
    spec.link = {"box"}, spec.circle_radius = 2, spec.loop = true, spec.force = 20, spec.torque = 2;
    World world = empty_world(2e-3);
    place(world, ground(surface(0.4)), "ground");
    place(world, with_onboard(solid_box(2.0, {0.4, 0.4, 0.1}, surface(0.4)), spec), "robot",
          {{0, 0, 0.05}, {}});
    Simulation sim(world);
    EXPECT_EQ(allocations_of(sim, 500), 0u);
}

TEST(Allocation, BondsAllocateNothing) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    place(world, gantry(), "gantry", {{0, 0, 2}, {}});
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.5)), "box_0", {{0, 0, 1.8}, {}});
    for (int i = 1; i < 4; ++i)
        world.instances.push_back({"box_" + std::to_string(i), 2, {{0, 0, 1.8 - 0.2 * i}, {}}, {}});
    Simulation sim(world);
    for (std::size_t d = 0; d < 4; ++d) sim.set_motor(0, d, MotorMode::kVelocity, d == 2 ? 0 : 0.3);
    ASSERT_NO_FATAL_FAILURE(attach(sim, 0, 1, kHand));
    for (std::size_t r = 1; r < 4; ++r) ASSERT_NO_FATAL_FAILURE(attach(sim, r, r + 1));
    EXPECT_EQ(allocations_of(sim, 300), 0u);
    EXPECT_EQ(sim.states[3].bonds.size(), 1u) << "all hold";
}

TEST(Allocation, ABeltAndWhatLiesOnItAllocateNothing) {
    const ModelSpec belt = scenery(box_shape({4, 0.5, 0.2}, surface(0.6)));
    SurfaceVelocitySpec motion;
    motion.link = LinkNames{"link"}, motion.linear = {0.5, 0, 0};
    World world = empty_world(2e-3);
    place(world, with_onboard(belt, motion), "belt");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box", {{-1, 0, 0.2}, {}});
    Simulation sim(world);
    EXPECT_EQ(allocations_of(sim, 300), 0u);
    EXPECT_GT(base_pose(sim.states[1]).p.x, -0.8) << "it is conveyed";
}

TEST(Allocation, StackOfTenAllocatesNothing) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box_0", {{0, 0, 0.1}, {}});
    for (int i = 1; i < 10; ++i)
        world.instances.push_back({"box_" + std::to_string(i), 1, {{0, 0, 0.1 + 0.2 * i}, {}}, {}});
    Simulation sim(world);
    EXPECT_EQ(allocations_of(sim, 300), 0u);
}

TEST(Allocation, CollidingHeapAllocatesNothing) {
    Simulation sim(random_crowd(23, 30));
    stir(sim, 23);
    EXPECT_EQ(allocations_of(sim, 150), 0u);
}

TEST(Allocation, ProfileOfACollidingHeapAllocatesNothing) {
    Simulation sim(random_crowd(23, 30));
    stir(sim, 23);
    sim.scratch.measure_stages([] { return std::uint64_t{0}; });
    EXPECT_EQ(allocations_of(sim, 150), 0u);
    EXPECT_GT(sim.report.profile.solver.islands, 0u);
}

TEST(Allocation, FreeFlightAndMotorsInTheAirAllocateNothing) {
    World world = empty_world(1e-3);
    place(world, spider(), "spider");
    place(world, ball_chain(), "chain");
    place(world, arm(), "arm", {{5, 0, 0}, {}});
    Simulation sim(world);
    sim.set_motor(2, 0, MotorMode::kPosition, 0.5);
    sim.states[0].wrenches.push_back({LinkId(std::size_t{0}), {1, 2, 3}, {}, 50});
    EXPECT_EQ(allocations_of(sim, 200), 0u);
}

TEST(Allocation, LoopsAndGearsAllocateNothing) {
    World world = empty_world(1e-3);
    place(world, stewart(), "falling");
    place(world, four_bar(), "driven", {{5, 0, 0}, {}});
    place(world, geared_wheels(2), "wheels", {{9, 0, 0}, {}});
    Simulation sim(world);
    sim.states[1].motors[0] = {MotorMode::kVelocity, 5, 100};
    sim.states[1].motors[3] = {MotorMode::kEffort, 0.1, 1};
    sim.states[2].motors[0] = {MotorMode::kVelocity, 5, 100};
    EXPECT_EQ(allocations_of(sim, 200), 0u);
}

World hanging_net(std::size_t side) {
    ModelSpec net = joint_net(side, 0.4);
    for (JointSpec& joint : net.joints) joint.ball_damping = 1e-3;
    World world = empty_world(2e-3);
    place(world, net, "net");
    return world;
}

TEST(Allocation, ANetAllocatesNothing) {
    Simulation sim(hanging_net(6));
    EXPECT_EQ(allocations_of(sim, 100), 0u);
}

/// Of several runs with a team. A thread may get more in one run than in those before, and its buffers grow
/// then; so the first run that allocates nothing ends the search.
std::size_t fewest_allocations_of_a_team(Simulation& sim, int ticks) {
    constexpr int kRuns = 30;
    ThreadPool pool(3);
    sim.scratch.use_team(Team(pool));
    std::size_t fewest = allocations_of(sim, ticks);
    for (int run = 1; run < kRuns && fewest > 0; ++run) fewest = std::min(fewest, allocations_of(sim, ticks));
    sim.scratch.use_team({});
    return fewest;
}

TEST(Allocation, ATeamThatSharesANetAllocatesNothing) {
    Simulation sim(hanging_net(11));
    EXPECT_EQ(fewest_allocations_of_a_team(sim, 10), 0u);
}

TEST(Allocation, ATeamThatSharesOnePileAllocatesNothing) {
    Simulation sim(balls_side_by_side());
    press_together(sim);
    const std::vector<RobotState> start = sim.states;
    std::uint64_t largest = 0;
    for (int i = 0; i < 8; ++i)
        sim.step(), largest = std::max(largest, sim.report.profile.solver.largest_part);
    EXPECT_GE(largest, 768u) << "a team would not share its parts";
    for (std::size_t r = 0; r < start.size(); ++r) sim.states[r] = start[r];
    sim.tick = 0;
    EXPECT_EQ(fewest_allocations_of_a_team(sim, 8), 0u);
}

}  // namespace
}  // namespace roboss::test
