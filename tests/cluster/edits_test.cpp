// Robots that come and go, and resets: the same hash on one Simulator and on several, over a bad Bus with
// Simulators that are killed, and however often it is done.
#include <gtest/gtest.h>

#include "faulty_cluster.h"
#include "model/edit.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

/// Where a run stands between two edits.
struct Stand {
    std::shared_ptr<const Model> model;
    Tick tick = 0;
    std::vector<RobotState> states;
};

Stand beginning(const std::shared_ptr<const Model>& model) {
    Stand stand{model, 0, {}};
    for (std::size_t i = 0; i < model->robots.size(); ++i)
        stand.states.push_back(initial_state(*model, RobotId(i)));
    return stand;
}

Stand changed(const Stand& stand, const Result<ModelEdit>& edit) {
    EXPECT_TRUE(edit.ok());
    return {edit.value().model, stand.tick, carry_over(edit.value(), stand.states)};
}

/// Copies of the pair of crates, the lone crate and the ball, in the air over the piles.
std::vector<CopyPlace> places(int count) {
    std::vector<CopyPlace> all;
    for (int i = 0; i < count; ++i)
        all.push_back(
            {"guest" + std::to_string(i), {{0.7 * i - 2, 0.1 * i, 1.5 + 0.3 * i}, from_rpy(0, 0, 0.1 * i)}});
    return all;
}

constexpr Tick kFirst = 60, kSecond = 140, kThird = 220;

/// Steps a Stand to a tick.
using Stepper = std::function<Stand(const Stand&, Tick)>;

/// The hashes of a run with an addition, a removal and a reset.
std::vector<std::uint64_t> hashes_of(const Stepper& stepped) {
    const auto world = piles_world(2);
    const auto hash = [](const Stand& s) { return state_hash_of(*s.model, s.tick, s.states); };
    const Stand first = stepped(beginning(world), kFirst);
    const Stand more = stepped(changed(first, with_models(*world, *pair_world(), places(6))), kSecond);
    const std::vector<std::string> gone{world->robots[1].name, "guest0*", "guest3*",
                                        more.model->robots.back().name};
    const Stand less = stepped(changed(more, without_robots(*more.model, gone)), kThird);
    const Stand again = stepped(beginning(world), kFirst);
    EXPECT_EQ(hash(again), hash(first)) << "after the reset";
    return {hash(first), hash(more), hash(less)};
}

Stepper embedded(std::size_t simulators, std::size_t lanes, Tick window) {
    return [=](const Stand& from, Tick until) {
        SavedRun run;
        run.tick = run.logged_until = from.tick;
        run.states = from.states;
        SimulationOptions options;
        options.simulators = simulators;
        options.lanes = lanes;
        options.controller.window = window;
        auto simulation = Simulation::create(from.model, options, {}, &run);
        EXPECT_TRUE(simulation.ok());
        EXPECT_TRUE(simulation.value()->run_until(until).ok());
        return Stand{from.model, until, simulation.value()->states()};
    };
}

Stepper troubled(std::uint64_t& seed, int& kills) {
    return [&](const Stand& from, Tick until) {
        FaultyCluster cluster(from.model, {}, {++seed, 0.05, 0.05, 5}, {.kill = 1'500, .rescue = 20'000}, 3);
        cluster.restart_controller({from.tick, from.states, {}, from.tick, {}});
        EXPECT_TRUE(cluster.run_until(until)) << "seed " << seed;
        for (int i = 0; i < 100'000 && cluster.controller().states() == nullptr; ++i) {
            if (i % 1'000 == 0 && cluster.controller().resting()) cluster.controller().request_states();
            cluster.turn();
        }
        EXPECT_NE(cluster.controller().states(), nullptr) << "seed " << seed;
        kills += cluster.kills();
        return Stand{from.model, until, *cluster.controller().states()};
    };
}

TEST(Edits, ComingGoingAndResettingGiveTheSameBitsOnAnyNumberOfSimulators) {
    const std::vector<std::uint64_t> expected = hashes_of(embedded(1, 1, 0));
    for (const std::size_t simulators : {1u, 2u, 5u})
        for (const Tick window : {Tick{0}, Tick{1}, Tick{7}})
            EXPECT_EQ(hashes_of(embedded(simulators, kMostLanes, window)), expected)
                << simulators << " Simulators, windows of " << window;
}

/// The hashes of a run in which robots are removed, copied and restored.
std::vector<std::uint64_t> hashes_with_copies(const Stepper& stepped) {
    const auto world = piles_world(2);
    const auto hash = [](const Stand& s) { return state_hash_of(*s.model, s.tick, s.states); };
    const Stand first = stepped(beginning(world), kFirst);
    const RobotId left(1u);
    const Robot& robot = world->robots[left.index()];
    const Stand less = stepped(changed(first, without_robots(*world, {robot.name})), kSecond);
    RobotState kept = first.states[left.index()];
    kept.contacts.clear(), kept.bonds.clear(), kept.rest = {};
    const std::vector<double>& q = less.states[0].q;
    const std::vector<RobotFrom> copy{
        {less.model, RobotId(0u), "copy", {{0.3, 0.2, 2.5}, {}}, {q.begin() + 7, q.end()}}};
    const Stand more = stepped(changed(less, with_robots(*less.model, copy)), kSecond + 40);
    const std::vector<RobotFrom> back{{world, left, robot.name, robot.X_WR, robot.start_q, true}};
    Stand again = changed(more, with_robots(*more.model, back));
    again.states.back() = kept;
    EXPECT_EQ(again.states.back().q, first.states[left.index()].q);
    const Stand last = stepped(again, kThird);
    return {hash(first), hash(less), hash(more), hash(last)};
}

TEST(Edits, CopiesAndRobotsThatReturnGiveTheSameBitsOnAnyNumberOfSimulators) {
    const std::vector<std::uint64_t> expected = hashes_with_copies(embedded(1, 1, 0));
    for (const std::size_t simulators : {1u, 2u, 5u})
        for (const Tick window : {Tick{0}, Tick{7}})
            EXPECT_EQ(hashes_with_copies(embedded(simulators, kMostLanes, window)), expected)
                << simulators << " Simulators, windows of " << window;
}

TEST(Edits, SimulatorsThatAreKilledMeanwhileChangeNothing) {
    const std::vector<std::uint64_t> expected = hashes_of(embedded(1, kMostLanes, 0));
    std::uint64_t seed = 0;
    int kills = 0;
    for (int round = 0; round < 5; ++round)
        EXPECT_EQ(hashes_of(troubled(seed, kills)), expected) << "seed " << seed;
    EXPECT_GT(kills, 5);
}

TEST(Edits, AThousandRobotsComeAndGoAndTheOthersDoNotNotice) {
    Stand stand = embedded(1, kMostLanes, 0)(beginning(piles_world(2)), kFirst);
    std::vector<std::uint64_t> before;
    for (std::size_t i = 0; i < stand.states.size(); ++i)
        before.push_back(state_hash(RobotId(i), stand.tick, stand.states[i]));
    const auto model = stand.model;
    Model guests = *pair_world();
    guests.statics.clear();  // scenery that comes wakes all sleepers, and stays
    for (int round = 0; round < 3; ++round) {
        std::vector<CopyPlace> crowd = places(250);
        for (CopyPlace& place : crowd) place.X_WA.p.z += 100;
        const Stand more = changed(stand, with_models(*stand.model, guests, crowd));
        ASSERT_EQ(more.states.size(), before.size() + 1000);
        for (std::size_t i = 0; i < before.size(); ++i)
            ASSERT_EQ(state_hash(RobotId(i), more.tick, more.states[i]), before[i]);
        stand = changed(more, without_robots(*more.model, {"guest*"}));
        EXPECT_EQ(stand.model->hash, model->hash);
        EXPECT_EQ(stand.model->types.size(), model->types.size());
        for (std::size_t i = 0; i < before.size(); ++i)
            ASSERT_EQ(state_hash(RobotId(i), stand.tick, stand.states[i]), before[i]);
    }
}

/// As a run does it: another Simulation on the same Bus, which takes over what it must know.
TEST(Edits, TenThousandResetsGiveTheSameRunAndLeaveNothingBehind) {
    const auto model = pair_world();
    const Stand start = beginning(model);
    SavedRun run;
    run.states = start.states;
    SimulationOptions options;
    options.simulators = 2;
    std::unique_ptr<Simulation> simulation = std::move(Simulation::create(model, options, {}, &run)).value();
    const std::uint64_t first = simulation->hash();
    ASSERT_TRUE(simulation->run_until(3).ok());
    const std::uint64_t third = simulation->hash();
    for (int reset = 0; reset < 10'000; ++reset) {
        options.controller.before = simulation->hand_over();
        options.controller.before.went_back = true;
        std::unique_ptr<Bus> bus = simulation->release_bus();
        simulation = std::move(Simulation::create(model, options, {}, &run, std::move(bus))).value();
        ASSERT_EQ(simulation->hash(), first);
        ASSERT_TRUE(simulation->run_until(3).ok());
        ASSERT_EQ(simulation->hash(), third) << "reset " << reset;
        ASSERT_EQ(simulation->members().size(), 2u) << "those of earlier Simulations are no more";
    }
    EXPECT_EQ(options.controller.before.models.size(), 1u);
}

}  // namespace
}  // namespace roboss::test
