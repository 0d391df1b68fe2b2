// Who has which state, as Simulators come, leave and are lost.
#include "roles/controller/state_directory.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roboss {
namespace {

const ClientId kClient(0u), kOther(1u);

Roster roster_of(std::uint64_t simulators) {
    Roster roster;
    bool is_new = false;
    for (std::uint64_t i = 0; i < simulators; ++i)
        (void)roster.seat_for({Role::kSimulator, i + 1}, {0, 1, ""}, 0, is_new);
    return roster;
}

std::vector<SeatId> holders(const StateDirectory& directory) {
    return {directory.holders().begin(), directory.holders().end()};
}

TEST(StateDirectory, BeginsAtTheControllerAndFollowsCommits) {
    const Roster roster = roster_of(2);
    StateDirectory directory(3, 10);
    EXPECT_EQ(holders(directory), std::vector<SeatId>(3, kAtController));
    EXPECT_FALSE(directory.anything_lost(roster));
    directory.commit(14, std::vector<SeatId>{0, 1, 1}, roster);
    EXPECT_EQ(directory.tick(), 14);
    EXPECT_EQ(directory.holder_of(RobotId(2u)), 1u);
}

TEST(StateDirectory, KeepsTheHoldersOfATickUntilNobodyWantsIt) {
    const Roster roster = roster_of(2);
    StateDirectory directory(2, 0);
    directory.commit(4, std::vector<SeatId>{0, 1}, roster);
    EXPECT_FALSE(directory.wants_this_tick());
    EXPECT_EQ(directory.oldest_wanted(77), 77);
    directory.want(kClient);
    directory.want(kOther);
    directory.want_checkpoint();
    EXPECT_TRUE(directory.wants_this_tick());
    directory.commit(8, std::vector<SeatId>{1, 1}, roster);
    EXPECT_FALSE(directory.wants_this_tick());
    ASSERT_EQ(directory.wanted().size(), 1u);
    EXPECT_EQ(directory.wanted()[0].holders, (std::vector<SeatId>{0, 1}));
    EXPECT_EQ(directory.next_needed(0), 4);
    EXPECT_EQ(directory.next_needed(4), 8);
    directory.forget(kClient, 4);
    directory.forget(kOther, 8);  // another tick
    directory.forget_checkpoint();
    EXPECT_EQ(directory.oldest_wanted(77), 4);
    directory.forget(kOther, 4);
    EXPECT_TRUE(directory.wanted().empty());
}

TEST(StateDirectory, GivesTheControllerWhatALeavingSimulatorHeld) {
    Roster roster = roster_of(2);
    StateDirectory directory(2, 0);
    directory.commit(4, std::vector<SeatId>{0, 1}, roster);
    directory.want(kClient);
    directory.take_over(1);
    roster.seat(1).alive = false;
    EXPECT_EQ(holders(directory), (std::vector<SeatId>{0, kAtController}));
    EXPECT_EQ(directory.wanted()[0].holders, holders(directory));
    EXPECT_FALSE(directory.anything_lost(roster));
}

TEST(StateDirectory, KnowsWhatALostSimulatorHeldNowAndAtWantedTicks) {
    Roster roster = roster_of(2);
    StateDirectory directory(3, 0);
    directory.commit(4, std::vector<SeatId>{0, 1, 1}, roster);
    directory.want(kClient);
    directory.commit(8, std::vector<SeatId>{0, 0, 1}, roster);
    roster.seat(1).alive = false;
    EXPECT_TRUE(directory.anything_lost(roster));
    EXPECT_EQ(directory.lost(roster), (std::vector<bool>{false, true, true}));
    roster.seat(0).alive = false;
    EXPECT_EQ(directory.lost(roster), std::vector<bool>(3, true));
}

TEST(StateDirectory, ARecoveryBringsBackEachWantedTickAndThenTheCommittedOne) {
    Roster roster = roster_of(2);
    StateDirectory directory(2, 0);
    directory.want(kClient);  // at the checkpoint
    directory.commit(4, std::vector<SeatId>{0, 1}, roster);
    directory.want(kClient);
    directory.commit(8, std::vector<SeatId>{0, 1}, roster);
    roster.seat(1).alive = false;
    const std::vector<RobotId> robots{RobotId(1u)};
    directory.begin_recovery(robots, 0);
    EXPECT_EQ(directory.wanted()[0].holders[1], kAtController);
    EXPECT_EQ(directory.wanted()[1].holders[1], kLost);
    EXPECT_EQ(directory.holder_of(robots[0]), kLost);
    const std::vector<SeatId> seats{0, 0};
    directory.recovered(robots, 4, seats, roster);
    EXPECT_EQ(directory.wanted()[1].holders[1], 0u);
    EXPECT_TRUE(directory.anything_lost(roster)) << "not yet at the committed tick";
    directory.recovered(robots, 8, seats, roster);
    EXPECT_FALSE(directory.anything_lost(roster));
}

TEST(StateDirectory, ARecoveryToTheCheckpointsOwnTickNeedsNoStep) {
    Roster roster = roster_of(1);
    StateDirectory directory(1, 0);
    directory.commit(4, std::vector<SeatId>{0}, roster);
    roster.seat(0).alive = false;
    directory.begin_recovery(std::vector<RobotId>{RobotId(0u)}, 4);
    EXPECT_EQ(directory.holder_of(RobotId(0u)), kAtController);
}

TEST(StateDirectoryDeathTest, ChecksThatTicksGrowAndThatEveryStateHasAHolder) {
    Roster roster = roster_of(1);
    StateDirectory directory(2, 4);
    EXPECT_DEATH(directory.commit(4, std::vector<SeatId>{0, 0}, roster), "committed after tick 4");
    EXPECT_DEATH(directory.commit(8, std::vector<SeatId>{0}, roster), "1 holders for 2 robots");
    EXPECT_DEATH(directory.commit(8, std::vector<SeatId>{0, kLost}, roster), "holds robot 1");
    roster.seat(0).alive = false;
    EXPECT_DEATH(directory.commit(8, std::vector<SeatId>{0, 0}, roster), "holds robot 0");
}

}  // namespace
}  // namespace roboss
