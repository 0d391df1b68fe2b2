// A team as a control program: it looks at the field sixty times a second, and sets the speeds of its wheels.
#pragma once

#include <stdexcept>
#include <vector>

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
        const auto camera = Camera::from_environment();
        if (!camera)
            throw std::runtime_error(
                "ROBOSS_SOCCER_CAMERA is no camera\n"
                "  remedy: give noise in mm and degrees, and a delay in ms: \"2 1 33\"");
        camera_ = *camera;
        half_s_ = half_length_s();
    }

    void control(roboss::Client& client) override {
        std::vector<WheelSpeeds> speeds(pitch_.of_team(kTeam).size());
        const double time_s = client.time_s();
        if (time_s < 2 * half_s_)
            speeds = kStrategy(see(client, pitch_, kTeam, camera_, side_of(kTeam, time_s >= half_s_)));
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const roboss::RobotId robot = pitch_.of_team(kTeam)[i];
            // Refused only if the Model changed under us; the next frame tries again.
            (void)client.set_joint(robot, "left", roboss::MotorMode::kVelocity,
                                   speeds[i].left / kWheelRadius);
            (void)client.set_joint(robot, "right", roboss::MotorMode::kVelocity,
                                   speeds[i].right / kWheelRadius);
        }
    }

  private:
    Pitch pitch_;
    Camera camera_;
    double half_s_ = 0;  // length of a half
};

}  // namespace soccer
