// The messages of RoboCup's Small Size League as plain data and as bytes: commands of grSim and of the
// league's simulation protocol, the vision of ssl-vision; and the kinematics of a robot with four
// omnidirectional wheels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <roboss/app/worlds/ssl_field.h>
#include "pitch.h"

namespace soccer::ssl {

/// Speeds of wheel1 ... wheel4, rad/s: positive ones turn the robot to the left.
using Wheels = std::array<double, 4>;

/// In m/s and rad/s, in the axes of the robot (x forwards) or of the field.
struct Velocity {
    double x = 0, y = 0, turn = 0;
    bool in_field_axes = false;
    friend bool operator==(const Velocity&, const Velocity&) = default;
};

/// Of a robot with heading `yaw`.
Velocity in_robot_axes(const Velocity& velocity, double yaw);
/// The speeds of wheels that roll without slip, and back (least squares). Velocities in the axes of the
/// robot.
Wheels wheels_of(const Velocity& velocity);
Velocity velocity_of(const Wheels& wheels);
/// The way from `now` to `wish` that tyres and motors bear in `time_s`: at 3 m/s2 and 20 rad/s2.
Velocity eased(const Velocity& now, const Velocity& wish, double time_s);

/// What is asked of a robot; what is missing stays as it is.
struct Command {
    Team team = Team::kBlue;
    std::uint32_t robot = 0;
    std::variant<std::monostate, Wheels, Velocity> motion;
    double kick_ahead = 0, kick_up = 0;  // m/s, of the ball relative to the robot; 0: no kick
    std::optional<double> dribbler;      // rad/s
};

/// Where a robot is put; a coordinate that is missing stays as it is.
struct Placement {
    Team team = Team::kBlue;
    std::uint32_t robot = 0;
    std::optional<double> x, y, yaw;  // m, rad
    double vx = 0, vy = 0, turn = 0;  // m/s, rad/s
};

/// Where the ball is put, likewise.
struct BallPlacement {
    std::optional<double> x, y, z;
    double vx = 0, vy = 0, vz = 0;
    bool rolls = false;
};

/// An error for the sender of a command, as the simulation protocol has it.
struct Problem {
    std::string code, text;
};

struct Packet {
    std::vector<Command> commands;
    std::vector<Placement> robots;
    std::optional<BallPlacement> ball;
    std::vector<Problem> problems;
};

// Nothing if the bytes are no such message, or a number in it is not finite or no angle (is_angle).
std::optional<Packet> packet_of_grsim(std::string_view bytes);                     // grSim_Packet
std::optional<Packet> packet_of_robot_control(std::string_view bytes, Team team);  // RobotControl
std::optional<Packet> packet_of_simulator(std::string_view bytes);                 // SimulatorCommand

/// RobotControlResponse: the robots of a team that have the ball at the dribbler, by number.
std::string response_to_team(const std::vector<Problem>& problems, const std::vector<bool>& has_ball);
/// SimulatorResponse.
std::string response_to_simulator(const std::vector<Problem>& problems);

/// What the camera saw.
struct Sight {
    std::uint32_t frame = 0;
    double captured_s = 0, sent_s = 0;
    Mover ball;
    double ball_z = 0;
    std::array<std::vector<Mover>, 2> robots;  // by team and number
};

/// SSL_WrapperPacket, with the geometry if there is a field.
std::string bytes_of(const Sight& sight, const SslField* field);

}  // namespace soccer::ssl
