// The one idea: the same bits for any number of Simulators and threads, any windows, any grouping into
// islands.
#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

std::vector<NamedProgram> driver(const ControlOptions& options) {
    std::vector<NamedProgram> programs;
    programs.push_back({"driver", std::make_unique<DrivingProgram>(options)});
    return programs;
}

struct Outcome {
    std::uint64_t hash = 0;
    Counters counters;
};

Outcome run(const std::shared_ptr<const Model>& model, const SimulationOptions& options, Tick ticks,
            bool driven) {
    auto made = Simulation::create(model, options, driven ? driver({}) : std::vector<NamedProgram>{});
    EXPECT_TRUE(made.ok()) << made.error().text();
    Simulation& simulation = *made.value();
    const Result<> ran = simulation.run_until(ticks);
    EXPECT_TRUE(ran.ok()) << (ran.ok() ? "" : ran.error().text());
    EXPECT_EQ(simulation.tick(), ticks);
    return {simulation.hash(), simulation.counters()};
}

TEST(Grouping, GivesTheSameHashForAnySimulatorsThreadsWindowsAndIslands) {
    struct World {
        std::shared_ptr<const Model> model;
        bool driven;
    };
    for (const World& world : {World{piles_world(), false}, World{carts_world(), true}}) {
        ASSERT_NE(world.model, nullptr);
        SimulationOptions reference;
        reference.controller.forecast.merge_all = true;
        reference.controller.window = 1;
        const Outcome expected = run(world.model, reference, 400, world.driven);
        for (const std::size_t simulators : {1u, 2u, 5u})
            for (const Tick window : {Tick{1}, Tick{16}, Tick{0}})
                for (const unsigned threads : {1u, 2u})
                    for (const bool merge : {false, true}) {
                        SimulationOptions options;
                        options.simulators = simulators;
                        options.threads = threads;
                        options.controller.window = window;
                        options.controller.forecast.merge_all = merge;
                        EXPECT_EQ(run(world.model, options, 400, world.driven).hash, expected.hash)
                            << world.model->name << ", simulators " << simulators << ", window " << window
                            << ", threads " << threads << ", merge " << merge;
                    }
    }
}

std::size_t count_asleep(const std::vector<RobotState>& states) {
    return static_cast<std::size_t>(
        std::count_if(states.begin(), states.end(), [](const RobotState& s) { return s.rest.asleep; }));
}

struct Night {
    std::size_t asleep_early = 0, asleep_between = 0, asleep_late = 0;
    std::uint64_t hash = 0;
};

/// Sleepers, disturbed in four ways; counts who sleeps before, between and after.
Night disturbed_night(const std::shared_ptr<const Model>& model, const SimulationOptions& options) {
    std::vector<NamedProgram> programs;
    programs.push_back({"disturber", std::make_unique<DisturbingProgram>()});
    auto made = Simulation::create(model, options, std::move(programs));
    EXPECT_TRUE(made.ok());
    Simulation& simulation = *made.value();
    Night night;
    EXPECT_TRUE(simulation.run_until(390).ok());
    night.asleep_early = count_asleep(simulation.states());
    EXPECT_TRUE(simulation.run_until(430).ok());
    night.asleep_between = count_asleep(simulation.states());
    EXPECT_TRUE(simulation.run_until(2400).ok());
    night.asleep_late = count_asleep(simulation.states());
    night.hash = simulation.hash();
    return night;
}

TEST(Grouping, SleepersWakeTheSameHoweverTheyAreGrouped) {
    const std::shared_ptr<const Model> model = sleepers_world();
    SimulationOptions reference;
    reference.controller.forecast.merge_all = true;
    reference.controller.window = 1;
    const Night expected = disturbed_night(model, reference);
    EXPECT_GE(expected.asleep_early, 12u) << "all stacks sleep";
    EXPECT_LE(expected.asleep_between, expected.asleep_early - 3) << "a stack without its lowest crate wakes";
    EXPECT_GE(expected.asleep_late, 9u) << "and most sleep again";
    for (const std::size_t simulators : {1u, 3u})
        for (const Tick window : {Tick{1}, Tick{7}, Tick{0}})
            for (const bool blind : {false, true}) {
                SimulationOptions options;
                options.simulators = simulators;
                options.threads = 2;
                options.controller.window = window;
                options.controller.forecast.blind = blind;
                EXPECT_EQ(disturbed_night(model, options).hash, expected.hash)
                    << "simulators " << simulators << ", window " << window << ", blind " << blind;
            }
}

}  // namespace
}  // namespace roboss::test
