// The messages of FIRASim, the simulator of the IEEE Very Small Size league: what a team's program sends
// (Packet) and receives (Environment), as plain data and as bytes. The numbers of fields are those of its
// published message files (packages fira_message and fira_message.sim_to_ref).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pitch.h"

namespace soccer::firasim {

/// Speeds of the wheels of one robot, rad/s.
struct Command {
    Team team = Team::kBlue;
    std::uint32_t robot = 0;
    double left = 0, right = 0;
};

/// Where a robot is to be put, m and rad.
struct Placement {
    Team team = Team::kBlue;
    std::uint32_t robot = 0;
    Stand stand;
};

/// x, y, vx and vy of the ball, m and m/s.
struct BallPlacement {
    double x = 0, y = 0, vx = 0, vy = 0;
};

struct Packet {
    std::vector<Command> commands;
    std::vector<Placement> robots;
    std::optional<BallPlacement> ball;
};

/// Nothing if the bytes are no Packet, or a number in it is not finite or no angle (is_angle).
std::optional<Packet> packet_of(std::string_view bytes);

struct Environment {
    std::uint32_t step = 0;
    Mover ball;
    double ball_z = 0;
    std::array<std::vector<Mover>, 2> robots;  // by team and number
    Field field;
    std::array<std::uint32_t, 2> goals{};
};

std::string bytes_of(const Environment& environment);

}  // namespace soccer::firasim
