// What a lost Simulator held is stepped again from the checkpoint, leg by leg.
#include "roles/controller/recovery.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const Address kFirst{Role::kSimulator, 1}, kSecond{Role::kSimulator, 2};
const ClientId kClient(0u);
const RobotId kBall0(0u), kBall1(1u), kBall2(2u);

World balls() {
    World world = empty_world(1e-3);
    for (int i = 0; i < 3; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{9.0 * i, 0, 1}, {}});
    return world;
}

/// The checkpoint is at tick 0; a Client still needs tick 4; tick 8 is committed. Robots 1 and 2 were an
/// island. Then the second Simulator, which has robot 2, is lost.
class LostSimulator : public testing::Test {
  protected:
    LostSimulator() {
        bool is_new = false;
        for (const Address& address : {kFirst, kSecond})
            (void)roster.seat_for(address, {0, 1, ""}, 0, is_new);
        directory.commit(4, seats, roster);
        checkpoints.committed({{0, 1, 3}, {kBall0, kBall1, kBall2}}, 0);
        directory.want(kClient);
        directory.commit(8, seats, roster);
        roster.seat(1).alive = false;
    }
    /// What the Simulator that is left has to step.
    Assignment assignment_of(Round& leg) {
        leg.send(bus, roster, 100, [](Assignment&) {});
        const auto sent = bus.take<Assignment>(kFirst);
        EXPECT_EQ(sent.size(), 1u);
        return sent.at(0);
    }

    const Simulation sim{balls()};
    const std::vector<SeatId> seats{0, 0, 1};
    ScriptedBus bus;
    Roster roster;
    CostModel costs{*sim.model};
    OrderLog order_log;
    StateDirectory directory{3, 0};
    Checkpoints checkpoints{sim.model, 0, sim.states};
    Recovery recovery{roster, costs, order_log, checkpoints, directory};
};

TEST_F(LostSimulator, ItsRobotsAndThoseTheyMayHaveTouchedAreSteppedToEachNeededTick) {
    order_log.add({1, kClient, 1, kBall2, SetVelocity{}}, 0);
    order_log.add({1, kClient, 2, kBall0, SetVelocity{}}, 0);
    order_log.add({6, kClient, 3, kBall1, SetVelocity{}}, 0);
    recovery.begin();
    EXPECT_EQ(std::vector(recovery.robots().begin(), recovery.robots().end()), (std::vector{kBall1, kBall2}));
    EXPECT_EQ(directory.holder_of(kBall0), 0u);
    EXPECT_EQ(directory.holder_of(kBall1), kLost) << "the step overwrites the state that the first one has";
    ASSERT_TRUE(recovery.has_legs());

    Round first = recovery.first_leg(3, 17);
    Assignment assignment = assignment_of(first);
    EXPECT_TRUE(first.span().recovery);
    EXPECT_EQ(assignment.from, 0);
    EXPECT_EQ(assignment.until, 4) << "where the Client still needs the states";
    EXPECT_EQ(assignment.robots, (std::vector{kBall1, kBall2}));
    ASSERT_EQ(assignment.hand_offs.size(), 1u);
    EXPECT_EQ(assignment.hand_offs[0].source, kControllerAddress);
    ASSERT_EQ(assignment.orders.size(), 1u);
    EXPECT_EQ(assignment.orders[0].sequence, 1u);
    EXPECT_FALSE(recovery.finish_leg(first));
    EXPECT_EQ(directory.wanted()[0].holders, (std::vector<SeatId>{0, 0, 0}));

    Round second = recovery.next_leg(first, 18);
    assignment = assignment_of(second);
    EXPECT_EQ(assignment.from, 4);
    EXPECT_EQ(assignment.until, 8);
    EXPECT_EQ(assignment.keep, (std::vector{kBall1, kBall2})) << "the Client's tick";
    EXPECT_TRUE(assignment.hand_offs.empty());
    EXPECT_EQ(assignment.orders.size(), 1u);
    EXPECT_EQ(assignment.release_before, 0);
    EXPECT_TRUE(recovery.finish_leg(second));
    EXPECT_FALSE(directory.anything_lost(roster));
}

TEST_F(LostSimulator, ItMustReachTheCommittedHashes) {
    recovery.begin();
    const std::vector<std::uint64_t> committed{1, 2, 3};
    EXPECT_FALSE(recovery.first_difference(std::vector<std::uint64_t>{9, 2, 3}, committed))
        << "robot 0 was not stepped again";
    EXPECT_EQ(recovery.first_difference(std::vector<std::uint64_t>{1, 2, 9}, committed), kBall2);
}

TEST_F(LostSimulator, AnotherLossBeginsTheRecoveryAnew) {
    bool is_new = false;
    (void)roster.seat_for({Role::kSimulator, 3}, {0, 1, ""}, 0, is_new);
    recovery.begin();
    (void)recovery.first_leg(3, 17);
    roster.seat(0).alive = false;
    recovery.begin();
    EXPECT_EQ(recovery.robots().size(), 3u);
    const Round leg = recovery.first_leg(4, 18);
    EXPECT_EQ(leg.span().epoch, 4u);
    EXPECT_EQ(leg.seat_of(kBall0), 2u);
}

TEST_F(LostSimulator, WhatTheCheckpointHasIsBackAtOnce) {
    Checkpoints now{sim.model, 8, sim.states};
    StateDirectory resting{3, 4};
    resting.commit(8, std::vector<SeatId>{0, 0, 0}, roster);
    roster.seat(0).alive = false;
    Recovery at_once{roster, costs, order_log, now, resting};
    at_once.begin();
    EXPECT_FALSE(at_once.has_legs());
    EXPECT_FALSE(resting.anything_lost(roster));
}

}  // namespace
}  // namespace roboss::test
