#include "firasim.h"

#include <cmath>

#include "protobuf.h"

namespace soccer::firasim {
namespace {

using protobuf::Reader;
using protobuf::Writer;

Team team_of(const protobuf::Field& is_yellow) {
    return is_yellow.bits != 0 ? Team::kYellow : Team::kBlue;
}

bool read(std::string_view bytes, Command& command) {
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1) command.robot = static_cast<std::uint32_t>(field->bits);
        if (field->number == 2) command.team = team_of(*field);
        if (field->number == 6) command.left = field->real();
        if (field->number == 7) command.right = field->real();
    }
    return !reader.damaged() && std::isfinite(command.left) && std::isfinite(command.right);
}

bool read_position(std::string_view bytes, Placement& placement) {
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1) placement.robot = static_cast<std::uint32_t>(field->bits);
        if (field->number == 2) placement.stand.x = field->real();
        if (field->number == 3) placement.stand.y = field->real();
        if (field->number == 4) placement.stand.yaw = field->real();
    }
    return !reader.damaged() && std::isfinite(placement.stand.x) && std::isfinite(placement.stand.y) &&
           std::isfinite(placement.stand.yaw);
}

bool read(std::string_view bytes, Placement& placement) {
    Reader reader(bytes);
    bool ok = true;
    while (const auto field = reader.next()) {
        if (field->number == 1) ok = ok && read_position(field->bytes, placement);
        if (field->number == 5) placement.team = team_of(*field);
    }
    return ok && !reader.damaged();
}

bool read(std::string_view bytes, BallPlacement& ball) {
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1) ball.x = field->real();
        if (field->number == 2) ball.y = field->real();
        if (field->number == 3) ball.vx = field->real();
        if (field->number == 4) ball.vy = field->real();
    }
    return !reader.damaged() && std::isfinite(ball.x) && std::isfinite(ball.y) && std::isfinite(ball.vx) &&
           std::isfinite(ball.vy);
}

bool read_commands(std::string_view bytes, Packet& packet) {
    Reader reader(bytes);
    while (const auto field = reader.next())
        if (field->number == 1 && !read(field->bytes, packet.commands.emplace_back())) return false;
    return !reader.damaged();
}

bool read_replacement(std::string_view bytes, Packet& packet) {
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1 && !read(field->bytes, packet.ball.emplace())) return false;
        if (field->number == 2 && !read(field->bytes, packet.robots.emplace_back())) return false;
    }
    return !reader.damaged();
}

Writer robot_message(const Mover& robot, std::uint32_t number) {
    Writer message;
    message.uint(1, number).real(2, robot.x).real(3, robot.y).real(4, robot.yaw);
    message.real(5, robot.vx).real(6, robot.vy).real(7, robot.turn);
    return message;
}

}  // namespace

std::optional<Packet> packet_of(std::string_view bytes) {
    Packet packet;
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1 && !read_commands(field->bytes, packet)) return std::nullopt;
        if (field->number == 2 && !read_replacement(field->bytes, packet)) return std::nullopt;
    }
    if (reader.damaged()) return std::nullopt;
    return packet;
}

std::string bytes_of(const Environment& e) {
    Writer ball, frame, field, all;
    ball.real(1, e.ball.x)
        .real(2, e.ball.y)
        .real(3, e.ball_z)
        .real(4, e.ball.vx)
        .real(5, e.ball.vy)
        .real(6, 0);
    frame.message(1, ball);
    for (const Team team : {Team::kYellow, Team::kBlue}) {
        const auto& robots = e.robots[static_cast<std::size_t>(team)];
        for (std::uint32_t i = 0; i < robots.size(); ++i)
            frame.message(team == Team::kYellow ? 2 : 3, robot_message(robots[i], i));
    }
    field.real(1, 2 * e.field.half_width).real(2, 2 * e.field.half_length);
    field.real(3, 2 * e.field.half_goal).real(4, e.field.goal_depth);
    all.uint(1, e.step).message(2, frame).message(3, field).uint(4, e.goals[0]).uint(5, e.goals[1]);
    return all.bytes();
}

}  // namespace soccer::firasim
