#include "ssl.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fixed_math.h"
#include "ssl.pb.h"

namespace soccer::ssl {
namespace {

constexpr double kDegree = roboss::kPi / 180;
constexpr double kAcceleration = 3, kTurnAcceleration = 20;  // m/s2, rad/s2
constexpr double kSpinner = 300;  // rad/s, of the dribbler when grSim's `spinner` is on

Team team_of(bool is_yellow) {
    return is_yellow ? Team::kYellow : Team::kBlue;
}

/// ParseFromArray prints a line for each message that lacks a field: this does not.
template <class Message>
bool parse(std::string_view bytes, Message& message) {
    return message.ParsePartialFromArray(bytes.data(), static_cast<int>(bytes.size())) &&
           message.IsInitialized();
}

bool is_finite(const std::optional<double>& value) {
    return !value || std::isfinite(*value);
}

template <class... Values>
bool all_finite(const Values&... values) {
    return (is_finite(values) && ...);
}

bool is_finite(const Command& c) {
    if (const auto* wheels = std::get_if<Wheels>(&c.motion))
        for (const double speed : *wheels)
            if (!std::isfinite(speed)) return false;
    const auto* velocity = std::get_if<Velocity>(&c.motion);
    return (velocity == nullptr || all_finite(velocity->x, velocity->y, velocity->turn)) &&
           all_finite(c.kick_ahead, c.kick_up, c.dribbler);
}

bool is_finite(const Packet& packet) {
    for (const Command& c : packet.commands)
        if (!is_finite(c)) return false;
    for (const Placement& p : packet.robots)
        if (!all_finite(p.x, p.y, p.vx, p.vy, p.turn) || !is_angle(p.yaw.value_or(0))) return false;
    const auto& b = packet.ball;
    return !b || all_finite(b->x, b->y, b->z, b->vx, b->vy, b->vz);
}

std::optional<Packet> checked(Packet packet) {
    if (!is_finite(packet)) return std::nullopt;
    return packet;
}

Command command_of(const messages::grSim_Robot_Command& message, Team team) {
    Command command{team, message.id(), {}, message.kickspeedx(), message.kickspeedz(), {}};
    if (message.wheelsspeed())
        command.motion = Wheels{message.wheel1(), message.wheel2(), message.wheel3(), message.wheel4()};
    else
        command.motion = Velocity{message.veltangent(), message.velnormal(), message.velangular()};
    command.dribbler = message.spinner() ? kSpinner : 0.0;
    return command;
}

Command command_of(const messages::RobotCommand& message, Team team) {
    Command command{team, message.id(), {}, 0, 0, {}};
    const messages::RobotMoveCommand& move = message.move_command();
    if (move.has_wheel_velocity()) {
        const auto& rims = move.wheel_velocity();
        Wheels wheels{rims.front_left(), rims.back_left(), rims.back_right(), rims.front_right()};
        for (double& wheel : wheels) wheel /= SslRobot::kWheelRadius;
        command.motion = wheels;
    } else if (move.has_local_velocity()) {
        const auto& v = move.local_velocity();
        command.motion = Velocity{v.forward(), v.left(), v.angular()};
    } else if (move.has_global_velocity()) {
        const auto& v = move.global_velocity();
        command.motion = Velocity{v.x(), v.y(), v.angular(), true};
    }
    const double angle = message.kick_angle() * kDegree;
    command.kick_ahead = message.kick_speed() * roboss::fixed_cos(angle);
    command.kick_up = message.kick_speed() * roboss::fixed_sin(angle);
    if (message.has_dribbler_speed()) command.dribbler = message.dribbler_speed() * 2 * roboss::kPi / 60;
    return command;
}

Placement placement_of(const messages::TeleportRobot& message) {
    Placement p{team_of(message.id().team() == messages::YELLOW), message.id().id(), {}, {}, {}, 0, 0, 0};
    if (message.has_x()) p.x = message.x();
    if (message.has_y()) p.y = message.y();
    if (message.has_orientation()) p.yaw = message.orientation();
    p.vx = message.v_x(), p.vy = message.v_y(), p.turn = message.v_angular();
    return p;
}

BallPlacement placement_of(const messages::TeleportBall& message) {
    BallPlacement b{{}, {}, {}, message.vx(), message.vy(), message.vz(), message.roll()};
    if (message.has_x()) b.x = message.x();
    if (message.has_y()) b.y = message.y();
    if (message.has_z()) b.z = message.z();
    return b;
}

/// What the bridge does not do, it says.
void note_what_is_left_out(const messages::SimulatorCommand& message, std::vector<Problem>& problems) {
    if (message.has_config())
        problems.push_back({"ROBOSS_CONFIG", "the world file configures the simulation: config is ignored"});
    const messages::SimulatorControl& control = message.control();
    if (control.has_simulation_speed())
        problems.push_back({"ROBOSS_SPEED", "set the speed with `roboss run --speed`, or on the page"});
    bool by_force = control.teleport_ball().by_force(), present = false;
    for (const messages::TeleportRobot& one : control.teleport_robot())
        by_force = by_force || one.by_force(), present = present || one.has_present();
    if (by_force)
        problems.push_back({"ROBOSS_BY_FORCE", "by_force is not supported: robots and ball are put"});
    if (present) problems.push_back({"ROBOSS_PRESENT", "robots stay on the field: present is ignored"});
}

template <class Response>
std::string bytes_with(Response response, const std::vector<Problem>& problems) {
    for (const Problem& problem : problems) {
        messages::SimulatorError& error = *response.add_errors();
        error.set_code(problem.code), error.set_message(problem.text);
    }
    return response.SerializeAsString();
}

float mm(double metres) {
    return static_cast<float>(1000 * metres);
}

void write(const Mover& robot, std::uint32_t number, messages::SSL_DetectionRobot& message) {
    message.set_confidence(1), message.set_robot_id(number);
    message.set_x(mm(robot.x)), message.set_y(mm(robot.y));
    message.set_orientation(static_cast<float>(robot.yaw));
    // There is no image: a pixel is a millimetre, as in grSim.
    message.set_pixel_x(message.x()), message.set_pixel_y(message.y());
    message.set_height(mm(SslRobot::kHeight));
}

void write(const SslField& f, messages::SSL_GeometryFieldSize& size) {
    const auto whole = [](double metres) { return static_cast<std::int32_t>(std::lround(1000 * metres)); };
    size.set_field_length(whole(2 * f.half_length)), size.set_field_width(whole(2 * f.half_width));
    size.set_goal_width(whole(2 * f.half_goal)), size.set_goal_depth(whole(f.goal_depth));
    size.set_boundary_width(whole(f.side_margin));
    size.set_penalty_area_depth(whole(f.defence_depth)),
        size.set_penalty_area_width(whole(2 * f.defence_half));
    const auto line = [&](const char* name, messages::SSL_FieldShapeType type, double x1, double y1,
                          double x2, double y2) {
        messages::SSL_FieldLineSegment& segment = *size.add_field_lines();
        segment.set_name(name), segment.set_type(type), segment.set_thickness(mm(kSslLine));
        segment.mutable_p1()->set_x(mm(x1)), segment.mutable_p1()->set_y(mm(y1));
        segment.mutable_p2()->set_x(mm(x2)), segment.mutable_p2()->set_y(mm(y2));
    };
    const double x = f.half_length, y = f.half_width, d = f.half_length - f.defence_depth, h = f.defence_half;
    line("TopTouchLine", messages::TopTouchLine, -x, y, x, y);
    line("BottomTouchLine", messages::BottomTouchLine, -x, -y, x, -y);
    line("LeftGoalLine", messages::LeftGoalLine, -x, -y, -x, y);
    line("RightGoalLine", messages::RightGoalLine, x, -y, x, y);
    line("HalfwayLine", messages::HalfwayLine, 0, -y, 0, y);
    line("CenterLine", messages::CenterLine, -x, 0, x, 0);
    line("LeftPenaltyStretch", messages::LeftPenaltyStretch, -d, -h, -d, h);
    line("RightPenaltyStretch", messages::RightPenaltyStretch, d, -h, d, h);
    line("LeftFieldLeftPenaltyStretch", messages::LeftFieldLeftPenaltyStretch, -x, -h, -d, -h);
    line("LeftFieldRightPenaltyStretch", messages::LeftFieldRightPenaltyStretch, -x, h, -d, h);
    line("RightFieldLeftPenaltyStretch", messages::RightFieldLeftPenaltyStretch, x, h, d, h);
    line("RightFieldRightPenaltyStretch", messages::RightFieldRightPenaltyStretch, x, -h, d, -h);
    messages::SSL_FieldCircularArc& circle = *size.add_field_arcs();
    circle.set_name("CenterCircle"), circle.set_type(messages::CenterCircle);
    circle.mutable_center()->set_x(0), circle.mutable_center()->set_y(0);
    circle.set_radius(mm(f.circle)), circle.set_thickness(mm(kSslLine));
    circle.set_a1(0), circle.set_a2(static_cast<float>(2 * roboss::kPi));
}

}  // namespace

Velocity in_robot_axes(const Velocity& velocity, double yaw) {
    if (!velocity.in_field_axes) return velocity;
    const double c = roboss::fixed_cos(yaw), s = roboss::fixed_sin(yaw);
    return {c * velocity.x + s * velocity.y, -s * velocity.x + c * velocity.y, velocity.turn};
}

// A wheel at the angle a rolls along (-sin a, cos a). There the robot moves by v + turn * lever along this
// direction.
Wheels wheels_of(const Velocity& velocity) {
    Wheels wheels{};
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const double a = SslRobot::kWheelAngles[i];
        wheels[i] = (-roboss::fixed_sin(a) * velocity.x + roboss::fixed_cos(a) * velocity.y +
                     SslRobot::kWheelLever * velocity.turn) /
                    SslRobot::kWheelRadius;
    }
    return wheels;
}

// The normal equations of wheels_of: the wheels lie alike on both sides, so x stands alone, and y and turn
// share a 2 x 2 matrix.
Velocity velocity_of(const Wheels& wheels) {
    double ss = 0, cc = 0, cl = 0, ll = 0, sr = 0, cr = 0, lr = 0;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const double s = -roboss::fixed_sin(SslRobot::kWheelAngles[i]),
                     c = roboss::fixed_cos(SslRobot::kWheelAngles[i]), l = SslRobot::kWheelLever,
                     rim = SslRobot::kWheelRadius * wheels[i];
        ss += s * s, cc += c * c, cl += c * l, ll += l * l;
        sr += s * rim, cr += c * rim, lr += l * rim;
    }
    const double determinant = cc * ll - cl * cl;
    return {sr / ss, (ll * cr - cl * lr) / determinant, (cc * lr - cl * cr) / determinant};
}

Velocity eased(const Velocity& now, const Velocity& wish, double time_s) {
    const double dx = wish.x - now.x, dy = wish.y - now.y, change = std::sqrt(dx * dx + dy * dy);
    const double part = change > kAcceleration * time_s ? kAcceleration * time_s / change : 1;
    const double turn = kTurnAcceleration * time_s;
    return {now.x + part * dx, now.y + part * dy, now.turn + std::clamp(wish.turn - now.turn, -turn, turn)};
}

std::optional<Packet> packet_of_grsim(std::string_view bytes) {
    messages::grSim_Packet message;
    if (!parse(bytes, message)) return std::nullopt;
    Packet packet;
    for (const auto& one : message.commands().robot_commands())
        packet.commands.push_back(command_of(one, team_of(message.commands().isteamyellow())));
    for (const auto& one : message.replacement().robots())
        packet.robots.push_back(
            {team_of(one.yellowteam()), one.id(), one.x(), one.y(), one.dir() * kDegree, 0, 0, 0});
    if (message.replacement().has_ball()) {
        const auto& ball = message.replacement().ball();
        BallPlacement& b = packet.ball.emplace();
        b.z = 0;  // on the ground, as grSim puts it
        if (ball.has_x()) b.x = ball.x();
        if (ball.has_y()) b.y = ball.y();
        b.vx = ball.vx(), b.vy = ball.vy();
    }
    return checked(std::move(packet));
}

std::optional<Packet> packet_of_robot_control(std::string_view bytes, Team team) {
    messages::RobotControl message;
    if (!parse(bytes, message)) return std::nullopt;
    Packet packet;
    for (const auto& one : message.robot_commands()) {
        if (!is_angle(one.kick_angle() * kDegree)) return std::nullopt;
        packet.commands.push_back(command_of(one, team));
    }
    return checked(std::move(packet));
}

std::optional<Packet> packet_of_simulator(std::string_view bytes) {
    messages::SimulatorCommand message;
    if (!parse(bytes, message)) return std::nullopt;
    Packet packet;
    for (const auto& one : message.control().teleport_robot())
        if (!one.by_force()) packet.robots.push_back(placement_of(one));
    const messages::SimulatorControl& control = message.control();
    if (control.has_teleport_ball() && !control.teleport_ball().by_force())
        packet.ball = placement_of(control.teleport_ball());
    note_what_is_left_out(message, packet.problems);
    return checked(std::move(packet));
}

std::string response_to_team(const std::vector<Problem>& problems, const std::vector<bool>& has_ball) {
    messages::RobotControlResponse response;
    for (std::uint32_t i = 0; i < has_ball.size(); ++i) {
        messages::RobotFeedback& feedback = *response.add_feedback();
        feedback.set_id(i), feedback.set_dribbler_ball_contact(has_ball[i]);
    }
    return bytes_with(std::move(response), problems);
}

std::string response_to_simulator(const std::vector<Problem>& problems) {
    return bytes_with(messages::SimulatorResponse{}, problems);
}

std::string bytes_of(const Sight& sight, const SslField* field) {
    messages::SSL_WrapperPacket packet;
    messages::SSL_DetectionFrame& frame = *packet.mutable_detection();
    frame.set_frame_number(sight.frame), frame.set_camera_id(0);
    frame.set_t_capture(sight.captured_s), frame.set_t_sent(sight.sent_s);
    messages::SSL_DetectionBall& ball = *frame.add_balls();
    ball.set_confidence(1), ball.set_x(mm(sight.ball.x)), ball.set_y(mm(sight.ball.y)),
        ball.set_z(mm(sight.ball_z));
    ball.set_pixel_x(ball.x()), ball.set_pixel_y(ball.y());
    const auto& [blue, yellow] = sight.robots;
    for (std::uint32_t i = 0; i < blue.size(); ++i) write(blue[i], i, *frame.add_robots_blue());
    for (std::uint32_t i = 0; i < yellow.size(); ++i) write(yellow[i], i, *frame.add_robots_yellow());
    if (field != nullptr) write(*field, *packet.mutable_geometry()->mutable_field());
    return packet.SerializeAsString();
}

}  // namespace soccer::ssl
