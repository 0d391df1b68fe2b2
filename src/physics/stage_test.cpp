// The profile of steps: all time of a call is attributed to stages, the solver tells what it did; nothing
// where nobody measures, and no bit depends on it.
#include "physics/stage.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>

#include <support/scenes.h>

namespace roboss::test {
namespace {

std::uint64_t readings = 0;

std::uint64_t count_readings() {
    return ++readings;
}

TEST(Stages, AllTimeOfACallIsAttributedAndNoBitDependsOnIt) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
        World world = random_crowd(3, 20);
        world.precision = precision;
        Simulation plain(world), measured(world);
        stir(plain, 3), stir(measured, 3);
        measured.scratch.measure_stages(count_readings);
        StageTimes times;
        for (int i = 0; i < 50; ++i) {
            plain.step();
            EXPECT_EQ(plain.report.profile.stages.sum(), 0u);
            const std::uint64_t before = readings;
            measured.step();
            EXPECT_EQ(measured.report.profile.stages.sum(), readings - before - 1)
                << "from the first reading to the last";
            times += measured.report.profile.stages;
        }
        EXPECT_EQ(plain.states, measured.states);
        for (const Stage stage : {Stage::kOrders, Stage::kBroadPhase, Stage::kKinematics, Stage::kNarrowPhase,
                                  Stage::kRows, Stage::kVelocities, Stage::kIntegration, Stage::kReport})
            EXPECT_GT(times.of(stage), 0u) << stage_name(stage);
    }
}

TEST(Stages, LoneRobotsInLanesGoThroughTheSameStages) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    for (int i = 0; i < 32; ++i) place(world, car(), "car_" + std::to_string(i), {{5.0 * i, 0, 1e-3}, {}});
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
        world.precision = precision;
        Simulation sim(world);
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kVelocity, 10);
        sim.scratch.measure_stages(count_readings);
        sim.run(0.2);
        for (const Stage stage : {Stage::kKinematics, Stage::kNarrowPhase, Stage::kRows, Stage::kVelocities,
                                  Stage::kDisplacements, Stage::kIntegration, Stage::kReport})
            EXPECT_GT(sim.report.profile.stages.of(stage), 0u) << stage_name(stage);
    }
}

/// The sum over the steps.
SolverProfile solver_profile_of(Simulation& sim, int ticks) {
    sim.scratch.measure_stages(count_readings);
    SolverProfile sum;
    for (int i = 0; i < ticks; ++i) sum += sim.step().profile.solver;
    return sum;
}

World stack_of_ten() {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box_0", {{0, 0, 0.1}, {}});
    for (int i = 1; i < 10; ++i)
        world.instances.push_back({"box_" + std::to_string(i), 1, {{0, 0, 0.1 + 0.2 * i}, {}}, {}});
    return world;
}

TEST(SolverProfile, TellsOfTheLargestIslandAndItsSolution) {
    Simulation sim(stack_of_ten());
    const SolverProfile profile = solver_profile_of(sim, 100);
    EXPECT_EQ(profile.islands, 100u);
    EXPECT_EQ(profile.friction_solves, 100u);
    EXPECT_EQ(profile.largest_island, 10u);
    EXPECT_EQ(profile.largest_part, 10u);
    EXPECT_GE(profile.iterations, profile.iterations_most);
    EXPECT_GT(profile.iterations_most, 0u);
    EXPECT_EQ(profile.residual, sim.residual_max);
    EXPECT_LE(profile.friction_error, sim.model->accuracy.friction_tolerance);
    EXPECT_EQ(profile.friction_misses, 0u);
}

std::uint64_t sum_of(const SolveCounts& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}
std::uint64_t count_of(const SolveCounts& counts, SolveMethod method) {
    return counts[static_cast<std::size_t>(method)];
}

TEST(SolverProfile, CountsByWhichMethodPartsWereSolved) {
    Simulation stack(stack_of_ten());
    const SolverProfile standard = solver_profile_of(stack, 100);
    EXPECT_GE(sum_of(standard.velocities), 100u);
    EXPECT_EQ(count_of(standard.velocities, SolveMethod::kBodiesNewton) +
                  count_of(standard.velocities, SolveMethod::kBodiesSweeps),
              sum_of(standard.velocities));
    World world = stack_of_ten();
    world.accuracy.emplace_back().setting = "fast";
    Simulation soft(world);
    EXPECT_EQ(count_of(solver_profile_of(soft, 100).velocities, SolveMethod::kSoft), 100u);
    World one = empty_world(2e-3);
    place(one, ground(surface(0.9)), "ground");
    place(one, car(), "car", {{0, 0, 1e-3}, {}});
    Simulation lone(one);
    EXPECT_EQ(count_of(solver_profile_of(lone, 100).velocities, SolveMethod::kNewton), 100u);
}

TEST(SolverProfile, PartsOfAnIslandAreSolvedByThemselves) {
    World world = stack_of_ten();
    world.instances[5].X_WM.p.z += 0.0015;  // near enough to be in the island, too far to push
    for (std::size_t i = 6; i < world.instances.size(); ++i) world.instances[i].X_WM.p.z += 0.0015;
    Simulation sim(world);
    const SolverProfile profile = solver_profile_of(sim, 1);
    EXPECT_EQ(profile.largest_island, 10u);
    EXPECT_LT(profile.largest_part, 10u);
}

TEST(SolverProfile, CountsFrictionThatMissesItsTolerance) {
    World world = random_crowd(10, 30);
    world.accuracy.push_back({"", {{"friction_tolerance", 1e-10}, {"friction_max", 2}}, {}});
    Simulation sim(world);
    stir(sim, 10);
    const SolverProfile profile = solver_profile_of(sim, 150);
    EXPECT_GT(profile.friction_misses, 0u);
    EXPECT_LT(profile.friction_misses, profile.friction_solves);
    EXPECT_GT(profile.friction_error, 1e-10);
}

TEST(SolverProfile, IsEmptyWhereNobodyAsks) {
    Simulation sim(stack_of_ten());
    for (int i = 0; i < 10; ++i) EXPECT_EQ(sim.step().profile.solver, SolverProfile{});
}

TEST(SolverProfile, IsTheSameInLanes) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.9)), "ground");
    for (int i = 0; i < 32; ++i) place(world, car(), "car_" + std::to_string(i), {{5.0 * i, 0, 1e-3}, {}});
    const auto profile_in = [&](std::size_t lanes) {
        Simulation sim(world);
        sim.scratch.use_lanes(lanes);
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kVelocity, 10);
        return solver_profile_of(sim, 100);
    };
    const SolverProfile alone = profile_in(1);
    EXPECT_EQ(alone.islands, 3200u);
    EXPECT_GT(alone.friction_solves, 3000u);
    EXPECT_EQ(alone, profile_in(kMostLanes));
}

TEST(Stages, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < kStages; ++i) names.insert(stage_name(Stage(i)));
    EXPECT_EQ(names.size(), kStages);
    EXPECT_EQ(names.count(""), 0u);
}

}  // namespace
}  // namespace roboss::test
