// Costs follow what Simulators report, speeds only the differences between them.
#include "roles/controller/cost_model.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr Tick kTicks = 10;

class TwoSimulators : public testing::Test {
  protected:
    TwoSimulators() {
        bool is_new = false;
        for (std::uint64_t i = 1; i <= 2; ++i)
            (void)roster.seat_for({Role::kSimulator, i}, {0, 1, ""}, 0, is_new);
    }
    static World balls() {
        World world = empty_world(1e-3);
        for (int i = 0; i < 4; ++i)
            place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
                  {{9.0 * i, 0, 1}, {}});
        return world;
    }
    /// Each robot is an island; robots 0 and 1 are at seat 0, the others at seat 1.
    void window(std::uint64_t first_ns, std::uint64_t second_ns) {
        Round round({0, 1, 0, kTicks, false}, 4);
        round.islands.robots = sim.ids;
        round.islands.offsets = {0, 1, 2, 3, 4};
        round.assign(round.islands, seats, seats, roster);
        for (std::size_t r = 0; r < 4; ++r) {
            round.outcome[r].cost_ns = seats[r] == 0 ? first_ns : second_ns;
            round.spend(seats[r], round.outcome[r].cost_ns);
        }
        costs.learn(round, roster);
    }

    const Simulation sim{balls()};
    Roster roster;
    CostModel costs{*sim.model};
    const std::vector<SeatId> seats{0, 0, 1, 1};
};

TEST_F(TwoSimulators, CostsAreGuessedUntilTheFirstWindow) {
    EXPECT_FALSE(costs.measured());
    EXPECT_GT(costs.costs()[0], 0);
    EXPECT_EQ(costs.even_share_ns(roster, kTicks), 0) << "a guess is no expectation";
    window(20'000, 40'000);
    EXPECT_TRUE(costs.measured());
    EXPECT_FLOAT_EQ(costs.costs()[0], 2'000);
    EXPECT_FLOAT_EQ(costs.costs()[3], 4'000);
    EXPECT_DOUBLE_EQ(costs.even_share_ns(roster, kTicks), 60'000);
    EXPECT_DOUBLE_EQ(roster.seat(0).rate, 1) << "the robots of the two may differ";
}

TEST_F(TwoSimulators, CostsFollowSlowlyAndAllTogetherChangeNoRate) {
    window(20'000, 20'000);
    window(40'000, 40'000);
    EXPECT_GT(costs.costs()[0], 2'000);
    EXPECT_LT(costs.costs()[0], 3'000);
    EXPECT_DOUBLE_EQ(roster.seat(0).rate, 1);
    for (int i = 0; i < 200; ++i) window(40'000, 40'000);
    EXPECT_NEAR(costs.costs()[0], 4'000, 1);
}

TEST_F(TwoSimulators, ASimulatorThatBecomesSlowerGetsALowerRateAndFewerRobots) {
    window(20'000, 20'000);
    EXPECT_EQ(costs.assign_recovered({{0, 1, 2, 3, 4}, sim.ids}, roster).size(), 4u);
    for (int i = 0; i < 300; ++i) window(20'000, 120'000);
    EXPECT_GT(roster.seat(0).rate, roster.seat(1).rate);
    EXPECT_NEAR(roster.seat(0).rate + roster.seat(1).rate, 2, 1e-9) << "relative to the mean";
    EXPECT_NEAR(roster.seat(1).spent_ns, 24'000, 10) << "CPU time per tick and thread";
    EXPECT_LT(roster.balance(), 1);
}

TEST_F(TwoSimulators, IslandsStayWhereTheyAreAndOnlyWorkersGetSome) {
    window(20'000, 20'000);
    const Islands islands{{0, 1, 2, 3, 4}, sim.ids};
    EXPECT_EQ(costs.assign_islands(islands, roster, seats, kTicks), seats);
    roster.seat(0).leaving = true;
    EXPECT_EQ(costs.assign_islands(islands, roster, seats, kTicks), std::vector<SeatId>(4, 1));
    EXPECT_EQ(costs.assign_recovered(islands, roster), std::vector<SeatId>(4, 1));
    EXPECT_EQ(costs.even_share_ns(roster, kTicks), 0) << "nobody to share with";
    roster.seat(1).alive = false;
    EXPECT_DEATH((void)costs.assign_islands(islands, roster, seats, kTicks), "0 workers");
}

}  // namespace
}  // namespace roboss::test
