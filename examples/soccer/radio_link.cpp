#include "radio_link.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace soccer {

std::vector<std::uint8_t> message_of(const std::vector<WheelSpeeds>& speeds) {
    std::vector<std::uint8_t> message;
    for (const WheelSpeeds& one : speeds)
        for (const double speed : {one.left, one.right}) {
            const auto mm = static_cast<std::uint16_t>(
                static_cast<std::int16_t>(std::lround(1000 * std::clamp(speed, -kTopSpeed, kTopSpeed))));
            message.push_back(static_cast<std::uint8_t>(mm & 0xFF));
            message.push_back(static_cast<std::uint8_t>(mm >> 8));
        }
    return message;
}

std::optional<WheelSpeeds> speeds_in(std::span<const std::uint8_t> message, std::size_t number) {
    if (message.size() < 4 * (number + 1)) return std::nullopt;
    const auto speed = [&](std::size_t at) {
        return static_cast<std::int16_t>(message[at] | message[at + 1] << 8) / 1000.0;
    };
    return WheelSpeeds{speed(4 * number), speed(4 * number + 2)};
}

int radio_rate_Hz() {
    const char* text = std::getenv("ROBOSS_SOCCER_RADIO");
    if (text == nullptr) return 60;
    const int rate = std::atoi(text);
    if (rate < 30 || rate > 60 || std::to_string(rate) != text)
        throw std::runtime_error(std::string("ROBOSS_SOCCER_RADIO is \"") + text +
                                 "\"\n  remedy: give the messages in a second as a whole number, 30 to 60");
    return rate;
}

bool is_time_to_send(double time_s, int rate_Hz) {
    const auto sent = [&](long frame) {
        return std::floor(static_cast<double>(frame * rate_Hz) * kFrame + 1e-9);
    };
    const long frame = std::lround(time_s / kFrame);
    return sent(frame) != sent(frame - 1);
}

void set_wheels(roboss::Client& client, roboss::RobotId robot, const WheelSpeeds& speeds) {
    (void)client.set_joint(robot, "left", roboss::MotorMode::kVelocity, speeds.left / kWheelRadius);
    (void)client.set_joint(robot, "right", roboss::MotorMode::kVelocity, speeds.right / kWheelRadius);
}

}  // namespace soccer
