// A team as a control program: it looks at the field sixty times a second, and sets the speeds of its wheels,
// or in a world with radio sends them to its robots (radio_link.h).
#pragma once

#include <stdexcept>
#include <vector>

#include "radio_link.h"
#include "strategies.h"

namespace soccer {

using Strategy = std::vector<WheelSpeeds> (*)(const View&);

template <Team kTeam, Strategy kStrategy>
class TeamProgram final : public roboss::ControlProgram {
  public:
    /// An image that is old when it arrives is the same as orders that take effect later. start() reports a
    /// variable that describes no camera.
    roboss::ControlOptions options() const override {
        const auto camera = Camera::from_environment();
        return {kFrame, kFrame + (camera ? camera->delay_s : 0.0), true};
    }

    void start(roboss::Client& client) override {
        pitch_ = Pitch::of(client);
        camera_ = Camera::required();
        half_s_ = half_length_s();
        radio_Hz_ = radio_rate_Hz();
    }

    void control(roboss::Client& client) override {
        std::vector<WheelSpeeds> speeds(pitch_.of_team(kTeam).size());
        const double time_s = client.time_s();
        if (time_s < 2 * half_s_)
            speeds = kStrategy(see(client, pitch_, kTeam, camera_, side_of(kTeam, time_s >= half_s_)));
        if (const auto station = pitch_.stations[static_cast<std::size_t>(kTeam)]) {
            // Refused only if the Model changed under us; the next frame tries again.
            if (is_time_to_send(time_s, radio_Hz_))
                (void)client.transmit(*station, kRadio, message_of(speeds));
            return;
        }
        for (std::size_t i = 0; i < speeds.size(); ++i)
            set_wheels(client, pitch_.of_team(kTeam)[i], speeds[i]);
    }

  private:
    Pitch pitch_;
    Camera camera_;
    double half_s_ = 0;  // length of a half
    int radio_Hz_ = 60;  // messages in a second
};

}  // namespace soccer
