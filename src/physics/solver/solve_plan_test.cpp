// The table of attempts, row by row.
#include "physics/solver/solve_plan.h"

#include <gtest/gtest.h>

#include <vector>

namespace roboss {
namespace {

using Attempts = std::vector<Attempt>;

Attempts attempts(const PartFacts& facts) {
    const std::span<const Attempt> all = plan_for(facts).attempts;
    return {all.begin(), all.end()};
}

TEST(SolvePlan, AFewRobotsAreSolvedByNewtonsMethodThenFromSweeps) {
    const Attempts few{Attempt::kNewton, Attempt::kSweeps, Attempt::kHardened};
    EXPECT_EQ(attempts({.robots = 1, .touches = true}), few);
    EXPECT_EQ(attempts({.robots = 3, .touches = true}), few);
    EXPECT_EQ(attempts({.robots = 8, .touches = true, .driven = true}), few);
    EXPECT_EQ(attempts({.robots = 100}), few) << "bonds alone are no pile";
}

TEST(SolvePlan, APileBeginsWithSweeps) {
    const Attempts pile{Attempt::kSweeps, Attempt::kHardened};
    EXPECT_EQ(attempts({.robots = 4, .touches = true}), pile);
    EXPECT_EQ(attempts({.robots = 9, .touches = true, .driven = true}), pile);
}

TEST(SolvePlan, DisplacementsOfAPileBeginWithTheRowsThatPushedLast) {
    const Attempts pile{Attempt::kActiveSet, Attempt::kNewton, Attempt::kHardened},
        few{Attempt::kNewton, Attempt::kHardened};
    EXPECT_EQ(attempts({.robots = 3, .touches = true, .displacement = true}), few);
    EXPECT_EQ(attempts({.robots = 4, .touches = true, .displacement = true}), pile);
}

TEST(SolvePlan, CoupledStepsAreShortenedWhereRobotsLeanOnEachOther) {
    EXPECT_EQ(plan_for({.robots = 1, .touches = true}).newton.halvings, 0);
    EXPECT_EQ(plan_for({.robots = 2, .touches = true}).newton.halvings, 3);
    EXPECT_EQ(plan_for({.robots = 4, .touches = true}).newton.checks, kPilePlan.checks);
}

}  // namespace
}  // namespace roboss
