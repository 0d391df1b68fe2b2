// A bridge for teams of RoboCup's Small Size League: it takes the commands of grSim and of the league's
// simulation protocol, and sends what ssl-vision sends (docs/soccer.md). A free-running Client: UDP is never
// reproducible.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <roboss/client/control_program.h>
#include "core/fixed_math.h"
#include "ssl.h"
#include "udp.h"

namespace soccer {
namespace {

constexpr int kGeometryEvery = 120;     // frames, as grSim
constexpr double kRecharge = 0.2;       // s, of a kicker
constexpr double kKickReach = 0.01;     // m, from the dribbler to a ball that can be kicked
constexpr double kMostKick = 10;        // m/s, as grSim's robots; the rules allow 6.5
constexpr double kMostDribbler = 1047;  // rad/s: 10000 revolutions per minute

constexpr std::array kWheelNames{"wheel1", "wheel2", "wheel3", "wheel4"};

/// The last command of a robot.
struct RobotMemory {
    roboss::RobotId id;
    std::variant<std::monostate, ssl::Wheels, ssl::Velocity> motion{};
    bool is_new = false;   // the wheels do not have it yet
    ssl::Velocity now{};   // what the wheels do, in the axes of the robot
    double charged_s = 0;  // when the kicker is ready
};

class SslBridge final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame, -1, false}; }
    void start(roboss::Client& client) override;
    void control(roboss::Client& client) override;

  private:
    void open_sockets();
    void find_robots(const roboss::Client& client);
    void receive(roboss::Client& client);
    void complain(const std::string& subject, const std::string& what);
    RobotMemory* robot(Team team, std::uint32_t number);
    void follow(roboss::Client& client, const ssl::Packet& packet);
    void obey(roboss::Client& client, const ssl::Command& command, RobotMemory& robot);
    void kick(roboss::Client& client, RobotMemory& robot, double ahead, double up) const;
    void put(roboss::Client& client, const ssl::Placement& placement, const RobotMemory& robot) const;
    void put_ball(roboss::Client& client, const ssl::BallPlacement& placement) const;
    void drive(roboss::Client& client, RobotMemory& robot) const;
    bool has_ball(const roboss::Client& client, roboss::RobotId robot) const;
    void show(roboss::Client& client);

    SslField field_;
    Camera camera_;
    Pitch pitch_;
    std::array<std::vector<RobotMemory>, 2> robots_;  // by team and number
    std::unique_ptr<UdpReceiver> grsim_, simulator_;
    std::array<std::unique_ptr<UdpReceiver>, 2> teams_;  // RobotControl, by team
    std::unique_ptr<UdpSender> vision_;
    std::deque<std::pair<double, std::string>> images_;  // when they are sent, s
    std::uint32_t frame_ = 0;
    std::set<std::string> complaints_;  // their subjects: a few, whatever the network sends
};

void SslBridge::start(roboss::Client& client) {
    camera_ = Camera::required();
    find_robots(client);
    if (!grsim_) open_sockets();
}

void SslBridge::find_robots(const roboss::Client& client) {
    const roboss::Model& model = client.model();
    pitch_ = {}, robots_ = {};
    for (const Team team : {Team::kBlue, Team::kYellow})
        for (int number = 0;; ++number) {
            const auto found = model.find_robot(std::string(name_of(team)) + "_" + std::to_string(number));
            if (!found) break;
            pitch_.robots[static_cast<std::size_t>(team)].push_back(*found);
            robots_[static_cast<std::size_t>(team)].push_back({*found, {}});
        }
    const auto ball = model.find_robot("ball");
    const SslField* field = ssl_field_for(static_cast<int>(robots_[0].size()));
    if (!ball || field == nullptr || robots_[0].size() != robots_[1].size())
        throw std::runtime_error(
            "this world has no \"ball\" and two teams \"blue_0\" ..., \"yellow_0\" ... of 6 or 11 robots\n"
            "  remedy: make a world with `roboss-world soccer --league ssl-b -o ssl.sdf`");
    for (const char* joint : {"wheel1", "wheel4", "dribbler"}) (void)client.joint_id(robots_[0][0].id, joint);
    pitch_.ball = *ball, field_ = *field;
}

void SslBridge::open_sockets() {
    const Address commands = Address::from_environment("ROBOSS_SOCCER_COMMANDS", {"127.0.0.1", 20011});
    const Address vision = Address::from_environment("ROBOSS_SOCCER_VISION", {"224.5.23.2", 10020});
    const Address control = Address::from_environment("ROBOSS_SOCCER_CONTROL", {"127.0.0.1", 10300});
    if (control.port > 65533)
        throw std::runtime_error("ROBOSS_SOCCER_CONTROL is " + control.text() +
                                 ", and the ports of the teams are one and two higher\n"
                                 "  remedy: give a port up to 65533");
    grsim_ = std::make_unique<UdpReceiver>(commands);
    simulator_ = std::make_unique<UdpReceiver>(control);
    for (int i = 0; i < 2; ++i)
        teams_[static_cast<std::size_t>(i)] =
            std::make_unique<UdpReceiver>(Address{control.ip, control.port + 1 + i});
    vision_ = std::make_unique<UdpSender>(vision, commands);
    std::fprintf(
        stderr,
        "soccer bridge: grSim commands at %s; simulation protocol at %s, blue at port %d, yellow at %d; "
        "vision to %s\n",
        commands.text().c_str(), control.text().c_str(), control.port + 1, control.port + 2,
        vision.text().c_str());
}

/// Once for each subject.
void SslBridge::complain(const std::string& subject, const std::string& what) {
    if (complaints_.insert(subject).second)
        std::fprintf(stderr, "soccer bridge: %s: ignored\n", what.c_str());
}

void SslBridge::control(roboss::Client& client) {
    receive(client);
    for (auto& team : robots_)
        for (RobotMemory& robot : team) drive(client, robot);
    show(client);
}

void SslBridge::receive(roboss::Client& client) {
    for (int n = 0; n < kDatagramsAtOnce; ++n) {
        const auto datagram = grsim_->receive();
        if (!datagram) break;
        if (const auto packet = ssl::packet_of_grsim(*datagram))
            follow(client, *packet);
        else
            complain("grSim", "a datagram is no grSim_Packet");
    }
    for (int n = 0; n < kDatagramsAtOnce; ++n) {
        const auto datagram = simulator_->receive();
        if (!datagram) break;
        const auto packet = ssl::packet_of_simulator(*datagram);
        if (packet) follow(client, *packet);
        simulator_->reply(ssl::response_to_simulator(
            packet ? packet->problems
                   : std::vector<ssl::Problem>{{"ROBOSS_NO_MESSAGE", "this is no SimulatorCommand"}}));
    }
    for (const Team team : {Team::kBlue, Team::kYellow}) {
        const auto index = static_cast<std::size_t>(team);
        for (int n = 0; n < kDatagramsAtOnce; ++n) {
            const auto datagram = teams_[index]->receive();
            if (!datagram) break;
            const auto packet = ssl::packet_of_robot_control(*datagram, team);
            if (packet) follow(client, *packet);
            std::vector<ssl::Problem> problems;
            if (!packet) problems.push_back({"ROBOSS_NO_MESSAGE", "this is no RobotControl"});
            std::vector<bool> balls;
            for (const RobotMemory& robot : robots_[index]) balls.push_back(has_ball(client, robot.id));
            teams_[index]->reply(ssl::response_to_team(problems, balls));
        }
    }
}

RobotMemory* SslBridge::robot(Team team, std::uint32_t number) {
    auto& robots = robots_[static_cast<std::size_t>(team)];
    return number < robots.size() ? &robots[number] : nullptr;
}

// Orders that are out of range are refused; the run reports each kind of refusal once.
void SslBridge::follow(roboss::Client& client, const ssl::Packet& packet) {
    for (const ssl::Command& command : packet.commands) {
        if (RobotMemory* one = robot(command.team, command.robot))
            obey(client, command, *one);
        else
            complain(name_of(command.team),
                     "there is no robot " + std::to_string(command.robot) + " of " + name_of(command.team));
    }
    for (const ssl::Placement& placement : packet.robots)
        if (const RobotMemory* one = robot(placement.team, placement.robot)) put(client, placement, *one);
    if (packet.ball) put_ball(client, *packet.ball);
}

void SslBridge::obey(roboss::Client& client, const ssl::Command& command, RobotMemory& robot) {
    if (command.motion.index() != 0) robot.motion = command.motion, robot.is_new = true;
    if (command.dribbler)
        (void)client.set_joint(robot.id, "dribbler", roboss::MotorMode::kVelocity,
                               std::clamp(*command.dribbler, -kMostDribbler, kMostDribbler));
    if (command.kick_ahead > 0 || command.kick_up > 0)
        kick(client, robot, std::clamp(command.kick_ahead, 0.0, kMostKick),
             std::clamp(command.kick_up, 0.0, kMostKick));
}

/// Wheels that were set hold their speeds. A velocity is approached as fast as the tyres bear without slip.
void SslBridge::drive(roboss::Client& client, RobotMemory& robot) const {
    ssl::Wheels wheels{};
    if (const auto* given = std::get_if<ssl::Wheels>(&robot.motion)) {
        if (!std::exchange(robot.is_new, false)) return;
        wheels = *given;
        robot.now = ssl::velocity_of(wheels);
    } else if (const auto* wish = std::get_if<ssl::Velocity>(&robot.motion)) {
        const roboss::Vec3 ahead = client.pose(robot.id, roboss::LinkId(0u)).R * roboss::Vec3{1, 0, 0};
        const ssl::Velocity next =
            ssl::eased(robot.now, ssl::in_robot_axes(*wish, roboss::fixed_atan2(ahead.y, ahead.x)), kFrame);
        if (next == robot.now) return;
        robot.now = next;
        wheels = ssl::wheels_of(next);
    } else {
        return;
    }
    for (std::size_t i = 0; i < wheels.size(); ++i)
        (void)client.set_joint(robot.id, kWheelNames[i], roboss::MotorMode::kVelocity, wheels[i]);
}

bool SslBridge::has_ball(const roboss::Client& client, roboss::RobotId robot) const {
    const roboss::Transform X_WR = client.pose(robot, roboss::LinkId(0u));
    const roboss::Vec3 p_WB = client.pose(pitch_.ball, roboss::LinkId(0u)).p;
    const roboss::Vec3 away = p_WB - X_WR.p, ahead = X_WR.R * roboss::Vec3{1, 0, 0};
    const double along = dot(away, ahead), aside = away.y * ahead.x - away.x * ahead.y;
    return along > 0 && along < SslRobot::kBallX + kKickReach &&
           std::fabs(aside) < SslRobot::kBarLength / 2 && p_WB.z < 2 * kBallRadius;
}

/// An impulse on the ball for one tick, and the opposite one on the robot: the ball then has the speed
/// relative to the robot that was asked for. What it had along the kick is taken away.
void SslBridge::kick(roboss::Client& client, RobotMemory& robot, double ahead, double up) const {
    if (client.time_s() < robot.charged_s || !has_ball(client, robot.id)) return;
    const roboss::Vec3 axis = client.pose(robot.id, roboss::LinkId(0u)).R * roboss::Vec3{1, 0, 0};
    const roboss::Vec3 relative = client.twist(pitch_.ball, roboss::LinkId(0u)).linear -
                                  client.twist(robot.id, roboss::LinkId(0u)).linear;
    const roboss::Vec3 gain = (ahead - dot(relative, axis)) * axis + roboss::Vec3{0, 0, up};
    const double dt = client.model().dt_s;
    const roboss::Vec3 force = kBallMass / dt * gain;
    if (!client.apply_wrench(pitch_.ball, "ball", force, {}, dt).ok()) return;
    (void)client.apply_wrench(robot.id, "chassis", -1.0 * force, {}, dt);
    robot.charged_s = client.time_s() + kRecharge;
}

void SslBridge::put(roboss::Client& client, const ssl::Placement& placement, const RobotMemory& robot) const {
    const roboss::Transform X_WR = client.pose(robot.id, roboss::LinkId(0u));
    const roboss::Vec3 ahead = X_WR.R * roboss::Vec3{1, 0, 0};
    const double half = placement.yaw.value_or(roboss::fixed_atan2(ahead.y, ahead.x)) / 2;
    (void)client.set_pose(robot.id, {{placement.x.value_or(X_WR.p.x), placement.y.value_or(X_WR.p.y), 0},
                                     {roboss::fixed_cos(half), 0, 0, roboss::fixed_sin(half)}});
    (void)client.set_velocity(robot.id, {placement.vx, placement.vy, 0}, {0, 0, placement.turn});
    const ssl::Wheels wheels =
        ssl::wheels_of(ssl::in_robot_axes({placement.vx, placement.vy, placement.turn, true}, 2 * half));
    for (std::size_t i = 0; i < wheels.size(); ++i)
        (void)client.set_joint_state(robot.id, kWheelNames[i], {}, {wheels[i]});
}

void SslBridge::put_ball(roboss::Client& client, const ssl::BallPlacement& placement) const {
    const roboss::Vec3 p = client.pose(pitch_.ball, roboss::LinkId(0u)).p;
    (void)client.set_pose(pitch_.ball, {{placement.x.value_or(p.x), placement.y.value_or(p.y),
                                         std::max(placement.z.value_or(p.z), kBallRadius)},
                                        {}});
    const double spin = placement.rolls ? 1 / kBallRadius : 0;
    (void)client.set_velocity(pitch_.ball, {placement.vx, placement.vy, placement.vz},
                              {-spin * placement.vy, spin * placement.vx, 0});
}

void SslBridge::show(roboss::Client& client) {
    const View view = see(client, pitch_, Team::kBlue, camera_, 1);
    const bool with_geometry = frame_ % kGeometryEvery == 0;
    const double now = client.time_s(), sent = now + camera_.delay_s;
    images_.emplace_back(sent, ssl::bytes_of({frame_++,
                                              now,
                                              sent,
                                              view.ball,
                                              client.pose(pitch_.ball, roboss::LinkId(0u)).p.z,
                                              {view.own, view.others}},
                                             with_geometry ? &field_ : nullptr));
    for (; !images_.empty() && images_.front().first <= now + 1e-9; images_.pop_front())
        vision_->send(images_.front().second);
}

}  // namespace
}  // namespace soccer

ROBOSS_CONTROL_PROGRAM(soccer::SslBridge)
