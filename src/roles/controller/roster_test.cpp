// Who has a seat, as Simulators join, report, leave and are lost; and what they are sent.
#include "roles/controller/roster.h"

#include <gtest/gtest.h>

#include <support/scripted_bus.h>

namespace roboss::test {
namespace {

const Address kFirst{Role::kSimulator, 1}, kSecond{Role::kSimulator, 2};

class Seats : public testing::Test {
  protected:
    std::optional<SeatId> join(const Address& address, std::uint32_t threads = 1) {
        return roster.seat_for(address, {0, threads, "host"}, bus.time_ms, is_new);
    }
    ScriptedBus bus;
    Roster roster;
    bool is_new = false;
};

TEST_F(Seats, AreGivenInTheOrderOfJoiningAndOnceAnAddress) {
    EXPECT_EQ(join(kFirst), 0u);
    EXPECT_TRUE(is_new);
    EXPECT_EQ(join(kSecond), 1u);
    EXPECT_EQ(join(kFirst), 0u) << "a repeated Hello";
    EXPECT_FALSE(is_new);
    EXPECT_EQ(roster.size(), 2u);
    EXPECT_EQ(roster.seat_at(kSecond), 1u);
    EXPECT_EQ(roster.seat_at({Role::kSimulator, 3}), std::nullopt);
    EXPECT_EQ(roster.address_of(1), kSecond);
    EXPECT_EQ(roster.address_of(kAtController), kControllerAddress);
}

TEST_F(Seats, OfALostSimulatorAreNotGivenAgain) {
    (void)join(kFirst);
    roster.give_up(0);
    EXPECT_FALSE(roster.alive(0));
    EXPECT_TRUE(roster.lost(0));
    EXPECT_TRUE(roster.lost(7)) << "there is no such seat";
    EXPECT_FALSE(roster.lost(kAtController));
    EXPECT_TRUE(roster.lost(kLost));
    EXPECT_EQ(join(kFirst), 1u) << "it joins again, at the same address";
    EXPECT_TRUE(is_new);
    EXPECT_EQ(roster.alive_count(), 1u);
}

TEST_F(Seats, GetIdsBehindThoseOfEarlierControllers) {
    Roster later(100);
    EXPECT_EQ(later.size(), 0u);
    EXPECT_EQ(later.seat_for(kFirst, {0, 1, ""}, 0, is_new), 0u);
    EXPECT_EQ(later.id_of(0), SimulatorId(100u));
}

TEST_F(Seats, OfThoseThatLeaveGetNoWork) {
    (void)join(kFirst, 4);
    (void)join(kSecond, 0);
    EXPECT_EQ(roster.threads(), 5u) << "at least one thread each";
    EXPECT_EQ(roster.fewest_threads(), 1u);
    roster.seat(0).leaving = true;
    EXPECT_EQ(roster.leaving(), std::vector<SeatId>{0});
    EXPECT_EQ(roster.workers(), std::vector<SeatId>{1});
    EXPECT_EQ(roster.threads(), 1u);
    EXPECT_EQ(roster.fewest_threads(), 1u);
    EXPECT_EQ(roster.alive_count(), 2u) << "it is still there";
    roster.release(bus, 0);
    EXPECT_TRUE(roster.leaving().empty());
    ASSERT_EQ(bus.take<Goodbye>(kFirst).size(), 1u);
    EXPECT_EQ(join(kFirst), std::nullopt) << "a late copy of its Hello";
    EXPECT_FALSE(is_new);
}

TEST_F(Seats, KeepTheTimeOfTheLastMessage) {
    (void)join(kFirst);
    bus.time_ms = 70;
    EXPECT_EQ(roster.heard_from(bus, kFirst), 0u);
    EXPECT_EQ(roster.seat(0).heard_ms, 70);
    bus.time_ms = 90;
    EXPECT_EQ(roster.heard_from(bus, kFirst, SimulatorId(0u)), 0u);
    EXPECT_EQ(roster.seat(0).heard_ms, 90);
    EXPECT_EQ(roster.heard_from(bus, kSecond), std::nullopt);
}

TEST_F(Seats, AreRefusedToSendersThatDoNotHoldThem) {
    (void)join(kFirst);
    EXPECT_EQ(roster.heard_from(bus, kSecond, SimulatorId(0u)), std::nullopt) << "the seat of another";
    EXPECT_EQ(bus.take<Expelled>(kSecond).size(), 1u);
    EXPECT_EQ(roster.heard_from(bus, kSecond, SimulatorId(9u)), std::nullopt);
    EXPECT_EQ(bus.take<Expelled>(kSecond).size(), 1u);
    roster.seat(0).leaving = true;
    roster.release(bus, 0);
    (void)bus.take<Goodbye>(kFirst);
    EXPECT_EQ(roster.heard_from(bus, kFirst, SimulatorId(0u)), std::nullopt);
    EXPECT_EQ(bus.take<Goodbye>(kFirst).size(), 1u) << "its first Goodbye may be lost";
}

TEST_F(Seats, OfTheLivingGetHeartbeatsAndTheEndOfTheRun) {
    (void)join(kFirst);
    (void)join(kSecond);
    roster.give_up(0);
    roster.send_heartbeats(bus);
    EXPECT_TRUE(bus.take<Heartbeat>(kFirst).empty());
    EXPECT_EQ(bus.take<Heartbeat>(kSecond).size(), 1u);
    roster.dismiss(bus, {"done"});
    EXPECT_TRUE(bus.take<RunOver>(kFirst).empty());
    EXPECT_EQ(bus.take<RunOver>(kSecond).size(), 1u);
}

TEST_F(Seats, BalanceIsTheMeanLoadAgainstTheBusiest) {
    (void)join(kFirst, 3);
    (void)join(kSecond);
    EXPECT_EQ(roster.balance(), 1) << "nothing is measured yet";
    roster.seat(0).spent_ns = 100, roster.seat(1).spent_ns = 20;
    EXPECT_DOUBLE_EQ(roster.balance(), (3 * 100 + 20) / (4.0 * 100));
}

TEST(SeatsDeathTest, AreGivenUpAndReleasedOnce) {
    Roster roster;
    bool is_new = false;
    (void)roster.seat_for(kFirst, {0, 1, ""}, 0, is_new);
    ScriptedBus bus;
    EXPECT_DEATH(roster.release(bus, 0), "did not want to leave");
    roster.give_up(0);
    EXPECT_DEATH(roster.give_up(0), "lost twice");
}

}  // namespace
}  // namespace roboss::test
