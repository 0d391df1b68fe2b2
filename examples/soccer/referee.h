// The referee as a pure state machine: it takes the positions of the ball and the robots, and returns its
// decisions and the positions for a restart. The rules are those of FIRA MiroSot (docs/soccer.md lists them).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pitch.h"

namespace soccer {

enum class Call : int {
    kKickOff,   // at the start of a half, and after a goal for the other team
    kGoal,      // counted; a kick-off follows at once
    kFreeBall,  // the ball did not move for ten seconds, or it left the field
    kGoalKick,  // two attackers are in the goal area with the ball
    kPenalty,   // against a team whose goalkeeper keeps the ball in its goal area, or is not alone there
    kHalfTime,  // the teams change ends; a kick-off follows at once
    kFullTime,
};
const char* name_of(Call call);

/// Something that the referee called, for `team`: that has the kick-off, the goal, the goal kick or the
/// penalty kick.
struct Decision {
    Call call{};
    Team team = Team::kBlue;
};

/// Where everything stands after a decision, in the frame of the world.
struct Restart {
    double ball_x = 0, ball_y = 0;
    std::array<std::vector<Stand>, 2> robots;  // by team and number
};

/// What the referee looks at, in the frame of the world.
struct Scene {
    double time_s = 0;
    double ball_x = 0, ball_y = 0, ball_z = 0;
    std::array<std::vector<Mover>, 2> robots;
};

/// What the referee remembers.
struct MatchState {
    enum class Phase : int {
        kBeforeStart,  // -> kFirstHalf with the first look
        kFirstHalf,    // -> kSecondHalf at the half's end
        kSecondHalf,   // -> kOver at the half's end
        kOver,
    };
    Phase phase = Phase::kBeforeStart;
    std::array<int, 2> score{};
    double rest_x = 0, rest_y = 0, rest_since = 0;  // where the ball has been, about, since when
    // Ball in a goal area; with two defenders; with two attackers; negative: no.
    double area_since = -1, crowd_since = -1, attackers_since = -1;
};

class Referee {
  public:
    Referee(const Field& field, double half_s) : field_(field), half_s_(half_s) {}

    /// What happened since the last look; the last decision that has a restart is the one that counts.
    std::vector<Decision> look(const Scene& scene);
    /// Where everything is put for it; nothing after a goal (its kick-off puts all) and at the end.
    std::optional<Restart> restart_of(const Decision& decision, const Scene& scene) const;

    MatchState state;

  private:
    void look_for_time(const Scene& scene, std::vector<Decision>& decisions);
    bool look_for_goal(const Scene& scene, std::vector<Decision>& decisions);
    void look_for_standstill(const Scene& scene, std::vector<Decision>& decisions);
    bool look_at_goal_area(const Scene& scene, std::vector<Decision>& decisions);
    void begin_play(const Scene& scene, double ball_x, double ball_y);
    double side(Team team) const { return side_of(team, state.phase == MatchState::Phase::kSecondHalf); }
    Team defender_at(double x) const { return side(Team::kBlue) * x < 0 ? Team::kBlue : Team::kYellow; }
    Restart kick_off(Team team) const;
    Restart free_ball(const Scene& scene) const;
    Restart goal_kick(Team team) const;
    Restart penalty(Team team) const;
    Stand placed(Team team, Stand own) const;

    Field field_;
    double half_s_;
};

}  // namespace soccer
