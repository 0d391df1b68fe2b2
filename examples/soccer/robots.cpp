// What runs on the robots of a world with radio: each takes its wheel speeds from the last message that it
// heard. One program for both teams: `roboss run ... --client roboss_soccer_robots.so` (docs/soccer.md).
#include <stdexcept>

#include <roboss/client/control_program.h>
#include "radio_link.h"

namespace soccer {
namespace {

class Robots final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame / 4, -1, true}; }

    void start(roboss::Client& client) override {
        pitch_ = Pitch::of(client);
        if (!pitch_.stations[0] || !pitch_.stations[1])
            throw std::runtime_error(
                "this world has no \"blue_station\" and \"yellow_station\" that send commands by radio\n"
                "  remedy: make a world with `roboss-world soccer --radio -o soccer.sdf`");
    }

    void control(roboss::Client& client) override {
        for (const auto& team : pitch_.robots)
            for (std::size_t number = 0; number < team.size(); ++number) {
                std::optional<WheelSpeeds> speeds;
                for (const roboss::RadioMessage& message : client.received(team[number], kRadio))
                    if (const auto heard = speeds_in(message.payload, number)) speeds = heard;
                if (speeds) set_wheels(client, team[number], *speeds);
            }
    }

  private:
    Pitch pitch_;
};

}  // namespace
}  // namespace soccer

ROBOSS_CONTROL_PROGRAM(soccer::Robots)
