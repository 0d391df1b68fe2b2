// How commands get to the robots in a world of `roboss-world soccer --radio`: the station of a team sends one
// message with the wheel speeds of all its robots, and each robot takes those of its number. A robot that
// misses a message keeps the speeds that it has.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "driving.h"

namespace soccer {

inline constexpr const char* kRadio = "radio";  // of stations and robots

/// Four bytes a robot, by number: the speeds of its left and its right wheel in mm/s, low byte first.
std::vector<std::uint8_t> message_of(const std::vector<WheelSpeeds>& speeds);
/// Those of robot `number`; nothing if the message ends before them.
std::optional<WheelSpeeds> speeds_in(std::span<const std::uint8_t> message, std::size_t number);

/// Messages in a second: ROBOSS_SOCCER_RADIO, 30 to 60; or 60.
/// @throws std::runtime_error if the variable is anything else.
int radio_rate_Hz();
/// Whether a team that looks at the field each frame sends in the frame at this time.
bool is_time_to_send(double time_s, int rate_Hz);

/// Sets the motors. An order is refused only if the Model changed.
void set_wheels(roboss::Client& client, roboss::RobotId robot, const WheelSpeeds& speeds);

}  // namespace soccer
