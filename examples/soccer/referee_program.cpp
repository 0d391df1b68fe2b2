// The referee as a control program: `roboss run soccer.sdf --client roboss_soccer_referee.so ...`
// (docs/soccer.md). It prints a JSON line for each decision, and writes the last one to ROBOSS_SOCCER_RESULT.
#include <cstdio>
#include <optional>
#include <sstream>
#include <utility>

#include <roboss/client/control_program.h>
#include "../result_file.h"
#include "core/fixed_math.h"
#include "referee.h"

namespace soccer {
namespace {

constexpr const char* kResult = "ROBOSS_SOCCER_RESULT";

Scene scene_of(roboss::Client& client, const Pitch& pitch) {
    const auto mover = [&](roboss::RobotId robot) {
        const roboss::Vec3 p = client.pose(robot, roboss::LinkId(0u)).p;
        return Mover{p.x, p.y};
    };
    const roboss::Vec3 ball = client.pose(pitch.ball, roboss::LinkId(0u)).p;
    Scene scene{client.time_s(), ball.x, ball.y, ball.z, {}};
    for (std::size_t team = 0; team < 2; ++team)
        for (const roboss::RobotId robot : pitch.robots[team]) scene.robots[team].push_back(mover(robot));
    return scene;
}

class RefereeProgram final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame, -1, true}; }

    void start(roboss::Client& client) override {
        examples::check_result_file(kResult);
        pitch_ = Pitch::of(client);
        referee_.emplace(pitch_.field, half_length_s());
    }

    void control(roboss::Client& client) override {
        // Orders take effect a frame later: until then the ball is still where the last decision was made.
        if (std::exchange(skip_, false)) return;
        const Scene scene = scene_of(client, pitch_);
        for (const Decision& decision : referee_->look(scene)) {
            report(scene, decision);
            if (decision.call == Call::kGoal) show_goal(client, decision.team);
            if (const auto restart = referee_->restart_of(decision, scene)) {
                put(client, *restart);
                skip_ = true;
            }
        }
    }

    std::string memory() const override {
        const MatchState& s = referee_->state;
        std::ostringstream text;
        text << static_cast<int>(s.phase) << ' ' << s.score[0] << ' ' << s.score[1] << ' ' << skip_;
        char number[40];
        for (const double value :
             {s.rest_x, s.rest_y, s.rest_since, s.area_since, s.crowd_since, s.attackers_since}) {
            std::snprintf(number, sizeof number, " %.17g", value);
            text << number;
        }
        return text.str();
    }
    void restore(const std::string& memory) override {
        MatchState& s = referee_->state;
        std::istringstream text(memory);
        int phase = 0;
        text >> phase >> s.score[0] >> s.score[1] >> skip_;
        text >> s.rest_x >> s.rest_y >> s.rest_since >> s.area_since >> s.crowd_since >> s.attackers_since;
        s.phase = static_cast<MatchState::Phase>(phase);
    }

  private:
    void report(const Scene& scene, const Decision& decision) const;
    void show_goal(roboss::Client& client, Team team) const;
    void put(roboss::Client& client, const Restart& restart) const;
    void put_robot(roboss::Client& client, roboss::RobotId robot, const Stand& stand) const;

    Pitch pitch_;
    std::optional<Referee> referee_;
    bool skip_ = false;  // the next look
};

void RefereeProgram::report(const Scene& scene, const Decision& decision) const {
    const MatchState& s = referee_->state;
    char line[200];
    std::snprintf(
        line, sizeof line,
        "{\"time_s\": %.3f, \"call\": \"%s\", \"team\": \"%s\", \"score\": {\"blue\": %d, \"yellow\": %d}}",
        scene.time_s, name_of(decision.call), name_of(decision.team), s.score[0], s.score[1]);
    std::printf("%s\n", line);
    std::fflush(stdout);
    if (decision.call == Call::kFullTime) examples::write_result(line, kResult);
}

/// The world may have no scoreboard; then the order is refused, and the score is in the log only.
void RefereeProgram::show_goal(roboss::Client& client, Team team) const {
    const int bead = referee_->state.score[static_cast<std::size_t>(team)] - 1;
    const auto board = client.model().find_robot("scoreboard");
    if (board && bead < kGoalBeads)
        (void)client.set_joint_state(*board, std::string(name_of(team)) + "_" + std::to_string(bead),
                                     {kBeadWay}, {0.0});
}

void RefereeProgram::put_robot(roboss::Client& client, roboss::RobotId robot, const Stand& stand) const {
    const double half = stand.yaw / 2;
    client.set_pose(robot, {{stand.x, stand.y, 0}, {roboss::fixed_cos(half), 0, 0, roboss::fixed_sin(half)}})
        .value();
    client.set_velocity(robot, {}, {}).value();
    for (const char* wheel : {"left", "right"}) client.set_joint_state(robot, wheel, {}, {0.0}).value();
}

void RefereeProgram::put(roboss::Client& client, const Restart& restart) const {
    for (std::size_t team = 0; team < 2; ++team)
        for (std::size_t i = 0; i < pitch_.robots[team].size(); ++i)
            put_robot(client, pitch_.robots[team][i], restart.robots[team][i]);
    client.set_pose(pitch_.ball, {{restart.ball_x, restart.ball_y, kBallRadius}, {}}).value();
    client.set_velocity(pitch_.ball, {}, {}).value();
}

}  // namespace
}  // namespace soccer

ROBOSS_CONTROL_PROGRAM(soccer::RefereeProgram)
