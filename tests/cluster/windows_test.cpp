// Windows: forecasts may be wrong, robots may jump, states may burst; the truth does not change.
#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model,
                                 const SimulationOptions& options) {
    auto made = Simulation::create(model, options);
    EXPECT_TRUE(made.ok()) << made.error().text();
    return std::move(made).value();
}

SimulationOptions merged() {
    SimulationOptions options;
    options.controller.window = 1;
    options.controller.forecast.merge_all = true;
    return options;
}

TEST(Windows, AWrongForecastRepeatsOnlyTheTouchingIslandsAndKeepsTheHash) {
    const auto model = pair_world();
    auto reference = make(model, merged());
    ASSERT_TRUE(reference->run_until(80).ok());
    for (const std::size_t simulators : {1u, 3u}) {
        SimulationOptions options;
        options.simulators = simulators;
        options.controller.window = 8;
        options.controller.forecast.blind = true;  // every robot on its own
        auto simulation = make(model, options);
        ASSERT_TRUE(simulation->run_until(80).ok());
        EXPECT_EQ(simulation->hash(), reference->hash());
        EXPECT_EQ(simulation->counters().windows, 10u);
        EXPECT_EQ(simulation->counters().windows_repeated, 10u);
        EXPECT_EQ(simulation->counters().robots_repeated, 20u)
            << "only the two crates of the pair, once a window";
        EXPECT_EQ(simulation->counters().islands, 30u);
    }
}

TEST(Windows, AForecastWithoutMarginsKeepsTheHashInACrowd) {
    const auto model = piles_world(3);
    auto reference = make(model, merged());
    ASSERT_TRUE(reference->run_until(300).ok());
    for (const Tick window : {5, 16, 50}) {
        SimulationOptions options;
        options.simulators = 3;
        options.controller.window = window;
        options.controller.forecast.reach_scale = 0;
        auto simulation = make(model, options);
        ASSERT_TRUE(simulation->run_until(300).ok());
        EXPECT_EQ(simulation->hash(), reference->hash()) << "window " << window;
    }
    SimulationOptions blind;
    blind.controller.window = 16;
    blind.controller.forecast.blind = true;
    auto simulation = make(model, blind);
    ASSERT_TRUE(simulation->run_until(300).ok());
    EXPECT_EQ(simulation->hash(), reference->hash());
    EXPECT_GT(simulation->counters().windows_repeated, 10u);
}

Order teleport(Tick at, RobotId robot, const Vec3& p, std::uint64_t sequence) {
    return {at, ClientId(), sequence, robot, SetPose{{p, {}}}};
}

TEST(Windows, ATeleportIntoAnotherIslandInMidWindowKeepsTheHash) {
    const auto model = pair_world();
    const std::vector<Order> orders{
        teleport(21, RobotId(3u), {0.1, 0, 1.3}, 1),    // the lone ball above the pair
        teleport(22, RobotId(3u), {8, 0.05, 0.75}, 2),  // and on to the lone crate, two jumps in one window
        teleport(45, RobotId(0u), {8.1, 0, 1.2}, 3),    // the support of the upper crate goes
    };
    const auto run = [&](SimulationOptions options) {
        auto simulation = make(model, options);
        for (const Order& order : orders) EXPECT_TRUE(simulation->submit(order).ok());
        EXPECT_TRUE(simulation->run_until(100).ok());
        return simulation->hash();
    };
    const std::uint64_t expected = run(merged());
    for (const bool blind : {false, true})
        for (const std::size_t simulators : {1u, 2u, 4u}) {
            SimulationOptions options;
            options.simulators = simulators;
            options.controller.window = 16;
            options.controller.forecast.blind = blind;
            EXPECT_EQ(run(options), expected) << simulators << " simulators, blind " << blind;
        }
    auto undisturbed = make(model, merged());
    ASSERT_TRUE(undisturbed->run_until(100).ok());
    EXPECT_NE(undisturbed->hash(), expected) << "the orders had no effect";
}

TEST(Windows, OrdersMayBeGivenInAnySequence) {
    const auto model = pair_world();
    std::vector<Order> orders;
    for (std::uint64_t i = 0; i < 12; ++i)
        orders.push_back({static_cast<Tick>(10 + 3 * (i / 4)), ClientId(), i,
                          RobotId(static_cast<std::uint32_t>(i % 4)),
                          SetVelocity{{0.2 * static_cast<double>(i), 0.5, 1}, {0, 0, 1}}});
    auto forward = make(model, {}), backward = make(model, {});
    for (std::size_t i = 0; i < orders.size(); ++i) {
        EXPECT_TRUE(forward->submit(orders[i]).ok());
        EXPECT_TRUE(backward->submit(orders[orders.size() - 1 - i]).ok());
    }
    ASSERT_TRUE(forward->run_until(60).ok());
    ASSERT_TRUE(backward->run_until(60).ok());
    EXPECT_EQ(forward->hash(), backward->hash());
}

TEST(Windows, OneChangedBitOfAnOrderChangesTheHash) {
    const auto model = pair_world();
    const auto run = [&](double speed) {
        auto simulation = make(model, {});
        EXPECT_TRUE(simulation->submit({5, ClientId(), 1, RobotId(3u), SetVelocity{{speed, 0, 0}, {}}}).ok());
        EXPECT_TRUE(simulation->run_until(10).ok());
        return simulation->hash();
    };
    EXPECT_EQ(run(0.5), run(0.5));
    EXPECT_NE(run(0.5), run(std::nextafter(0.5, 1.0)));
}

TEST(Windows, BadAndLateOrdersAreRefusedInWordsAndDisturbNothing) {
    const auto model = pair_world();
    auto simulation = make(model, {}), reference = make(model, {});
    ASSERT_TRUE(simulation->run_until(20).ok());
    const Result<> unknown = simulation->submit(teleport(30, RobotId(99u), {}, 1));
    const Result<> late = simulation->submit(teleport(10, RobotId(0u), {}, 2));
    const Result<> infinite = simulation->submit(teleport(30, RobotId(0u), {1.0 / 0.0, 0, 0}, 3));
    ASSERT_FALSE(unknown.ok());
    ASSERT_FALSE(late.ok());
    ASSERT_FALSE(infinite.ok());
    EXPECT_EQ(late.error().code, "too-late");
    ASSERT_TRUE(simulation->run_until(50).ok());
    ASSERT_TRUE(reference->run_until(50).ok());
    EXPECT_EQ(simulation->hash(), reference->hash());
}

TEST(Windows, AnEmptyWorldRunsToo) {
    auto model = std::make_shared<Model>();
    auto simulation = make(model, {});
    ASSERT_TRUE(simulation->run_until(50).ok());
    EXPECT_EQ(simulation->tick(), 50);
    EXPECT_TRUE(simulation->states().empty());
}

TEST(Windows, StatesHaveTheCommittedHash) {
    const auto model = piles_world(2);
    SimulationOptions options;
    options.simulators = 2;
    auto simulation = make(model, options);
    for (const Tick tick : {0, 7, 30}) {
        ASSERT_TRUE(simulation->run_until(tick).ok());
        std::vector<std::uint64_t> hashes;
        for (std::size_t i = 0; i < simulation->states().size(); ++i)
            hashes.push_back(state_hash(RobotId(i), tick, simulation->states()[i]));
        EXPECT_EQ(world_hash(model->hash, hashes), simulation->hash());
    }
}

}  // namespace
}  // namespace roboss::test
