#include "firasim.h"

#include <cmath>

#include "firasim.pb.h"

namespace soccer::firasim {
namespace {

Team team_of(bool is_yellow) {
    return is_yellow ? Team::kYellow : Team::kBlue;
}

bool are_finite(std::initializer_list<double> values) {
    for (const double value : values)
        if (!std::isfinite(value)) return false;
    return true;
}

void write(const Mover& robot, std::uint32_t number, messages::FiraRobot& message) {
    message.set_robot_id(number);
    message.set_x(robot.x), message.set_y(robot.y), message.set_orientation(robot.yaw);
    message.set_vx(robot.vx), message.set_vy(robot.vy), message.set_vorientation(robot.turn);
}

void write(const Field& field, messages::FiraField& message) {
    message.set_width(2 * field.half_width), message.set_length(2 * field.half_length);
    message.set_goal_width(2 * field.half_goal), message.set_goal_depth(field.goal_depth);
    message.set_center_radius(field.circle);
    message.set_penalty_width(2 * field.penalty_half), message.set_penalty_depth(field.penalty_area_depth);
    message.set_penalty_point(field.penalty_mark);
}

}  // namespace

std::optional<Packet> packet_of(std::string_view bytes) {
    messages::FiraPacket message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return std::nullopt;
    Packet packet;
    for (const messages::FiraCommand& one : message.cmd().robot_commands()) {
        if (!are_finite({one.wheel_left(), one.wheel_right()})) return std::nullopt;
        packet.commands.push_back({team_of(one.yellowteam()), one.id(), one.wheel_left(), one.wheel_right()});
    }
    for (const messages::FiraRobotReplacement& one : message.replace().robots()) {
        const messages::FiraRobot& at = one.position();
        if (!are_finite({at.x(), at.y()}) || !is_angle(at.orientation())) return std::nullopt;
        packet.robots.push_back(
            {team_of(one.yellowteam()), at.robot_id(), {at.x(), at.y(), at.orientation()}});
    }
    if (message.replace().has_ball()) {
        const messages::FiraBallReplacement& ball = message.replace().ball();
        if (!are_finite({ball.x(), ball.y(), ball.vx(), ball.vy()})) return std::nullopt;
        packet.ball = {ball.x(), ball.y(), ball.vx(), ball.vy()};
    }
    return packet;
}

std::string bytes_of(const Environment& e) {
    messages::FiraEnvironment message;
    message.set_step(e.step);
    messages::FiraFrame& frame = *message.mutable_frame();
    messages::FiraBall& ball = *frame.mutable_ball();
    ball.set_x(e.ball.x), ball.set_y(e.ball.y), ball.set_z(e.ball_z);
    ball.set_vx(e.ball.vx), ball.set_vy(e.ball.vy);
    const auto& [blue, yellow] = e.robots;
    for (std::uint32_t i = 0; i < blue.size(); ++i) write(blue[i], i, *frame.add_robots_blue());
    for (std::uint32_t i = 0; i < yellow.size(); ++i) write(yellow[i], i, *frame.add_robots_yellow());
    write(e.field, *message.mutable_field());
    message.set_goals_blue(e.goals[0]), message.set_goals_yellow(e.goals[1]);
    return message.SerializeAsString();
}

}  // namespace soccer::firasim
