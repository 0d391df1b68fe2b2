// Where a state ceases to be finite the run ends, with the same tick, state and words whatever windows,
// threads, Simulators and groups there were.
#include <gtest/gtest.h>
#include <support/robots.h>

#include "core/hash.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr Tick kFails = 57, kFailsLater = 61, kEnd = 120;
const RobotId kFirst(2u), kSecond(4u), kLater(1u);

/// Lone balls, three of them so light that a force within the limits of orders makes them infinitely fast,
/// and between them a pile of crates that keeps the windows busy.
std::shared_ptr<const Model> fragile_world() {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.5)), "ground");
    const double masses[] = {1, 1e-300, 1e-300, 1, 1e-300};
    for (int i = 0; i < 5; ++i)
        place(world, solid_sphere(masses[i], 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{4.0 * i, 0, 50}, {}});
    for (int i = 0; i < 6; ++i)
        place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.5)), "box_" + std::to_string(i),
              {{0.15 * (i % 3), 3, 0.12 + 0.25 * i}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

Order push(Tick tick, RobotId robot) {
    return {tick, ClientId(), robot.value, robot, ApplyWrench{LinkId(0u), {0, 0, kOrderLimits.force}, {}, 1}};
}

struct Ending {
    Tick tick = 0;
    std::string hash, code, message;
    friend bool operator==(const Ending&, const Ending&) = default;
};

Ending end_of(const std::shared_ptr<const Model>& model, const SimulationOptions& options,
              const std::vector<Order>& orders) {
    auto simulation = Simulation::create(model, options, {}).value();
    for (const Order& order : orders) EXPECT_TRUE(simulation->submit(order).ok());
    const Result<> ran = simulation->run_until(kEnd);
    EXPECT_FALSE(ran.ok());
    std::vector<std::uint64_t> hashes;
    for (std::size_t i = 0; i < model->robots.size(); ++i)
        hashes.push_back(state_hash(RobotId(i), simulation->tick(), simulation->states()[i]));
    EXPECT_EQ(world_hash(model->hash, hashes), simulation->hash()) << "the states can be fetched";
    return {simulation->tick(), to_hex(simulation->hash()), ran.ok() ? "" : ran.error().code,
            ran.ok() ? "" : ran.error().message};
}

std::vector<SimulationOptions> configurations() {
    std::vector<SimulationOptions> all;
    for (const Tick window : {0, 1, 2, 7, 16, 57, 58, 100})
        for (const std::size_t simulators : {1u, 2u, 5u})
            for (const std::size_t lanes : {std::size_t{1}, kMostLanes}) {
                SimulationOptions options;
                options.controller.window = window;
                options.simulators = simulators;
                options.threads = simulators == 2 ? 3 : 1;
                options.lanes = lanes;
                options.controller.forecast.merge_all = window == 7;
                options.controller.forecast.blind = window == 16;
                all.push_back(options);
            }
    return all;
}

TEST(EndOfRun, IsTheSameForEveryWindowThreadsSimulatorsAndGroups) {
    const auto model = fragile_world();
    const std::vector<Order> orders{push(kFails, kSecond), push(kFails, kFirst), push(kFailsLater, kLater)};
    SimulationOptions options;
    auto reference = Simulation::create(model, options, {}).value();
    ASSERT_TRUE(reference->run_until(kFails).ok());
    const std::string hash = to_hex(reference->hash());
    for (const SimulationOptions& o : configurations()) {
        const Ending ending = end_of(model, o, orders);
        EXPECT_EQ(ending.tick, kFails) << "window " << o.controller.window << ", Simulators " << o.simulators;
        EXPECT_EQ(ending.hash, hash) << "all before the tick is committed";
        EXPECT_EQ(ending.code, "not-finite");
        EXPECT_NE(ending.message.find("'ball_2'"), std::string::npos) << ending.message;
        EXPECT_NE(ending.message.find(std::to_string(kFails)), std::string::npos) << ending.message;
        EXPECT_EQ(ending.message.find("ball_1"), std::string::npos) << "that comes later";
    }
}

/// Who is beyond numbers before its tick is told first, for it keeps those beside it from being stepped.
TEST(EndOfRun, IsTheSameWhereOneIsInfiniteAndAnotherBeyondNumbersInTheSameTick) {
    const auto model = fragile_world();
    SavedRun from;
    from.seed = 1;
    for (std::size_t i = 0; i < model->robots.size(); ++i)
        from.states.push_back(initial_state(*model, RobotId(i)));
    from.states[3].v[5] = 1e308;
    std::vector<Ending> endings;
    for (const SimulationOptions& o : configurations()) {
        auto simulation = Simulation::create(model, o, {}, &from).value();
        ASSERT_TRUE(simulation->submit(push(0, kFirst)).ok());
        const Result<> ran = simulation->run_until(kEnd);
        ASSERT_FALSE(ran.ok());
        endings.push_back(
            {simulation->tick(), to_hex(simulation->hash()), ran.error().code, ran.error().message});
        EXPECT_EQ(endings.back(), endings.front()) << endings.back().message << "\n"
                                                   << endings.front().message;
    }
    EXPECT_EQ(endings[0].tick, 0);
    EXPECT_EQ(endings[0].code, "too-fast");
    EXPECT_NE(endings[0].message.find("'ball_3'"), std::string::npos) << endings[0].message;
}

}  // namespace
}  // namespace roboss::test
