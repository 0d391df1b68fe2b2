// A hand in a page: orders of a free-running Client that joins with the first of them, over a network that
// loses messages. They take effect while the gesture lasts, not when it is over.
#include <gtest/gtest.h>

#include <algorithm>

#include "client/bus_client.h"
#include "faulty_cluster.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr std::int64_t kEvery_ms = 50, kGesture_ms = 3000;

/// How late each order of a gesture was acknowledged, ms, in their order. Those that were not by its end
/// count as that late.
std::vector<std::int64_t> latencies(std::uint64_t seed, double drop) {
    const auto model = pair_world();
    FaultOptions faults;
    faults.seed = seed, faults.drop = drop, faults.delay_ms_max = 4;
    FaultyCluster cluster(model, {}, faults, {}, 1);
    cluster.turn();
    cluster.controller().run_until(1'000'000);
    for (int i = 0; i < 100; ++i) cluster.turn();
    BusClientOptions options;
    options.name = "viewer";
    options.period = options.latency = Tick{1} << 49;
    options.synchronous = false, options.observer = true;
    BusClient hand(model, Address{Role::kClient, 77}, options);
    FaultyBus& bus = cluster.bus();
    std::vector<std::int64_t> given, late;
    const std::int64_t begin = bus.now_ms();
    for (std::int64_t next = begin; bus.now_ms() < begin + kGesture_ms; cluster.turn()) {
        if (bus.now_ms() >= next) {
            next = bus.now_ms() + kEvery_ms;
            EXPECT_TRUE(hand.apply_wrench(RobotId(3u), LinkId(0u), {1, 0, 0}, {}, 0.1).ok());
            hand.send(bus, 0);
            given.push_back(bus.now_ms());
        }
        hand.advance(bus);
        while (late.size() < hand.acknowledged()) late.push_back(bus.now_ms() - given[late.size()]);
    }
    for (std::size_t i = late.size(); i < given.size(); ++i) late.push_back(bus.now_ms() - given[i]);
    EXPECT_TRUE(hand.take_refusals().empty());
    return late;
}

/// The share of orders that took effect within the time.
double share_within(const std::vector<std::int64_t>& late, std::int64_t ms) {
    return static_cast<double>(std::ranges::count_if(late, [=](std::int64_t x) { return x <= ms; })) /
           static_cast<double>(late.size());
}

TEST(Gestures, TheFirstOrderTakesEffectAtOnceAndSoDoAllOthers) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
        for (const std::int64_t ms : latencies(seed, 0)) EXPECT_LE(ms, 50) << seed;
}

TEST(Gestures, LostMessagesDelayAMomentAndNeverUntilTheGestureIsOver) {
    std::vector<std::int64_t> all;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::vector<std::int64_t> late = latencies(seed, 0.05);
        EXPECT_LT(*std::ranges::max_element(late), 500) << seed;
        all.insert(all.end(), late.begin(), late.end());
    }
    EXPECT_GT(share_within(all, 50), 0.9);
    std::printf("    measured: share within 50 ms at 5 %% loss = %.3f\n", share_within(all, 50));
}

TEST(Gestures, HalfOfTheOrdersAreInTimeAtAFifthLost) {
    std::vector<std::int64_t> all;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::vector<std::int64_t> late = latencies(seed, 0.2);
        all.insert(all.end(), late.begin(), late.end());
    }
    EXPECT_GT(share_within(all, 50), 0.5);
    EXPECT_GT(share_within(all, 500), 0.99);
    std::printf("    measured: share within 50 ms at 20 %% loss = %.3f\n", share_within(all, 50));
}

/// A pull is part of the state: it goes on wherever the robot is stepped, and after a save.
TEST(Gestures, APullGivesTheSameStateForEveryNumberOfSimulatorsAndWindow) {
    const auto model = pair_world();
    const auto make = [&](std::size_t simulators, Tick window, const SavedRun* from = nullptr) {
        SimulationOptions options;
        options.simulators = simulators;
        auto made = std::move(Simulation::create(model, options, {}, from).value());
        made->set_window(window);
        return made;
    };
    const auto pull = [](Simulation& run) {
        for (std::uint64_t r = 0; r < 4; ++r)
            EXPECT_TRUE(run.submit({20, ClientId(), r + 1, RobotId(r),
                                    Pull{LinkId(0u), {0.1, 0, 0.1}, {1, 1, 1.5}, 15, 500, 200}})
                            .ok());
    };
    const auto reference = make(1, 1);
    pull(*reference);
    ASSERT_TRUE(reference->run_until(150).ok());
    const SavedRun half = reference->saved_run();
    EXPECT_FALSE(half.states[3].pulls.empty());
    ASSERT_TRUE(reference->run_until(300).ok());
    for (const std::size_t simulators : {1u, 3u})
        for (const Tick window : {1, 7, 40}) {
            const auto run = make(simulators, window);
            pull(*run);
            ASSERT_TRUE(run->run_until(300).ok());
            EXPECT_EQ(run->hash(), reference->hash()) << simulators << " Simulators, windows of " << window;
        }
    const auto continued = make(2, 10, &half);
    ASSERT_TRUE(continued->run_until(300).ok());
    EXPECT_EQ(continued->hash(), reference->hash());
}

/// What the Controller refuses is named with its code in each acknowledgement until the Client has had one.
TEST(Gestures, RefusalsOfSeveralRepliesAreAllAcknowledged) {
    const auto model = pair_world();
    FaultOptions faults;
    faults.drop = faults.duplicate = 0;
    FaultyCluster cluster(model, {}, faults, {}, 1);
    cluster.turn();
    cluster.controller().run_until(1'000'000);
    const Address self{Role::kClient, 77};
    const auto hear = [&](auto take) {
        for (int i = 0; i < 500; ++i) {
            cluster.turn();
            std::vector<Envelope> inbox;
            cluster.bus().drain(self, inbox);
            for (const Envelope& envelope : inbox) take(envelope.message);
        }
    };
    cluster.bus().send(self, kControllerAddress,
                       ClientHello{"raw", model->hash, Tick{1} << 49, Tick{1} << 49, false, true});
    ClientId id;
    hear([&](const Message& m) {
        if (const auto* welcome = std::get_if<ClientWelcome>(&m)) id = welcome->client;
    });
    ASSERT_TRUE(id.valid());
    const auto bad = [&](std::uint64_t number) {
        return ClientReply{id, number, 0, {{number, RobotId(3u), SetVelocity{{1e308, 0, 0}, {}}}}, 0};
    };
    std::vector<RefusedOrder> refused;
    const auto last_ack = [&](const Message& m) {
        if (const auto* ack = std::get_if<ReplyAck>(&m)) refused = ack->refused;
    };
    cluster.bus().send(self, kControllerAddress, bad(1));
    hear(last_ack);
    cluster.bus().send(self, kControllerAddress, bad(2));
    hear(last_ack);
    ASSERT_EQ(refused.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(refused[i].sequence, i + 1);
        EXPECT_EQ(refused[i].code, "beyond-limit");
    }
    cluster.bus().send(self, kControllerAddress, ClientReply{id, 3, 0, {}, 2});
    hear(last_ack);
    EXPECT_TRUE(refused.empty());
    EXPECT_FALSE(cluster.controller().stopped()) << "the run goes on for everybody";
}

}  // namespace
}  // namespace roboss::test
