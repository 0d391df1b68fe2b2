// The times of stages: all of a call is attributed, none where nobody measures, and no bit depends on it.
#include "physics/stage.h"

#include <gtest/gtest.h>

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
            EXPECT_EQ(plain.report.stages.sum(), 0u);
            const std::uint64_t before = readings;
            measured.step();
            EXPECT_EQ(measured.report.stages.sum(), readings - before - 1)
                << "from the first reading to the last";
            times += measured.report.stages;
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
            EXPECT_GT(sim.report.stages.of(stage), 0u) << stage_name(stage);
    }
}

TEST(Stages, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < kStages; ++i) names.insert(stage_name(Stage(i)));
    EXPECT_EQ(names.size(), kStages);
    EXPECT_EQ(names.count(""), 0u);
}

}  // namespace
}  // namespace roboss::test
