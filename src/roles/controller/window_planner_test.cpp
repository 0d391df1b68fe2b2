// Windows end where something limits them, and islands that touched are stepped again.
#include "roles/controller/window_planner.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const Address kFirst{Role::kSimulator, 1}, kSecond{Role::kSimulator, 2};

World balls() {
    World world = empty_world(1e-3);
    for (int i = 0; i < 3; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{9.0 * i, 0, 1}, {}});
    return world;
}

class Windows : public testing::Test {
  protected:
    Windows() {
        bool is_new = false;
        for (const Address& address : {kFirst, kSecond})
            (void)roster.seat_for(address, {0, 1, ""}, 0, is_new);
    }
    /// Sends the assignments and answers each; the swept box of robot r is a cube around x = at[r].
    void answer(Round& round, const std::vector<float>& at) {
        round.send(bus, roster, 100, [](Assignment&) {});
        for (SeatId seat = 0; seat < 2; ++seat)
            for (const Assignment& assignment : bus.take<Assignment>(roster.address_of(seat))) {
                WindowResult result;
                result.window = assignment.window;
                result.attempt = assignment.attempt;
                result.islands.resize(assignment.island_offsets.size() - 1);
                for (const RobotId robot : assignment.robots) {
                    RobotResult one;
                    one.robot = robot;
                    one.swept.min = {at[robot.index()] - 1, -1, -1};
                    one.swept.max = {at[robot.index()] + 1, 1, 1};
                    result.robots.push_back(one);
                }
                bool fits = false;
                const auto answered = round.answered_by(seat, result, fits);
                ASSERT_TRUE(answered);
                planner.take_result(round, answered->assignment, result);
            }
        ASSERT_TRUE(round.all_answered());
    }
    Round plan(const WindowLimits& limits) { return planner.plan(0, ++window, limits, directory); }

    const Simulation sim{balls()};
    ScriptedBus bus;
    Roster roster;
    CostModel costs{*sim.model};
    OrderLog order_log;
    StateDirectory directory{3, 0};
    std::uint64_t window = 0;
    WindowPlanner planner{sim.model, {}, sim.states, roster, costs, order_log};
};

TEST_F(Windows, EndWhereTheyAreLimited) {
    const Tick length = planner.length();
    EXPECT_EQ(plan({1000, {}}).span().until, length);
    EXPECT_EQ(plan({3, {}}).span().until, 3);
    EXPECT_EQ(plan({1000, 2}).span().until, 2);
    planner.end_at(5);
    EXPECT_EQ(plan({1000, {}}).span().until, 5);
    planner.end_at(length);
    planner.set_length(4);
    EXPECT_EQ(plan({1000, {}}).span().until, 4);
}

TEST_F(Windows, AreNeverEmpty) {
    EXPECT_DEATH((void)plan({0, {}}), "a window from tick 0 to 0");
}

TEST_F(Windows, TakeTheOrdersOfTheirTicks) {
    order_log.add({2, ClientId(0u), 1, RobotId(1u), SetVelocity{}}, 0);
    order_log.add({900, ClientId(0u), 2, RobotId(1u), SetVelocity{}}, 0);
    Round round = plan({1000, {}});
    round.send(bus, roster, 100, [](Assignment&) {});
    std::size_t orders = 0;
    for (const Address& address : {kFirst, kSecond})
        for (const Assignment& assignment : bus.take<Assignment>(address)) orders += assignment.orders.size();
    EXPECT_EQ(orders, 1u);
}

TEST_F(Windows, OfRobotsThatStayApartAreSteppedOnce) {
    Round round = plan({1000, {}});
    EXPECT_EQ(round.islands.count(), 3u);
    EXPECT_FALSE(planner.looked_ahead(round));
    EXPECT_EQ(planner.look_ahead(bus, round, {1000, {}}), 0u);
    EXPECT_TRUE(planner.looked_ahead(round));
    answer(round, {0, 9, 18});
    EXPECT_FALSE(planner.some_touched(round));
    EXPECT_EQ(planner.motions()[1].swept.min[0], 8);
}

TEST_F(Windows, RepeatTheIslandsThatTouchedAndNoOthers) {
    Round round = plan({1000, {}});
    (void)planner.look_ahead(bus, round, {1000, {}});
    answer(round, {0, 9, 10});
    ASSERT_TRUE(planner.some_touched(round));
    EXPECT_EQ(planner.repeat(round), 2u);
    EXPECT_EQ(round.islands.count(), 2u);
    EXPECT_EQ(round.repeats(), 1u);
    EXPECT_FALSE(round.all_answered());
    answer(round, {0, 9, 10});
    EXPECT_FALSE(planner.some_touched(round));
    const Tick before = planner.length();
    planner.committed(round);
    EXPECT_LT(planner.length(), before) << "shorter windows need fewer repeats";
}

/// The length of a window after three windows of one pile, stepped by one Simulator with `threads` threads.
Tick length_for_a_pile(std::size_t robots, std::uint32_t threads) {
    World world = empty_world(1e-3);
    for (std::size_t i = 0; i < robots; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{0.15 * static_cast<double>(i), 0, 1}, {}});
    const Simulation sim(world);
    bool is_new = false;
    Roster roster;
    (void)roster.seat_for(kFirst, {0, threads, ""}, 0, is_new);
    const CostModel costs(*sim.model);
    OrderLog order_log;
    WindowPlanner planner(sim.model, {}, sim.states, roster, costs, order_log);
    const StateDirectory directory(robots, 0);
    for (std::uint64_t window = 1; window <= 3; ++window) {
        const Round round = planner.plan(0, window, {1000, {}}, directory);
        EXPECT_EQ(round.islands.largest(), robots);
        planner.committed(round);
    }
    return planner.length();
}

TEST(WindowsOfAPile, AreShortOnlyWhereItsThreadsDoNotShareIt) {
    EXPECT_EQ(length_for_a_pile(100, 2), length_for_a_pile(100, 1));
    EXPECT_LT(length_for_a_pile(50, 2), length_for_a_pile(50, 1));
}

}  // namespace
}  // namespace roboss::test
