// Whatever the Bus does to messages and whoever dies: the run ends with the hash of the undisturbed one.
#include <gtest/gtest.h>

#include "bus/in_process_bus.h"
#include "bus/model_pull.h"
#include "faulty_cluster.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr Tick kTicks = 240;

ControlOptions quick() {
    ControlOptions options;
    options.period_s = 0.016;
    return options;
}

ControlOptions slow_to_act() {
    ControlOptions options;
    options.period_s = 0.024;
    options.latency_s = 0.05;
    return options;
}

ControlOptions at_once() {
    ControlOptions options;
    options.period_s = 0.04;
    options.latency_s = 0;
    return options;
}

std::uint64_t undisturbed_hash(const std::shared_ptr<const Model>& model) {
    std::vector<NamedProgram> programs;
    programs.push_back({"quick", std::make_unique<DrivingProgram>(quick())});
    programs.push_back({"slow", std::make_unique<DrivingProgram>(slow_to_act())});
    programs.push_back({"at_once", std::make_unique<DrivingProgram>(at_once())});
    auto simulation = Simulation::create(model, {}, std::move(programs));
    EXPECT_TRUE(simulation.value()->run_until(kTicks).ok());
    return simulation.value()->hash();
}

void add_programs(FaultyCluster& cluster) {
    cluster.add_program("quick", quick());
    cluster.add_program("slow", slow_to_act());
    cluster.add_program("at_once", at_once());
}

ControllerOptions checkpointing(std::uint64_t seed) {
    ControllerOptions options;
    options.checkpoint_ticks = 10 + static_cast<Tick>(seed % 5) * 12;
    options.window = seed % 3 == 0 ? 0 : static_cast<Tick>(seed % 7 + 1);
    return options;
}

TEST(Faults, AHundredSeedsOfABadBusWithKillsEndWithTheUndisturbedHash) {
    const auto model = carts_world(4);
    const std::uint64_t expected = undisturbed_hash(model);
    std::uint64_t losses = 0, recoveries = 0, checkpoints = 0, cuts = 0, silences = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FaultOptions faults;
        faults.seed = seed;
        faults.drop = 0.02 * static_cast<double>(seed % 6);
        faults.duplicate = 0.02 * static_cast<double>(seed % 5);
        faults.delay_ms_max = static_cast<std::int64_t>(seed % 10);
        FaultyCluster cluster(model, checkpointing(seed), faults, {150, 60, 50, 250, 2000}, 1 + seed % 4);
        add_programs(cluster);
        ASSERT_TRUE(cluster.run_until(kTicks)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), expected);
        losses += cluster.controller().counters().losses;
        recoveries += cluster.controller().counters().recoveries;
        checkpoints += cluster.controller().counters().checkpoints;
        cuts += cluster.controller().counters().cuts;
        silences += cluster.controller().counters().silences;
    }
    EXPECT_GT(losses, 100u);  // else this test did not test
    EXPECT_EQ(silences, losses) << "nobody spreads rumours";
    EXPECT_GT(cuts, 100u);
    EXPECT_GT(recoveries, 50u);
    EXPECT_GT(checkpoints, 300u);
    RecordProperty("losses", std::to_string(losses));
    RecordProperty("recoveries", std::to_string(recoveries));
}

TEST(Faults, WhoIsDoneTakesOverFromWhoIsLateAndTheHashStays) {
    const auto model = carts_world(12);
    ControllerOptions controller;
    controller.checkpoint_ticks = 40;
    std::uint64_t expected = 0, cuts = 0, repeated = 0;
    for (std::uint64_t seed = 0; seed <= 24; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const double bad = seed % 2 == 0 ? 0.03 : 0.0;
        controller.forecast.reach_scale = seed % 3 == 1 ? 0 : 1;
        FaultyCluster cluster(model, controller, {seed, bad, bad, static_cast<std::int64_t>(seed % 3)},
                              {seed % 4 == 3 ? 80u : 0u, 0, 0, 150, 2000}, seed == 0 ? 1 : 2 + seed % 3);
        ControlOptions options;
        options.period_s = 0.08;
        cluster.add_program("driver", options);
        ASSERT_TRUE(cluster.run_until(kTicks)) << "stuck at tick " << cluster.controller().tick();
        if (seed == 0) expected = cluster.controller().hash();
        EXPECT_EQ(cluster.controller().hash(), expected);
        cuts += cluster.controller().counters().cuts;
        repeated += cluster.controller().counters().windows_repeated;
    }
    EXPECT_GT(cuts, 100u);
    EXPECT_GT(repeated, 20u);
}

TEST(Faults, WhoIsSaidToHaveVanishedIsReplacedAtOnceAndComesBackIfItWasNotTrue) {
    const auto model = carts_world(4);
    const std::uint64_t expected = undisturbed_hash(model);
    std::uint64_t losses = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FaultyCluster cluster(model, checkpointing(seed), {seed, 0.02, 0.02, 4}, {100, 0, 0, 150, 2000, 400},
                              3);
        add_programs(cluster);
        ASSERT_TRUE(cluster.run_until(kTicks)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), expected);
        losses += cluster.controller().counters().losses;
        EXPECT_EQ(cluster.controller().counters().silences, 0u) << "noticed before it was silent for long";
    }
    EXPECT_GT(losses, 20u);
}

TEST(Faults, AControllerThatWasStartedAgainTakesTheSimulatorsOfTheOldOneIn) {
    const auto model = carts_world(3);
    FaultyBus bus({1, 0, 0, 0});
    ThreadPool pool(1);
    Simulator a(model, {Role::kSimulator, 1}, {}, pool), b(model, {Role::kSimulator, 2}, {}, pool);
    const auto run = [&](Controller& controller, Tick target) {
        controller.run_until(target);
        for (int i = 0; i < 2'000 && !controller.resting(); ++i) {
            bus.advance_clock(1);
            controller.advance(bus);
            a.advance(bus);
            b.advance(bus);
        }
    };
    ControllerOptions options;
    options.simulators = 2;
    std::uint64_t expected = 0;
    {
        Controller first(model, options, beginning_of(*model));
        run(first, 40);
        expected = first.hash();
    }
    Controller second(model, options, beginning_of(*model));
    run(second, 40);
    EXPECT_EQ(second.tick(), 40);
    EXPECT_EQ(second.hash(), expected);
}

TEST(Faults, WhoHasNoModelGetsItFromTheControllerThroughABadBus) {
    const auto model = carts_world(4);
    FaultyBus bus({3, 0.2, 0.2, 9});
    Controller controller(model, {}, beginning_of(*model));
    const Address self{Role::kSimulator, 1};
    ModelPull pull;
    for (int i = 0; i < 5'000 && !pull.model(); ++i) {
        bus.advance_clock(1);
        controller.advance(bus);
        pull.advance(bus, self, 20);
    }
    ASSERT_TRUE(pull.model());
    ASSERT_TRUE(pull.model()->ok());
    EXPECT_EQ(pull.model()->value()->hash, model->hash);
}

TEST(Faults, EverybodyHearsThatTheRunIsOver) {
    const auto model = carts_world(2);
    InProcessBus bus;
    ThreadPool pool(1);
    Controller controller(model, {}, beginning_of(*model));
    Simulator simulator(model, {Role::kSimulator, 1}, {}, pool);
    BusClient client(model, {Role::kClient, 2}, {});
    for (int i = 0; i < 5; ++i) {
        controller.advance(bus);
        simulator.advance(bus);
        client.advance(bus);
    }
    controller.dismiss(bus, {"done"});
    simulator.advance(bus);
    client.advance(bus);
    EXPECT_TRUE(simulator.gone());
    EXPECT_EQ(simulator.over(), "done");
    EXPECT_EQ(client.over(), "done");
}

TEST(Faults, AllSimulatorsLostAndANewOneJoinedEndsWithTheSameHash) {
    const auto model = carts_world(4);
    const std::uint64_t expected = undisturbed_hash(model);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        FaultyCluster cluster(model, checkpointing(seed), {seed, 0.05, 0.05, 5}, {}, 3);
        add_programs(cluster);
        ASSERT_TRUE(cluster.run_until(kTicks / 2)) << "seed " << seed;
        cluster.controller().run_until(kTicks);
        for (int i = 0; i < 20; ++i) cluster.turn();
        cluster.kill_all();
        for (int i = 0; i < 400; ++i) cluster.turn();  // longer than loss_ms: nobody is left
        EXPECT_EQ(cluster.controller().counters().simulators, 0u);
        cluster.add_simulator();
        ASSERT_TRUE(cluster.run_until(kTicks)) << "seed " << seed;
        EXPECT_EQ(cluster.controller().hash(), expected) << "seed " << seed;
        EXPECT_EQ(cluster.controller().counters().losses, 3u) << "seed " << seed;
    }
}

TEST(Faults, JoiningLateAndLeavingInGoodOrderLosesNothing) {
    const auto model = carts_world(4);
    const std::uint64_t expected = undisturbed_hash(model);
    FaultyCluster cluster(model, {}, {7, 0.05, 0.05, 5}, {},
                          1);  // no checkpoints but those that leaving needs
    add_programs(cluster);
    ASSERT_TRUE(cluster.run_until(60));
    cluster.add_simulator();
    ASSERT_TRUE(cluster.run_until(120));
    EXPECT_EQ(cluster.controller().counters().simulators, 2u);
    EXPECT_GT(cluster.controller().counters().migrations, 0u);
    cluster.simulator(0).leave();
    ASSERT_TRUE(cluster.run_until(180));
    EXPECT_EQ(cluster.simulators(), 1u);
    cluster.simulator(0).leave();  // the last one: the world waits at the Controller
    for (int i = 0; i < 500; ++i) cluster.turn();
    EXPECT_EQ(cluster.simulators(), 0u);
    cluster.add_simulator();
    ASSERT_TRUE(cluster.run_until(kTicks));
    EXPECT_EQ(cluster.controller().hash(), expected);
    EXPECT_EQ(cluster.controller().counters().losses, 0u);
    EXPECT_EQ(cluster.controller().counters().recoveries, 0u);
}

/// Who leaves finishes its window; if islands touched in it, nobody is left to step them together.
TEST(Faults, AllSimulatorsMayLeaveInAWindowThatHasToBeRepeated) {
    const auto model = carts_world(4);
    const std::uint64_t expected = undisturbed_hash(model);
    ControllerOptions options;
    options.forecast.blind = true;
    std::uint64_t repeated = 0, left = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FaultyCluster cluster(model, options, {seed, 0, 0, 2}, {0, 0, 4000, 0, 20'000}, 1);
        add_programs(cluster);
        ASSERT_TRUE(cluster.run_until(kTicks)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), expected);
        EXPECT_EQ(cluster.controller().counters().losses, 0u);
        repeated += cluster.controller().counters().windows_repeated;
        for (const MemberReport& member : cluster.controller().members())
            left += member.leaving && !member.alive ? 1 : 0;
    }
    EXPECT_GT(repeated, 30u);
    EXPECT_GT(left, 100u);
}

TEST(Faults, AClientThatFallsSilentIsGivenUp) {
    const auto model = carts_world(2);
    for (const bool synchronous : {true, false}) {
        ControlOptions options = quick();
        options.synchronous = synchronous;
        ControllerOptions controller;
        controller.client_loss_ms = 500;
        controller.checkpoint_ticks = 20;
        FaultyCluster cluster(model, controller, {11, 0.02, 0.02, 3}, {}, 2);
        cluster.add_program("mute", options);
        ASSERT_TRUE(cluster.run_until(50));
        cluster.bus().cut_off({Role::kClient, 3});
        EXPECT_EQ(cluster.run_until(kTicks), !synchronous) << "the world waits for a synchronous Client only";
        EXPECT_EQ(cluster.controller().failure().has_value(), synchronous);
        if (synchronous) {
            EXPECT_EQ(cluster.controller().failure()->code, "client-lost");
            EXPECT_NE(cluster.controller().failure()->message.find("'mute'"), std::string::npos);
        } else {
            for (int i = 0; i < 600; ++i) cluster.turn();
            const std::uint64_t before = cluster.controller().counters().checkpoints;
            ASSERT_TRUE(cluster.run_until(8 * kTicks));
            EXPECT_GT(cluster.controller().counters().checkpoints, before + 2)
                << "what it never fetched holds checkpoints up";
        }
    }
}

TEST(Faults, ASimulatorOfAnotherWorldIsRefusedInWords) {
    const auto model = carts_world(2), other = carts_world(3);
    InProcessBus bus;
    ThreadPool pool(1);
    Controller controller(model, {}, beginning_of(*model));
    Simulator stranger(other, {Role::kSimulator, 1}, {}, pool),
        friendly(model, {Role::kSimulator, 2}, {}, pool);
    controller.run_until(10);
    for (int i = 0; i < 20; ++i) {
        controller.advance(bus);
        stranger.advance(bus);
        friendly.advance(bus);
    }
    EXPECT_TRUE(stranger.gone());
    EXPECT_NE(stranger.refusal().find(to_hex(other->hash)), std::string::npos) << stranger.refusal();
    EXPECT_EQ(controller.tick(), 10);
}

}  // namespace
}  // namespace roboss::test
