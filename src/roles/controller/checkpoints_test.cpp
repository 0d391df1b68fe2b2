// A checkpoint is fetched while the world goes on, and replaces the one before once nobody needs earlier
// ticks.
#include "roles/controller/checkpoints.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

#include "wire/state_block.h"

namespace roboss::test {
namespace {

const Address kFirst{Role::kSimulator, 1}, kSecond{Role::kSimulator, 2};
const ClientId kClient(0u);

World balls() {
    World world = empty_world(1e-3);
    for (int i = 0; i < 3; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{9.0 * i, 0, 1}, {}});
    return world;
}

/// Robots 0 and 1 are at the first Simulator, robot 2 at the second; the world is at tick 4.
class CheckpointsAtTickZero : public testing::Test {
  protected:
    CheckpointsAtTickZero() {
        bool is_new = false;
        for (const Address& address : {kFirst, kSecond})
            (void)roster.seat_for(address, {0, 1, ""}, 0, is_new);
        directory.commit(4, seats, roster);
    }
    StateReply reply_with(const std::vector<RobotId>& robots, Tick tick) const {
        StateReply reply;
        reply.states.tick = tick;
        for (const RobotId robot : robots) append(reply.states, robot, sim.states[robot.index()]);
        return reply;
    }
    void advance() { checkpoints.advance(bus, directory, roster, 100); }
    /// Answers every request.
    void fetch() {
        advance();
        for (const Address& address : {kFirst, kSecond})
            for (const StateRequest& request : bus.take<StateRequest>(address))
                checkpoints.accept(reply_with(request.robots, request.tick));
    }

    const Simulation sim{balls()};
    const std::vector<SeatId> seats{0, 0, 1};
    ScriptedBus bus;
    Roster roster;
    StateDirectory directory{3, 0};
    Checkpoints checkpoints{sim.model, 0, sim.states};
};

TEST_F(CheckpointsAtTickZero, ServeTheirStatesAndNoOthers) {
    checkpoints.serve(bus, kFirst, {0, {RobotId(1u), RobotId(77u)}, 0});
    const auto replies = bus.take<StateReply>(kFirst);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0].states.robots, std::vector<RobotId>{RobotId(1u)});
    checkpoints.serve(bus, kFirst, {4, {RobotId(1u)}, 0});
    checkpoints.serve(bus, kFirst, {0, {RobotId(1u)}, 9});
    EXPECT_TRUE(bus.take<StateReply>(kFirst).empty()) << "another tick; a tick within a window";
}

TEST_F(CheckpointsAtTickZero, TheNextOneIsFetchedFromItsHolders) {
    checkpoints.request();
    checkpoints.begin(directory, roster);
    EXPECT_FALSE(checkpoints.requested());
    EXPECT_TRUE(checkpoints.has_or_fetches(4));
    EXPECT_TRUE(directory.wants_this_tick());
    advance();
    EXPECT_EQ(bus.take<StateRequest>(kFirst).at(0).robots, (std::vector{RobotId(0u), RobotId(1u)}));
    EXPECT_EQ(bus.take<StateRequest>(kSecond).at(0).robots, std::vector{RobotId(2u)});
    checkpoints.accept(reply_with({RobotId(0u), RobotId(1u)}, 4));
    checkpoints.accept(reply_with({RobotId(2u)}, 3));
    EXPECT_FALSE(checkpoints.fetched()) << "a state of another tick";
    EXPECT_EQ(checkpoints.states_at(4), nullptr);
    bus.time_ms = 150;
    advance();
    EXPECT_TRUE(bus.take<StateRequest>(kFirst).empty());
    EXPECT_EQ(bus.take<StateRequest>(kSecond).size(), 1u) << "asked again";
    checkpoints.accept(reply_with({RobotId(2u)}, 4));
    ASSERT_TRUE(checkpoints.fetched());
    EXPECT_NE(checkpoints.states_at(4), nullptr);
    EXPECT_EQ(checkpoints.tick(), 0);
    ASSERT_TRUE(checkpoints.replace(directory));
    EXPECT_EQ(checkpoints.tick(), 4);
    EXPECT_EQ(checkpoints.states_at(0), nullptr);
    EXPECT_TRUE(directory.wanted().empty());
}

TEST_F(CheckpointsAtTickZero, TheNextOneWaitsUntilNobodyNeedsAnEarlierTick) {
    directory.want(kClient);
    directory.commit(8, seats, roster);
    checkpoints.begin(directory, roster);
    fetch();
    ASSERT_TRUE(checkpoints.fetched());
    EXPECT_FALSE(checkpoints.replace(directory)) << "a loss would need tick 4 from tick 0";
    EXPECT_EQ(checkpoints.tick(), 0);
    directory.forget(kClient, 4);
    EXPECT_TRUE(checkpoints.replace(directory));
}

TEST_F(CheckpointsAtTickZero, ALossAbandonsWhatIsNotHereYet) {
    EXPECT_EQ(checkpoints.abandon(directory), std::nullopt) << "there is none";
    checkpoints.begin(directory, roster);
    advance();
    roster.seat(1).alive = false;
    EXPECT_EQ(checkpoints.abandon(directory), 4);
    EXPECT_FALSE(checkpoints.under_way());
    EXPECT_TRUE(directory.wanted().empty());
    checkpoints.begin(directory, roster);
    EXPECT_FALSE(checkpoints.under_way()) << "a state is lost";
    checkpoints.accept(reply_with({RobotId(0u)}, 4));  // late
    EXPECT_FALSE(checkpoints.fetched());
}

TEST_F(CheckpointsAtTickZero, ARequestSurvivesALoss) {
    checkpoints.request();
    checkpoints.begin(directory, roster);
    EXPECT_FALSE(checkpoints.requested());
    advance();
    roster.seat(1).alive = false;
    EXPECT_EQ(checkpoints.abandon(directory), 4);
    EXPECT_TRUE(checkpoints.requested());
    checkpoints.begin(directory, roster);
    EXPECT_TRUE(checkpoints.requested()) << "nothing can be fetched before the lost state is back";
}

TEST_F(CheckpointsAtTickZero, AFetchedOneSurvivesALoss) {
    checkpoints.begin(directory, roster);
    fetch();
    roster.seat(1).alive = false;
    EXPECT_EQ(checkpoints.abandon(directory), std::nullopt);
    EXPECT_TRUE(checkpoints.replace(directory));
}

TEST_F(CheckpointsAtTickZero, KnowWhichRobotsMayHaveTouchedSince) {
    const std::vector<bool> first{true, false, false};
    EXPECT_EQ(checkpoints.closure(first), std::vector{RobotId(0u)});
    checkpoints.committed({{0, 1, 3}, {RobotId(0u), RobotId(1u), RobotId(2u)}}, 0.5);
    EXPECT_EQ(checkpoints.closure(first), std::vector{RobotId(0u)});
    EXPECT_EQ(checkpoints.closure({false, true, false}), (std::vector{RobotId(1u), RobotId(2u)}));
    EXPECT_EQ(checkpoints.work_s(), 0.5);
    checkpoints.begin(directory, roster);
    EXPECT_EQ(checkpoints.work_s(), 0);
    fetch();
    checkpoints.committed({{0, 2, 3}, {RobotId(0u), RobotId(1u), RobotId(2u)}}, 0.5);
    EXPECT_EQ(checkpoints.closure(first).size(), 3u);
    ASSERT_TRUE(checkpoints.replace(directory));
    EXPECT_EQ(checkpoints.closure(first), (std::vector{RobotId(0u), RobotId(1u)})) << "since tick 4";
}

TEST_F(CheckpointsAtTickZero, CheckThatOneIsFetchedBeforeItReplaces) {
    EXPECT_DEATH((void)checkpoints.replace(directory), "not fetched");
    checkpoints.begin(directory, roster);
    directory.commit(8, seats, roster);
    EXPECT_DEATH(advance(), "do not have the states of the checkpoint at 4");
}

}  // namespace
}  // namespace roboss::test
