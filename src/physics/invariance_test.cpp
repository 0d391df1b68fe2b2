// The product's heart: a robot's bits depend on the model, its state and its orders, never on who shares the
// call, on what the scratch did before, on the caller's floating-point flags, or on a trip through bytes.
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include <support/float_control.h>
#include <support/pressed_balls.h>
#include <support/scenes.h>

#include "core/thread_pool.h"
#include "physics/bodies/body_solver.h"

namespace roboss::test {
namespace {

void expect_same_bits(const RobotState& a, const RobotState& b, const std::string& where) {
    std::vector<std::uint8_t> x, y;
    encode(a, x);
    encode(b, y);
    ASSERT_EQ(x, y) << where;
}

/// Ground, and as the last prototypes a box and a car.
World boxes_and_cars() {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.7)), "ground");
    world.prototypes.push_back(solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6, 0.2)));
    world.prototypes.push_back(car());
    return world;
}

/// Two heaps and two cars, far apart, in one world.
World two_places() {
    World world = boxes_and_cars();
    const std::size_t box = world.prototypes.size() - 2;
    for (int i = 0; i < 8; ++i) {
        const double x = i % 2 == 0 ? 0 : 50;  // ids alternate between the places
        world.instances.push_back(
            {"box_" + std::to_string(i), box, {{x + 0.05 * i, 0.02 * i, 0.12 + 0.12 * i}, {}}, {}});
    }
    world.instances.push_back({"car_a", box + 1, {{0.5, 0, 0}, {}}, {}});
    world.instances.push_back({"car_b", box + 1, {{50.5, 0, 0}, {}}, {}});
    return world;
}

std::vector<std::size_t> robots_near(const Simulation& sim, double x) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < sim.states.size(); ++i)
        if (std::fabs(sim.states[i].q[0] - x) < 20) found.push_back(i);
    return found;
}

void step_members(Simulation& sim, const std::vector<std::size_t>& members, StepScratch& scratch) {
    std::vector<RobotId> ids;
    std::vector<RobotState*> states;
    std::vector<Aabb> bounds(members.size());
    for (std::size_t m : members) ids.push_back(sim.ids[m]), states.push_back(&sim.states[m]);
    step_island(*sim.model, sim.tick, ids, states, {}, bounds, scratch);
}

TEST(Invariance, IslandsApartAndTogetherGiveTheSameBits) {
    const World world = two_places();
    Simulation together(world), apart(world);
    stir(together, 1);
    stir(apart, 1);
    const std::vector<std::size_t> here = robots_near(apart, 0), there = robots_near(apart, 50);
    ASSERT_EQ(here.size(), 5u);
    ASSERT_EQ(there.size(), 5u);
    StepScratch first, second;
    int contacts = 0;
    for (int i = 0; i < 600; ++i) {
        contacts += together.step().contacts;
        step_members(apart, there, second);  // the order of the islands must not matter either
        step_members(apart, here, first);
        ++apart.tick;
        ASSERT_EQ(together.hash(), apart.hash()) << "tick " << i;
    }
    EXPECT_GT(contacts, 10000);
}

TEST(Invariance, FarAwayRobotsChangeNoBit) {
    const World small = random_crowd(5, 6);
    World large = small;
    for (int i = 0; i < 20; ++i)
        large.instances.push_back({"far_" + std::to_string(i),
                                   2 + static_cast<std::size_t>(i % 5),
                                   {{100.0 + 0.15 * i, 0, 0.3}, {}},
                                   {}});
    Simulation a(small), b(large);
    stir(a, 9);
    stir(b, 9);
    for (int i = 0; i < 300; ++i) {
        a.step();
        b.step();
        for (std::size_t r = 0; r < a.states.size(); ++r)
            ASSERT_NO_FATAL_FAILURE(expect_same_bits(a.states[r], b.states[r], "robot " + std::to_string(r)));
    }
}

TEST(Invariance, ManySmallCrowdsEachByItselfAndAllInOneCallGiveTheSameBits) {
    // Two hundred robots, in crowds of five: more than are stepped as one group.
    constexpr int kCrowds = 40;
    World world = random_crowd(11, 5);
    const std::vector<ModelInstance> crowd = world.instances;
    for (int c = 1; c < kCrowds; ++c)
        for (ModelInstance instance : crowd) {
            if (!instance.name.starts_with("robot_")) continue;
            instance.name += "_" + std::to_string(c), instance.X_WM.p.x += 20.0 * c;
            world.instances.push_back(instance);
        }
    Simulation together(world), apart(world);
    stir(together, 3);
    stir(apart, 3);
    StepScratch scratch;
    for (int i = 0; i < 200; ++i) {
        together.step();
        for (int c = 0; c < kCrowds; ++c) {
            std::vector<std::size_t> members;
            for (std::size_t r = 0; r < 5; ++r) members.push_back(static_cast<std::size_t>(c) * 5 + r);
            step_members(apart, members, scratch);
        }
        ++apart.tick;
        ASSERT_EQ(together.hash(), apart.hash()) << "tick " << i;
    }
}

TEST(Invariance, ScratchRemembersNothing) {
    const World world = random_crowd(7, 10);
    Simulation fresh(world), used(world);
    Simulation other(two_places());
    World arms = empty_world(1e-3);
    place(arms, spider(), "spider", {{0, 0, 1}, {}});
    place(arms, ball_chain(), "chain");
    Simulation smooth(arms);
    stir(fresh, 2);
    stir(used, 2);
    StepScratch scratch;
    for (int i = 0; i < 200; ++i) {
        fresh.scratch = StepScratch();
        fresh.step();
        std::swap(used.scratch, scratch);  // one scratch serves three worlds in turn
        used.step();
        std::swap(used.scratch, scratch);
        for (Simulation* sim : {&other, &smooth}) {
            std::swap(sim->scratch, scratch);
            sim->step();
            std::swap(sim->scratch, scratch);
        }
        ASSERT_EQ(fresh.hash(), used.hash()) << "tick " << i;
    }
}

TEST(Invariance, GroupingByInteractionBoundsEqualsOneIslandInFiveHundredScenes) {
    std::size_t islands = 0, robot_ticks = 0, contacts = 0, ticks = 0, unsolved = 0, wrong = 0;
    double worst = 0;
    int most = 0;
    GroupedStepper stepper;  // one scratch over all scenes
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const World world = random_crowd(seed, 2 + static_cast<int>(seed % 9));
        Simulation whole(world), grouped(world);
        stir(whole, seed);
        stir(grouped, seed);
        for (int i = 0; i < 40; ++i) {
            contacts += static_cast<std::size_t>(whole.step().contacts);
            islands += stepper.step(grouped);
            robot_ticks += whole.states.size();
            ASSERT_EQ(whole.hash(), grouped.hash()) << "seed " << seed << ", tick " << i;
            ASSERT_FALSE(whole.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
            unsolved += whole.report.residual > whole.model->accuracy.tolerance ? 1 : 0;
            wrong += whole.report.residual > 1e-6 ? 1 : 0;
            ++ticks;
            worst = std::fmax(worst, whole.report.residual);
            most = std::max(most, whole.report.iterations);
        }
    }
    tell("share of ticks that miss the solver's tolerance",
         static_cast<double>(unsolved) / static_cast<double>(ticks));
    tell("worst residual", worst);
    tell("most Newton iterations of a tick", most);
    tell("robots an island", static_cast<double>(robot_ticks) / static_cast<double>(islands));
    EXPECT_LE(1000 * wrong, ticks) << "momentum is balanced to 1e-6 in nearly every tick of a chaotic heap";
    EXPECT_GT(contacts, robot_ticks / 2) << "the scenes do collide";
    EXPECT_GT(robot_ticks, islands + islands / 20) << "islands of several robots do occur";
}

TEST(Invariance, BoundsOfTheStepAreInteractionBounds) {
    Simulation sim(random_crowd(3, 10));
    stir(sim, 3);
    for (int i = 0; i < 100; ++i) {
        std::vector<Aabb> expected;
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            expected.push_back(interaction_bound(*sim.model, sim.ids[r], sim.states[r]));
        sim.step();
        for (std::size_t r = 0; r < sim.states.size(); ++r) {
            EXPECT_EQ(expected[r].min, sim.bounds[r].min);
            EXPECT_EQ(expected[r].max, sim.bounds[r].max);
        }
    }
}

TEST(Invariance, StateThroughBytesContinuesWithTheSameBits) {
    const World world = random_crowd(11, 10);
    Simulation a(world), b(world);
    stir(a, 11);
    stir(b, 11);
    a.states[0].wrenches.push_back({LinkId(std::size_t{0}), {1, 2, 3}, {0.1, 0, 0}, 150});
    b.states[0].wrenches = a.states[0].wrenches;
    for (int i = 0; i < 300; ++i) {
        a.step();
        b.step();
        for (std::size_t r = 0; r < b.states.size(); ++r) {
            std::vector<std::uint8_t> bytes;
            encode(b.states[r], bytes);
            Result<RobotState> decoded = decode_state(bytes, b.type(r));
            ASSERT_TRUE(decoded.ok()) << decoded.error().text();
            b.states[r] = std::move(decoded).value();
        }
        ASSERT_EQ(a.hash(), b.hash()) << "tick " << i;
    }
}

/// A group large enough for a team: a heap, pairs of boxes, and cars.
World large_heap() {
    World world = boxes_and_cars();
    const std::size_t box = world.prototypes.size() - 2;
    for (int i = 0; i < 120; ++i) {
        const int column = i % 30, layer = i / 30;
        const double x = 0.21 * (column % 6) + 0.03 * layer, y = 0.21 * (column / 6) - 0.02 * layer;
        world.instances.push_back({"box_" + std::to_string(i), box, {{x, y, 0.15 + 0.25 * layer}, {}}, {}});
    }
    for (int i = 0; i < 12; ++i) {
        const double x = 0.23 * (i / 2) - 0.4;
        world.instances.push_back(
            {"pair_" + std::to_string(i), box, {{x, -0.5, 0.12 + 0.23 * (i % 2)}, {}}, {}});
    }
    for (int i = 0; i < 4; ++i)
        world.instances.push_back({"car_" + std::to_string(i), box + 1, {{0.9 * i - 1, -1.1, 0}, {}}, {}});
    return world;
}

TEST(Invariance, ATeamOfThreadsGivesTheSameBits) {
    const World world = large_heap();
    Simulation alone(world), shared(world);
    ThreadPool two(2), three(3);
    for (Simulation* sim : {&alone, &shared}) sim->scratch.measure_stages([] { return std::uint64_t{0}; });
    int contacts = 0, largest = 0;
    for (int i = 0; i < 300; ++i) {
        shared.scratch.use_team(i % 3 == 0 ? Team() : Team(i % 3 == 1 ? two : three));
        contacts += alone.step().contacts;
        largest = std::max(largest, shared.step().largest_group);
        ASSERT_EQ(alone.report.contacts, shared.report.contacts) << "tick " << i;
        ASSERT_EQ(alone.report.iterations, shared.report.iterations) << "tick " << i;
        ASSERT_EQ(alone.report.profile.solver, shared.report.profile.solver) << "tick " << i;
        ASSERT_EQ(alone.hash(), shared.hash()) << "tick " << i;
    }
    EXPECT_GT(largest, 100);
    EXPECT_GT(contacts, 30000);
}

TEST(Invariance, ATeamThatStepsSmallGroupsSideBySideGivesTheSameBits) {
    World world = boxes_and_cars();
    const std::size_t box = world.prototypes.size() - 2;
    for (int i = 0; i < 60; ++i) {  // pairs of boxes, single boxes, and cars
        const double x = 3.0 * (i % 10), y = 6.0 * (i / 10), lone = i % 3 == 0 ? 1.5 : 0;
        const std::string number = std::to_string(i);
        world.instances.push_back({"box_" + number, box, {{x, y, 0.15}, {}}, {}});
        world.instances.push_back({"upper_" + number, box, {{x + 0.03 + lone, y, 0.4}, {}}, {}});
        world.instances.push_back({"car_" + number, box + 1, {{x, y + 3, 0}, {}}, {}});
    }
    Simulation alone(world), shared(world);
    for (Simulation* sim : {&alone, &shared}) {
        for (std::size_t r = 2; r < sim->states.size(); r += 3)
            for (std::size_t d = 0; d < 4; ++d) sim->set_motor(r, d, MotorMode::kVelocity, 8);
        sim->scratch.measure_stages([] { return std::uint64_t{0}; });
    }
    ThreadPool two(2), three(3);
    for (int i = 0; i < 200; ++i) {
        shared.scratch.use_team(i % 3 == 0 ? Team() : Team(i % 3 == 1 ? two : three));
        alone.step();
        shared.step();
        ASSERT_EQ(alone.report.contacts, shared.report.contacts) << "tick " << i;
        ASSERT_EQ(alone.report.placed, shared.report.placed) << "tick " << i;
        ASSERT_EQ(alone.report.asleep, shared.report.asleep) << "tick " << i;
        ASSERT_EQ(alone.report.iterations, shared.report.iterations) << "tick " << i;
        ASSERT_EQ(alone.report.profile.solver, shared.report.profile.solver) << "tick " << i;
        ASSERT_EQ(alone.hash(), shared.hash()) << "tick " << i;
    }
    EXPECT_GT(alone.report.contacts, 300);
    shared.states[7].v[3] = shared.states[100].v[3] = std::numeric_limits<double>::infinity();
    shared.scratch.use_team(Team(three));
    shared.step();
    EXPECT_EQ(shared.report.not_finite, shared.ids[7]) << "of several the lowest";
}

TEST(Invariance, ATeamThatSolvesOnePartTogetherGivesTheSameBits) {
    Simulation alone(balls_side_by_side()), shared(balls_side_by_side());
    ThreadPool two(2), three(3);
    for (Simulation* sim : {&alone, &shared}) press_together(*sim);
    std::uint64_t largest = 0;
    for (int i = 0; i < 8; ++i) {
        shared.scratch.use_team(i % 4 == 3 ? Team() : Team(i % 4 == 1 ? three : two));
        alone.step();
        shared.step();
        largest = std::max(largest, alone.report.profile.solver.largest_part);
        ASSERT_EQ(alone.report.iterations, shared.report.iterations) << "tick " << i;
        ASSERT_EQ(alone.report.profile.solver, shared.report.profile.solver) << "tick " << i;
        ASSERT_EQ(alone.hash(), shared.hash()) << "tick " << i;
    }
    EXPECT_GE(largest, BodySolver::kWorthATeam);
}

TEST(Invariance, FlushToZeroAndRoundingOfTheCallerChangeNoBit) {
    const World world = random_crowd(13, 10);
    Simulation plain(world), flushed(world);
    stir(plain, 13);
    stir(flushed, 13);
    for (Simulation* sim : {&plain, &flushed}) {  // numbers that flush-to-zero would eat
        sim->states[0].v[0] = sim->states[0].v[1] = 3e-310;
        sim->states[0].q[0] = 1e-309;
    }
    constexpr std::uint64_t kOthers = kFlushTinyNumbers | kRoundTowardsZero;
    const std::uint64_t before = float_control();
    for (int i = 0; i < 200; ++i) {
        plain.step();
        set_float_control(before | kOthers);
        const Aabb bound = interaction_bound(*flushed.model, flushed.ids[0], flushed.states[0]);
        flushed.step();
        const std::uint64_t after = float_control();
        set_float_control(before);
        ASSERT_EQ(after & kOthers, kOthers) << "the caller's flags come back";
        ASSERT_EQ(bound.min, flushed.bounds[0].min);
        ASSERT_EQ(bound.max, flushed.bounds[0].max);
        ASSERT_EQ(plain.hash(), flushed.hash()) << "tick " << i;
    }
}

}  // namespace
}  // namespace roboss::test
