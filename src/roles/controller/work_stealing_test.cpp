// Of two Simulators one is late: the other gets a part of the rest, with the orders that belong to it.
#include "roles/controller/work_stealing.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr std::uint32_t kRobots = 4;
constexpr Tick kUntil = 100;
const Address kFirst{Role::kSimulator, 1}, kSecond{Role::kSimulator, 2};

/// Robots 0 to 2 are islands of the first Simulator, robot 3 is one of the second.
class LateSimulator : public testing::Test {
  protected:
    LateSimulator() {
        bool is_new = false;
        for (const Address& address : {kFirst, kSecond})
            (void)roster.seat_for(address, {0, 1, ""}, 0, is_new);
        Islands& islands = round.islands;
        for (std::uint32_t r = 0; r < kRobots; ++r) {
            islands.robots.emplace_back(r);
            islands.offsets.push_back(r + 1);
        }
        const std::vector<SeatId> seats{0, 0, 0, 1};
        round.assign(islands, seats, seats, roster);
        round.send(bus, roster, 100, [](Assignment&) {});
        given.push_back(bus.take<Assignment>(kFirst).at(0));
        given.push_back(bus.take<Assignment>(kSecond).at(0));
    }
    void second_is_done() {
        WindowResult result;
        result.window = 1;
        result.robots.push_back({RobotId(3u), {}, {}, {}, 0});
        result.islands.resize(1);
        bool fits = false;
        ASSERT_TRUE(round.answered_by(1, result, fits));
    }
    void first_is_late() { round.take_late(0, {0, 1, 0, 1'000'000}); }

    ScriptedBus bus;
    Roster roster;
    OrderLog order_log;
    Round round{{0, 1, 0, kUntil, false}, kRobots};
    std::vector<Assignment> given;
};

TEST_F(LateSimulator, GetsACutOnceAnotherIsIdle) {
    first_is_late();
    steal_work(bus, round, roster);
    EXPECT_TRUE(bus.take<Cut>(kFirst).empty()) << "the other one still steps";
    second_is_done();
    steal_work(bus, round, roster);
    ASSERT_EQ(bus.take<Cut>(kFirst).size(), 1u);
    steal_work(bus, round, roster);
    EXPECT_TRUE(bus.take<Cut>(kFirst).empty()) << "once";
}

TEST_F(LateSimulator, GetsNoCutInARecovery) {
    Round recovery({0, 2, 0, kUntil, true}, kRobots);
    recovery.assign(round.islands, std::vector<SeatId>(kRobots, 0), std::vector<SeatId>(kRobots, 0), roster);
    recovery.take_late(0, {0, 2, 0, 1'000'000});
    steal_work(bus, recovery, roster);
    EXPECT_TRUE(bus.take<Cut>(kFirst).empty());
}

TEST_F(LateSimulator, SharesTheRestWithTheIdleOne) {
    order_log.add({50, ClientId(0u), 1, RobotId(0u), SetVelocity{}}, 0);
    order_log.add({5, ClientId(0u), 2, RobotId(0u), SetVelocity{}}, 0);  // before the Cut
    first_is_late();
    second_is_done();
    steal_work(bus, round, roster);
    WindowResult cut;
    cut.window = 1;
    cut.left = 60;
    cut.islands.resize(3);
    for (IslandResult& island : cut.islands) island.cost_ns = 40'000'000;
    bool fits = false;
    const auto answered = round.answered_by(0, cut, fits);
    ASSERT_TRUE(answered);
    share_out_rest(round, *answered, cut.islands, 40, roster, order_log);
    round.send(bus, roster, 100, [](Assignment&) {});
    const auto first = bus.take<Assignment>(kFirst), second = bus.take<Assignment>(kSecond);
    ASSERT_EQ(first.size(), 1u);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(first[0].robots.size() + second[0].robots.size(), 3u);
    EXPECT_FALSE(second[0].robots.empty());
    std::size_t orders = 0;
    for (const Assignment& rest : {first[0], second[0]}) {
        EXPECT_EQ(rest.from, 40);
        EXPECT_EQ(rest.until, kUntil);
        EXPECT_EQ(rest.mid_window(), 1u);
        EXPECT_NEAR(static_cast<double>(rest.due_ns), 90e6, 1e6) << "half of 3 islands of 1 ms in 60 ticks";
        orders += rest.orders.size();
    }
    EXPECT_EQ(orders, 1u);
    ASSERT_EQ(second[0].hand_offs.size(), 1u);
    EXPECT_EQ(second[0].hand_offs[0], (Holding{kFirst, second[0].robots}));
}

TEST_F(LateSimulator, LearnsWhatIsExpectedOnlyWhenThatIsWorthIt) {
    World world = empty_world(1e-3);
    for (std::uint32_t r = 0; r < kRobots; ++r)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(r),
              {{9.0 * r, 0, 1}, {}});
    const Simulation sim{world};
    CostModel costs{*sim.model};
    const auto expected = [&](double least_ns) {
        Round next({0, 2, 0, kUntil, false}, kRobots);
        next.assign(round.islands, std::vector<SeatId>{0, 0, 1, 1}, std::vector<SeatId>(kRobots, 0), roster);
        announce_expected_work(next, costs, roster, least_ns);
        next.send(bus, roster, 100, [](Assignment&) {});
        return bus.take<Assignment>(kFirst).at(0).due_ns;
    };
    EXPECT_EQ(expected(0), 0u) << "costs are guessed";
    for (IslandResult& outcome : round.outcome) outcome.cost_ns = 100'000;
    costs.learn(round, roster);
    EXPECT_EQ(expected(0), 200'000u);
    EXPECT_EQ(expected(300'000), 0u);
}

}  // namespace
}  // namespace roboss::test
