#include "referee.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace soccer {
namespace {

constexpr double kStandstill = 10;        // s
constexpr double kStandstillRoom = 0.05;  // m, a ball that stays within has not moved
constexpr double kCrowd = 1;              // s that a second defender, or attacker, may be there with the ball
constexpr double kFreeBallRoom = 0.25;    // m, from the ball to each of the two robots

/// When a state began that `holds` now; negative: it does not.
double since(bool holds, double before, double now) {
    if (!holds) return -1;
    return before < 0 ? now : before;
}

}  // namespace

const char* name_of(Call call) {
    switch (call) {
        case Call::kKickOff:
            return "kick-off";
        case Call::kGoal:
            return "goal";
        case Call::kFreeBall:
            return "free ball";
        case Call::kGoalKick:
            return "goal kick";
        case Call::kPenalty:
            return "penalty kick";
        case Call::kHalfTime:
            return "half-time";
        case Call::kFullTime:
            return "full time";
    }
    return "";
}

std::vector<Decision> Referee::look(const Scene& scene) {
    std::vector<Decision> decisions;
    if (state.phase == MatchState::Phase::kOver) return decisions;
    look_for_time(scene, decisions);
    if (!decisions.empty() || look_for_goal(scene, decisions) || look_at_goal_area(scene, decisions))
        return decisions;
    look_for_standstill(scene, decisions);
    return decisions;
}

void Referee::begin_play(const Scene& scene, double ball_x, double ball_y) {
    state.rest_x = ball_x, state.rest_y = ball_y, state.rest_since = scene.time_s;
    state.area_since = state.crowd_since = state.attackers_since = -1;
}

void Referee::look_for_time(const Scene& scene, std::vector<Decision>& decisions) {
    using Phase = MatchState::Phase;
    if (state.phase == Phase::kBeforeStart) {
        state.phase = Phase::kFirstHalf;
        decisions.push_back({Call::kKickOff, Team::kBlue});
        begin_play(scene, 0, 0);
    } else if (state.phase == Phase::kFirstHalf && scene.time_s >= half_s_) {
        state.phase = Phase::kSecondHalf;
        decisions.push_back({Call::kHalfTime, Team::kYellow});
        decisions.push_back({Call::kKickOff, Team::kYellow});
        begin_play(scene, 0, 0);
    } else if (state.phase == Phase::kSecondHalf && scene.time_s >= 2 * half_s_) {
        state.phase = Phase::kOver;
        decisions.push_back(
            {Call::kFullTime, state.score[0] >= state.score[1] ? Team::kBlue : Team::kYellow});
    }
}

/// A goal counts when the whole ball has passed the goal line.
bool Referee::look_for_goal(const Scene& scene, std::vector<Decision>& decisions) {
    if (std::fabs(scene.ball_x) < field_.half_length + kBallRadius ||
        std::fabs(scene.ball_y) > field_.half_goal)
        return false;
    const Team against = defender_at(scene.ball_x);
    ++state.score[static_cast<std::size_t>(other(against))];
    decisions.push_back({Call::kGoal, other(against)});
    decisions.push_back({Call::kKickOff, against});
    begin_play(scene, 0, 0);
    return true;
}

bool Referee::look_at_goal_area(const Scene& scene, std::vector<Decision>& decisions) {
    if (!in_goal_area(field_, scene.ball_x, scene.ball_y)) {
        state.area_since = state.crowd_since = state.attackers_since = -1;
        return false;
    }
    const Team defender = defender_at(scene.ball_x);
    const auto is_there = [&](const Mover& robot) {
        return robot.x * scene.ball_x > 0 && in_goal_area(field_, robot.x, robot.y);
    };
    const auto count = [&](Team team) {
        const auto& robots = scene.robots[static_cast<std::size_t>(team)];
        return std::count_if(robots.begin(), robots.end(), is_there);
    };
    const double now = scene.time_s;
    state.area_since = since(true, state.area_since, now);
    state.crowd_since = since(count(defender) > 1, state.crowd_since, now);
    state.attackers_since = since(count(other(defender)) > 1, state.attackers_since, now);
    const auto too_long = [&](double began, double limit) { return began >= 0 && now - began > limit; };
    Decision decision;
    if (too_long(state.crowd_since, kCrowd) || now - state.area_since >= kStandstill)
        decision = {Call::kPenalty, other(defender)};
    else if (too_long(state.attackers_since, kCrowd))
        decision = {Call::kGoalKick, defender};
    else
        return false;
    decisions.push_back(decision);
    const Restart restart = *restart_of(decision, scene);
    begin_play(scene, restart.ball_x, restart.ball_y);
    return true;
}

void Referee::look_for_standstill(const Scene& scene, std::vector<Decision>& decisions) {
    const double margin = field_.goal_depth + 2 * kWallThickness;
    const bool is_out = std::fabs(scene.ball_x) > field_.half_length + margin ||
                        std::fabs(scene.ball_y) > field_.half_width + kBallRadius || scene.ball_z < 0;
    const double dx = scene.ball_x - state.rest_x, dy = scene.ball_y - state.rest_y;
    if (dx * dx + dy * dy > kStandstillRoom * kStandstillRoom)
        state.rest_x = scene.ball_x, state.rest_y = scene.ball_y, state.rest_since = scene.time_s;
    if (!is_out && scene.time_s - state.rest_since < kStandstill) return;
    decisions.push_back({Call::kFreeBall, Team::kBlue});
    const Restart restart = free_ball(scene);
    begin_play(scene, restart.ball_x, restart.ball_y);
}

std::optional<Restart> Referee::restart_of(const Decision& decision, const Scene& scene) const {
    switch (decision.call) {
        case Call::kKickOff:
            return kick_off(decision.team);
        case Call::kFreeBall:
            return free_ball(scene);
        case Call::kGoalKick:
            return goal_kick(decision.team);
        case Call::kPenalty:
            return penalty(decision.team);
        default:
            return std::nullopt;
    }
}

/// From the team's frame to that of the world.
Stand Referee::placed(Team team, Stand own) const {
    const double s = side(team);
    return {s * own.x, s * own.y, s > 0 ? own.yaw : roboss::wrap_angle(own.yaw + roboss::kPi)};
}

Restart Referee::kick_off(Team team) const {
    Restart restart;
    for (const Team each : {Team::kBlue, Team::kYellow})
        for (int i = 0; i < field_.robots; ++i)
            restart.robots[static_cast<std::size_t>(each)].push_back(
                placed(each, kick_off_stand(field_, i, each == team)));
    return restart;
}

/// On the mark of the quarter where the ball is; one robot of each team 25 cm from it, the others outside of
/// that quarter.
Restart Referee::free_ball(const Scene& scene) const {
    Restart restart;
    restart.ball_x = (scene.ball_x > 0 ? 0.5 : -0.5) * field_.half_length;
    restart.ball_y = (scene.ball_y > 0 ? 0.5 : -0.5) * field_.half_width;
    for (const Team each : {Team::kBlue, Team::kYellow}) {
        const double s = side(each), x = s * restart.ball_x, y = s * restart.ball_y;
        for (int i = 0; i < field_.robots; ++i) {
            Stand stand = kick_off_stand(field_, i, false);
            if (i == 1)
                stand = {x - kFreeBallRoom, y, 0};
            else if (stand.x * x > 0 && stand.y * y > 0)
                stand.x -= 0.11, stand.y = -stand.y;
            restart.robots[static_cast<std::size_t>(each)].push_back(placed(each, stand));
        }
    }
    return restart;
}

/// The ball lies before the goalkeeper, in its goal area; all others are in their own halves.
Restart Referee::goal_kick(Team team) const {
    Restart restart;
    restart.ball_x = side(team) * (0.6 * kRobotSize + 0.09 - field_.half_length);
    for (const Team each : {Team::kBlue, Team::kYellow})
        for (int i = 0; i < field_.robots; ++i)
            restart.robots[static_cast<std::size_t>(each)].push_back(
                placed(each, kick_off_stand(field_, i, false)));
    return restart;
}

/// On the mark before the goal; only the kicker and the goalkeeper are in that half.
Restart Referee::penalty(Team team) const {
    Restart restart;
    const double mark = field_.half_length - field_.penalty_mark;
    restart.ball_x = side(team) * mark;
    for (int i = 0; i < field_.robots; ++i) {
        Stand kicker = kick_off_stand(field_, i, false), defender = kicker;
        if (i == 1) {
            kicker = {mark - 0.12, 0, 0};
            defender = {0.3 * field_.half_length, 0.15, 0};
        } else if (i > 1) {
            defender.x =
                kicker.x < -0.5 * field_.half_length ? 0.2 * field_.half_length : 0.1 * field_.half_length;
        }
        restart.robots[static_cast<std::size_t>(team)].push_back(placed(team, kicker));
        restart.robots[static_cast<std::size_t>(other(team))].push_back(placed(other(team), defender));
    }
    return restart;
}

}  // namespace soccer
