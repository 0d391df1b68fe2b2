// Robots that start in each other and cannot get free: legs hooked into legs. What pushes them apart must not
// shake the pile that they lie in.
#include <gtest/gtest.h>

#include <cmath>

#include "local/local_run.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

std::unique_ptr<LocalRun> make_run(const std::string& file) {
    Diagnostics diagnostics;
    const std::optional<World> world = load_world(ROBOSS_SOURCE "/" + file, {}, diagnostics);
    const std::shared_ptr<const Model> model = world ? compile(*world, {}, diagnostics) : nullptr;
    if (!model) return nullptr;
    return std::move(LocalRun::create(model).value());
}

double fastest(const LocalRun& run) {
    double most = 0;
    for (const RobotState& state : run.states())
        for (const double v : state.v) most = std::max(most, std::fabs(v));
    return most;
}

/// m or rad that a coordinate of the bases or joints changes at most.
double largest_change(const std::vector<RobotState>& before, const std::vector<RobotState>& after) {
    double most = 0;
    for (std::size_t r = 0; r < before.size(); ++r)
        for (std::size_t i = 0; i < before[r].q.size(); ++i)
            most = std::max(most, std::fabs(after[r].q[i] - before[r].q[i]));
    return most;
}

TEST(StuckRobots, ComeToRestInAPile) {
    const std::unique_ptr<LocalRun> run = make_run("worlds/legged_pile.sdf");
    ASSERT_TRUE(run);
    ASSERT_TRUE(run->step(2000));  // until 1900 two legs sink against their damping
    double deepest = 0;
    for (const ContactReport& contact : run->contacts()) deepest = std::max(deepest, -contact.gap);
    EXPECT_GT(deepest, 1e-3) << "none is stuck: this world no longer tests it";
    EXPECT_LT(fastest(*run), 0.1);
    const std::vector<RobotState> before = run->states();
    ASSERT_TRUE(run->step());
    EXPECT_LT(largest_change(before, run->states()), 3e-4);
}

}  // namespace
}  // namespace roboss
