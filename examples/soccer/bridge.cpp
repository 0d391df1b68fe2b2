// A bridge for teams of the Very Small Size league: it speaks FIRASim's protocol, so programs that were
// written for FIRASim drive robots here (docs/soccer.md). A free-running Client: UDP is never reproducible.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <roboss/client/control_program.h>
#include "core/fixed_math.h"
#include "firasim.h"
#include "udp.h"

namespace soccer {
namespace {

class Bridge final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame, -1, false}; }

    void start(roboss::Client& client) override {
        pitch_ = Pitch::of(client);
        const Address commands = Address::from_environment("ROBOSS_SOCCER_COMMANDS", {"127.0.0.1", 20011});
        const Address vision = Address::from_environment("ROBOSS_SOCCER_VISION", {"224.0.0.1", 10002});
        if (!commands_) commands_ = std::make_unique<UdpReceiver>(commands);
        if (!vision_) vision_ = std::make_unique<UdpSender>(vision, commands);
        std::fprintf(stderr, "soccer bridge: FIRASim commands at %s, vision to %s\n", commands.text().c_str(),
                     vision.text().c_str());
    }

    void control(roboss::Client& client) override {
        for (int n = 0; n < kDatagramsAtOnce; ++n) {
            const auto datagram = commands_->receive();
            if (!datagram) break;
            const auto packet = firasim::packet_of(*datagram);
            if (packet)
                follow(client, *packet);
            else if (!std::exchange(complained_, true))
                std::fprintf(stderr,
                             "soccer bridge: a datagram of %zu bytes is no Packet of FIRASim: ignored\n",
                             datagram->size());
        }
        vision_->send(firasim::bytes_of(environment(client)));
    }

  private:
    /// The robot that a message names; not valid: there is none.
    std::optional<roboss::RobotId> robot(Team team, std::uint32_t number) const {
        const auto& robots = pitch_.of_team(team);
        if (number >= robots.size()) return std::nullopt;
        return robots[number];
    }
    void follow(roboss::Client& client, const firasim::Packet& packet) const;
    firasim::Environment environment(roboss::Client& client) const;

    Pitch pitch_;
    std::unique_ptr<UdpReceiver> commands_;
    std::unique_ptr<UdpSender> vision_;
    bool complained_ = false;
};

// Orders that are out of range are refused; the run reports each kind of refusal once.
void Bridge::follow(roboss::Client& client, const firasim::Packet& packet) const {
    for (const firasim::Command& command : packet.commands)
        if (const auto id = robot(command.team, command.robot)) {
            (void)client.set_joint(*id, "left", roboss::MotorMode::kVelocity, command.left);
            (void)client.set_joint(*id, "right", roboss::MotorMode::kVelocity, command.right);
        }
    for (const firasim::Placement& one : packet.robots)
        if (const auto id = robot(one.team, one.robot)) {
            const double half = one.stand.yaw / 2;
            (void)client.set_pose(*id, {{one.stand.x, one.stand.y, 0},
                                        {roboss::fixed_cos(half), 0, 0, roboss::fixed_sin(half)}});
            (void)client.set_velocity(*id, {}, {});
        }
    if (packet.ball) {
        (void)client.set_pose(pitch_.ball, {{packet.ball->x, packet.ball->y, kBallRadius}, {}});
        (void)client.set_velocity(pitch_.ball, {packet.ball->vx, packet.ball->vy, 0}, {});
    }
}

firasim::Environment Bridge::environment(roboss::Client& client) const {
    const View view = see(client, pitch_, Team::kBlue, {}, 1);
    firasim::Environment e;
    e.step = static_cast<std::uint32_t>(client.tick());
    e.ball = view.ball, e.ball_z = kBallRadius;
    e.robots = {view.own, view.others};
    e.field = pitch_.field;
    if (const auto board = client.model().find_robot("scoreboard"))
        for (const Team team : {Team::kBlue, Team::kYellow})
            for (int i = 0; i < kGoalBeads; ++i)
                e.goals[static_cast<std::size_t>(team)] +=
                    client.joint(*board, std::string(name_of(team)) + "_" + std::to_string(i)).position >
                    kBeadWay / 2;
    return e;
}

}  // namespace
}  // namespace soccer

ROBOSS_CONTROL_PROGRAM(soccer::Bridge)
