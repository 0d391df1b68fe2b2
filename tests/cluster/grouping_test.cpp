// The one idea: the same bits for any number of Simulators and threads, any windows, any grouping into
// islands.
#include <gtest/gtest.h>

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
    for (const World& world : {World{heaps_world(), false}, World{carts_world(), true}}) {
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

}  // namespace
}  // namespace roboss::test
