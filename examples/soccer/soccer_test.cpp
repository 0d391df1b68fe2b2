// The laws in plain situations, the robots' speed, and matches of both teams on the committed field.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "client/plugin.h"
#include "core/fixed_math.h"
#include "referee.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace soccer {
namespace {

const Field& small_field() {
    return kFields[0];
}

/// Ball and robots as they stand for the kick-off of blue.
Scene kick_off_scene(Referee& referee) {
    Scene scene;
    const std::vector<Decision> decisions = referee.look(scene);
    const auto restart = referee.restart_of(decisions.at(0), scene);
    for (std::size_t team = 0; team < 2; ++team)
        for (const Stand& stand : restart->robots[team])
            scene.robots[team].push_back({stand.x, stand.y, stand.yaw});
    return scene;
}

TEST(Referee, AMatchBeginsWithAKickOffOfBlue) {
    Referee referee(small_field(), 300);
    const Scene scene;
    const auto decisions = referee.look(scene);
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_EQ(decisions[0].call, Call::kKickOff);
    EXPECT_EQ(decisions[0].team, Team::kBlue);
    const auto restart = referee.restart_of(decisions[0], scene);
    ASSERT_TRUE(restart);
    EXPECT_EQ(restart->ball_x, 0);
    for (const Stand& stand : restart->robots[0]) EXPECT_LT(stand.x, 0) << "blue plays towards +x";
    for (const Stand& stand : restart->robots[1])
        EXPECT_GT(std::hypot(stand.x, stand.y), small_field().circle);
}

TEST(Referee, AGoalCountsWhenTheWholeBallIsBehindTheLine) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.time_s = 1;
    scene.ball_x = small_field().half_length + 0.9 * kBallRadius;
    EXPECT_TRUE(referee.look(scene).empty());
    scene.ball_x = small_field().half_length + 1.1 * kBallRadius;
    const auto decisions = referee.look(scene);
    ASSERT_EQ(decisions.size(), 2u);
    EXPECT_EQ(decisions[0].call, Call::kGoal);
    EXPECT_EQ(decisions[0].team, Team::kBlue);
    EXPECT_EQ(decisions[1].call, Call::kKickOff);
    EXPECT_EQ(decisions[1].team, Team::kYellow);
    EXPECT_EQ(referee.state.score, (std::array<int, 2>{1, 0}));
}

TEST(Referee, TheTeamsChangeEndsAndTheSameGoalThenCountsForTheOther) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.time_s = 300;
    const auto half_time = referee.look(scene);
    ASSERT_EQ(half_time.size(), 2u);
    EXPECT_EQ(half_time[0].call, Call::kHalfTime);
    const auto restart = referee.restart_of(half_time[1], scene);
    ASSERT_TRUE(restart);
    for (const Stand& stand : restart->robots[0]) EXPECT_GT(stand.x, 0);
    scene.time_s = 301;
    scene.ball_x = small_field().half_length + 2 * kBallRadius;
    (void)referee.look(scene);
    EXPECT_EQ(referee.state.score, (std::array<int, 2>{0, 1}));
    scene.time_s = 600;
    ASSERT_EQ(referee.look(scene).size(), 1u);
    EXPECT_EQ(referee.state.phase, MatchState::Phase::kOver);
    scene.time_s = 700;
    EXPECT_TRUE(referee.look(scene).empty());
}

TEST(Referee, ABallThatNobodyMovesForTenSecondsIsAFreeBall) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.ball_x = 0.3, scene.ball_y = -0.5;
    scene.time_s = 1;
    EXPECT_TRUE(referee.look(scene).empty());
    scene.time_s = 10.9;
    EXPECT_TRUE(referee.look(scene).empty());
    scene.time_s = 11.1;
    const auto decisions = referee.look(scene);
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_EQ(decisions[0].call, Call::kFreeBall);
    const auto restart = referee.restart_of(decisions[0], scene);
    ASSERT_TRUE(restart);
    int near = 0;
    for (const auto& team : restart->robots)
        for (const Stand& stand : team) {
            const double d = std::hypot(stand.x - restart->ball_x, stand.y - restart->ball_y);
            near += d < 0.26 ? 1 : 0;
            EXPECT_GT(d, 0.24);
        }
    EXPECT_EQ(near, 2);
}

TEST(Referee, TwoDefendersInTheirGoalAreaWithTheBallCostAPenaltyKick) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.ball_x = -0.68, scene.ball_y = 0.1;
    scene.robots[0][2] = {-0.65, -0.1};
    for (scene.time_s = 1; scene.time_s < 1.9; scene.time_s += 0.1) EXPECT_TRUE(referee.look(scene).empty());
    scene.time_s = 2.2;
    const auto decisions = referee.look(scene);
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_EQ(decisions[0].call, Call::kPenalty);
    EXPECT_EQ(decisions[0].team, Team::kYellow);
    const auto restart = referee.restart_of(decisions[0], scene);
    ASSERT_TRUE(restart);
    EXPECT_NEAR(restart->ball_x, -(small_field().half_length - small_field().penalty_mark), 1e-12);
    int in_that_half = 0;
    for (const auto& team : restart->robots)
        for (const Stand& stand : team) in_that_half += stand.x < 0 ? 1 : 0;
    EXPECT_EQ(in_that_half, 2) << "the goalkeeper and the kicker";
}

TEST(Referee, TwoAttackersInTheGoalAreaWithTheBallGiveAGoalKick) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.ball_x = -0.68, scene.ball_y = 0.1;
    scene.robots[1][1] = {-0.65, -0.1}, scene.robots[1][2] = {-0.64, 0.2};
    for (scene.time_s = 1; scene.time_s < 1.9; scene.time_s += 0.1) EXPECT_TRUE(referee.look(scene).empty());
    scene.time_s = 2.2;
    const auto decisions = referee.look(scene);
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_EQ(decisions[0].call, Call::kGoalKick);
    EXPECT_EQ(decisions[0].team, Team::kBlue);
    const auto restart = referee.restart_of(decisions[0], scene);
    ASSERT_TRUE(restart);
    EXPECT_TRUE(in_goal_area(small_field(), restart->ball_x, restart->ball_y));
    EXPECT_LT(restart->ball_x, restart->robots[0][1].x);
    EXPECT_GT(restart->ball_x - restart->robots[0][0].x, kRobotSize / 2 + kBallRadius)
        << "free of the keeper";
    for (const Stand& stand : restart->robots[1]) EXPECT_GT(stand.x, 0) << "attackers wait in their half";
    scene.time_s = 2.3;
    EXPECT_TRUE(referee.look(scene).empty()) << "it is called once";
}

TEST(Referee, OneAttackerInTheGoalAreaIsNoGoalKick) {
    Referee referee(small_field(), 300);
    Scene scene = kick_off_scene(referee);
    scene.ball_x = -0.68, scene.ball_y = 0.1;
    scene.robots[1][1] = {-0.65, -0.1};
    for (scene.time_s = 1; scene.time_s < 9; scene.time_s += 0.1) EXPECT_TRUE(referee.look(scene).empty());
}

TEST(Referee, NobodyIsPutIntoAnotherRobotInAnyLeague) {
    for (const Field& field : kFields) {
        Referee referee(field, 300);
        for (const Call call : {Call::kKickOff, Call::kFreeBall, Call::kGoalKick, Call::kPenalty})
            for (const Team team : {Team::kBlue, Team::kYellow})
                for (const double sign : {-1.0, 1.0}) {
                    Scene scene;
                    scene.ball_x = sign, scene.ball_y = 1;
                    const auto restart = referee.restart_of({call, team}, scene);
                    std::vector<Stand> all{{restart->ball_x, restart->ball_y, 0}};
                    for (const auto& robots : restart->robots)
                        all.insert(all.end(), robots.begin(), robots.end());
                    for (std::size_t i = 0; i < all.size(); ++i)
                        for (std::size_t j = 0; j < i; ++j)
                            EXPECT_GT(std::hypot(all[i].x - all[j].x, all[i].y - all[j].y), 0.08)
                                << field.league << ' ' << name_of(call) << ' ' << i << ' ' << j;
                }
    }
}

std::shared_ptr<const roboss::Model> compiled_field() {
    roboss::Diagnostics diagnostics;
    const auto world = roboss::load_world(ROBOSS_WORLDS "/soccer.sdf", {}, diagnostics);
    auto model = world ? roboss::compile(*world, {}, diagnostics) : nullptr;
    for (const roboss::Diagnostic& finding : diagnostics.items()) ADD_FAILURE() << to_text(finding);
    return model;
}

/// Drives blue_1 along the free lane at y = 0.45 m as fast as it goes.
class Sprint final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame, 0, true}; }
    void control(roboss::Client& client) override {
        if (client.tick() == 0) client.set_pose("blue_1", {{-0.65, 0.45, 0}, {}}).value();
        for (const char* wheel : {"left", "right"})
            client.set_joint("blue_1", wheel, roboss::MotorMode::kVelocity, kTopSpeed / kWheelRadius).value();
    }
};

TEST(Robot, AcceleratesAsItsMotorsPushAndDoesNotSkid) {
    const auto model = compiled_field();
    std::vector<roboss::NamedProgram> programs;
    programs.push_back({"sprint", std::make_unique<Sprint>()});
    auto simulation = roboss::Simulation::create(model, {}, std::move(programs)).value();
    const roboss::RobotId robot = *model->find_robot("blue_1");
    ASSERT_TRUE(simulation->run_until(roboss::Tick(std::llround(0.5 / model->dt_s))).ok());
    const roboss::RobotState& state = simulation->states()[robot.index()];
    const roboss::Twist twist = roboss::link_twist(model->type_of(robot), state, roboss::LinkId(0u));
    // 2 * 0.03 N m / 22 mm push 0.5 kg, and 30 g that stand for the inertia of both wheels: 5.14 m/s2.
    EXPECT_GT(twist.linear.x, 0.97 * 5.14 * 0.5);
    EXPECT_LT(twist.linear.x, 1.01 * 5.14 * 0.5);
    EXPECT_LT(std::fabs(base_pose(state).p.y - 0.45), 0.01);
}

struct Played {
    std::uint64_t hash = 0;
    double farthest_x = 0, farthest_y = 0, driven = 0;  // m, of all robots
};

/// Both halves of a short match.
Played play(std::size_t simulators, double half_s) {
    ::setenv("ROBOSS_SOCCER_HALF", std::to_string(half_s).c_str(), 1);
    const auto model = compiled_field();
    std::vector<roboss::NamedProgram> programs;
    for (const char* library : {ROBOSS_SOCCER_REFEREE, ROBOSS_SOCCER_BLUE, ROBOSS_SOCCER_YELLOW})
        programs.push_back({library, roboss::load_control_program(library).value()});
    roboss::SimulationOptions options;
    options.simulators = simulators;
    auto simulation = roboss::Simulation::create(model, options, std::move(programs)).value();
    Played played;
    std::vector<roboss::RobotState> before = simulation->states();
    for (roboss::Tick tick = 96; static_cast<double>(tick) * model->dt_s <= 2 * half_s; tick += 96) {
        EXPECT_TRUE(simulation->run_until(tick).ok());
        const std::vector<roboss::RobotState>& now = simulation->states();
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (model->robots[i].name == "ball" || model->robots[i].name == "scoreboard") continue;
            const roboss::Vec3 p = base_pose(now[i]).p;
            played.farthest_x = std::max(played.farthest_x, std::fabs(p.x));
            played.farthest_y = std::max(played.farthest_y, std::fabs(p.y));
            played.driven += norm(p - base_pose(before[i]).p);
        }
        before = now;
    }
    played.hash = simulation->hash();
    return played;
}

TEST(Match, OfTwentySecondsIsTheSameOnOneAndFourSimulatorsAndStaysOnTheField) {
    const Played one = play(1, ROBOSS_SOCCER_SECONDS / 2), four = play(4, ROBOSS_SOCCER_SECONDS / 2);
    EXPECT_EQ(one.hash, four.hash);
    EXPECT_LT(one.farthest_x, small_field().half_length + small_field().goal_depth);
    EXPECT_LT(one.farthest_y, small_field().half_width);
    EXPECT_GT(one.driven, 0.5 * ROBOSS_SOCCER_SECONDS) << "six robots that play";
}

}  // namespace
}  // namespace soccer
