// The Small Size League: messages as the published classes write them, the kinematics, and a team that
// drives, dribbles and kicks over UDP.
#include "ssl.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/worlds/soccer_world.h"
#include "client/plugin.h"
#include "core/fixed_math.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"
#include "ssl.pb.h"
#include "team_socket.h"

namespace soccer {
namespace {

// Written by the classes that protoc made of grSim's files (commit fe2bd29), with protobuf 4.25.
const std::string kGrsimCommands = from_hex(
    "0a6109000000000000000010001a1f080115000000001d00000000250000003f2d000080be350000004038014000"
    "1a33080215000040401d0000803f25000000002d000000003500000000380040014d0000803f55000000405d00004040"
    "6500008040");
const std::string kGrsimReplacement = from_hex(
    "12490a2409000000000000e03f11000000000000f0bf190000000000000040210000000000000000122109000000000000f03f"
    "1100000000000000c0190000000000805640200328013001");
const std::string kRobotControl = from_hex(
    "0a2408011211120f0d0000003f15000080be1d000000401d0000804025000034422d0080bb450a1a080212160a140d713d8a3e"
    "15713d0a3f1d295c4f3f25713d8a3f0a15080312111a0f0d0000803f15000000001d00000000");
const std::string kSimulatorCommand = from_hex(
    "0a2f0a110d0000003f15000080bf2500000040400112150a0408031001150000803f1d000000c0250000c03f1d000000401203"
    "20964e");

TEST(SslMessages, CommandsOfGrSimAreRead) {
    const auto packet = ssl::packet_of_grsim(kGrsimCommands);
    ASSERT_TRUE(packet);
    ASSERT_EQ(packet->commands.size(), 2u);
    const ssl::Command &first = packet->commands[0], &second = packet->commands[1];
    EXPECT_EQ(first.team, Team::kBlue);
    EXPECT_EQ(first.robot, 1u);
    EXPECT_EQ(std::get<ssl::Velocity>(first.motion), (ssl::Velocity{0.5, -0.25, 2}));
    EXPECT_GT(first.dribbler.value(), 0);
    EXPECT_EQ(first.kick_ahead, 0);
    EXPECT_EQ(std::get<ssl::Wheels>(second.motion), (ssl::Wheels{1, 2, 3, 4}));
    EXPECT_EQ(second.kick_ahead, 3);
    EXPECT_EQ(second.kick_up, 1);
    EXPECT_EQ(second.dribbler.value(), 0);
}

TEST(SslMessages, ReplacementsOfGrSimAreRead) {
    const auto packet = ssl::packet_of_grsim(kGrsimReplacement);
    ASSERT_TRUE(packet);
    ASSERT_EQ(packet->robots.size(), 1u);
    EXPECT_EQ(packet->robots[0].team, Team::kYellow);
    EXPECT_EQ(packet->robots[0].robot, 3u);
    EXPECT_NEAR(packet->robots[0].yaw.value(), roboss::kPi / 2, 1e-12) << "grSim has degrees";
    ASSERT_TRUE(packet->ball);
    EXPECT_EQ(packet->ball->y.value(), -1);
    EXPECT_EQ(packet->ball->vx, 2);
    EXPECT_EQ(packet->ball->z.value(), 0) << "grSim puts it on the ground";
}

TEST(SslMessages, CommandsOfTheSimulationProtocolAreRead) {
    const auto packet = ssl::packet_of_robot_control(kRobotControl, Team::kYellow);
    ASSERT_TRUE(packet);
    ASSERT_EQ(packet->commands.size(), 3u);
    const ssl::Command& first = packet->commands[0];
    EXPECT_EQ(first.team, Team::kYellow);
    EXPECT_EQ(std::get<ssl::Velocity>(first.motion), (ssl::Velocity{0.5, -0.25, 2}));
    EXPECT_NEAR(first.kick_ahead, 4 / std::sqrt(2), 1e-9);
    EXPECT_NEAR(first.kick_up, 4 / std::sqrt(2), 1e-9);
    EXPECT_NEAR(first.dribbler.value(), 200 * roboss::kPi, 1e-9) << "6000 revolutions per minute";
    const auto& wheels = std::get<ssl::Wheels>(packet->commands[1].motion);
    EXPECT_NEAR(wheels[0], 1.08 / 0.027, 1e-5) << "front left";
    EXPECT_NEAR(wheels[3], 0.27 / 0.027, 1e-5) << "front right";
    EXPECT_FALSE(packet->commands[1].dribbler) << "it stays as it is";
    EXPECT_EQ(std::get<ssl::Velocity>(packet->commands[2].motion), (ssl::Velocity{1, 0, 0, true}));
}

TEST(SslMessages, WhatTheSimulatorDoesNotDoItSays) {
    const auto packet = ssl::packet_of_simulator(kSimulatorCommand);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->robots.at(0).yaw.value(), 1.5);
    EXPECT_TRUE(packet->ball.value().rolls);
    EXPECT_FALSE(packet->ball->z);
    messages::SimulatorResponse response;
    ASSERT_TRUE(response.ParseFromString(ssl::response_to_simulator(packet->problems)));
    ASSERT_EQ(response.errors_size(), 2);
    EXPECT_EQ(response.errors(0).code(), "ROBOSS_CONFIG");
    EXPECT_EQ(response.errors(1).code(), "ROBOSS_SPEED");
}

TEST(SslMessages, DamagedBytesNeverCrashAndNumbersAreFinite) {
    EXPECT_FALSE(ssl::packet_of_grsim("\xff\xff\xff"));
    EXPECT_FALSE(ssl::packet_of_grsim(kGrsimCommands.substr(0, kGrsimCommands.size() - 1)));
    for (const std::string& good : {kGrsimCommands, kGrsimReplacement, kRobotControl, kSimulatorCommand})
        for (std::size_t i = 0; i < good.size(); ++i)
            for (const char other : {'\0', '\x7f', '\xff'}) {
                std::string bad = good;
                bad[i] = other;
                for (const auto& packet :
                     {ssl::packet_of_grsim(bad), ssl::packet_of_robot_control(bad, Team::kBlue),
                      ssl::packet_of_simulator(bad)}) {
                    if (!packet) continue;
                    for (const ssl::Command& command : packet->commands)
                        EXPECT_TRUE(std::isfinite(command.kick_ahead));
                    for (const ssl::Placement& placement : packet->robots)
                        EXPECT_TRUE(std::isfinite(placement.x.value_or(0)));
                }
            }
}

TEST(SslMessages, AnAngleFarBeyondATurnIsRefused) {
    messages::RobotControl control;
    messages::RobotCommand& kick = *control.add_robot_commands();
    kick.set_id(1), kick.set_kick_speed(1);
    messages::SimulatorCommand simulator;
    messages::TeleportRobot& turn = *simulator.mutable_control()->add_teleport_robot();
    turn.mutable_id()->set_id(1);
    messages::grSim_Packet grsim;
    messages::grSim_RobotReplacement& robot = *grsim.mutable_replacement()->add_robots();
    robot.set_x(0), robot.set_y(0), robot.set_id(1), robot.set_yellowteam(false);
    const auto taken = [&](double angle) {
        kick.set_kick_angle(static_cast<float>(angle)), turn.set_orientation(static_cast<float>(angle));
        robot.set_dir(angle);
        return std::array{ssl::packet_of_robot_control(control.SerializeAsString(), Team::kBlue).has_value(),
                          ssl::packet_of_simulator(simulator.SerializeAsString()).has_value(),
                          ssl::packet_of_grsim(grsim.SerializeAsString()).has_value()};
    };
    EXPECT_EQ(taken(-1e5), (std::array{true, true, true}));
    for (const double angle : {1e8, -1e30, HUGE_VAL})
        EXPECT_EQ(taken(angle), (std::array{false, false, false})) << angle;
}

TEST(SslKinematics, WheelsGiveTheVelocityBackAndAllTurnAlikeOnTheSpot) {
    const ssl::Velocity velocity{0.7, -0.4, 3};
    const ssl::Velocity back = ssl::velocity_of(ssl::wheels_of(velocity));
    EXPECT_NEAR(back.x, velocity.x, 1e-12);
    EXPECT_NEAR(back.y, velocity.y, 1e-12);
    EXPECT_NEAR(back.turn, velocity.turn, 1e-12);
    for (const double wheel : ssl::wheels_of({0, 0, 2})) EXPECT_NEAR(wheel, 2 * 0.08 / 0.027, 1e-12);
    EXPECT_NEAR(ssl::in_robot_axes({1, 0, 0, true}, roboss::kPi / 2).y, -1, 1e-12);
}

/// A world of division B with the bridge, and a team's program.
class SslMatch {
  public:
    SslMatch() {
        const int port = free_ports(3);
        control_port_ = port, grsim_port_ = TeamSocket().port();
        ::setenv("ROBOSS_SOCCER_COMMANDS", ("127.0.0.1:" + std::to_string(grsim_port_)).c_str(), 1);
        ::setenv("ROBOSS_SOCCER_CONTROL", ("127.0.0.1:" + std::to_string(port)).c_str(), 1);
        ::setenv("ROBOSS_SOCCER_VISION", ("127.0.0.1:" + std::to_string(vision_.port())).c_str(), 1);
        roboss::Diagnostics diagnostics;
        const auto world = roboss::load_world_text(roboss::soccer_sdf({"ssl-b"}), "ssl.sdf", {}, diagnostics);
        const auto model = roboss::compile(*world, {}, diagnostics);
        std::vector<roboss::NamedProgram> programs;
        programs.push_back({"bridge", roboss::load_control_program(ROBOSS_SOCCER_SSL_BRIDGE).value()});
        simulation_ = roboss::Simulation::create(model, {}, std::move(programs)).value();
    }

    /// Sends this message each frame until `done`. The bridge is free-running: it takes it when it gets to
    /// it.
    void send_until(const std::string& bytes, int port, const std::function<bool()>& done) {
        for (int tries = 0; tries < 1500 && !done(); ++tries) {
            team.send(bytes, port);
            frame_ += 8;
            ASSERT_TRUE(simulation_->run_until(frame_).ok());
            look();
        }
        EXPECT_TRUE(done());
    }

    int control_port() const { return control_port_; }
    int grsim_port() const { return grsim_port_; }
    const messages::SSL_DetectionRobot& blue(int i) const { return seen.detection().robots_blue(i); }
    const messages::SSL_DetectionBall& ball() const { return seen.detection().balls(0); }

    TeamSocket team;
    messages::SSL_WrapperPacket seen;
    messages::SSL_GeometryData geometry;
    messages::RobotControlResponse response;
    double ball_speed = 0;  // m/s, of the last two images

  private:
    static int free_ports(int count) {
        for (;;) {
            const int first = TeamSocket().port();
            bool all = first + count <= 65535;
            for (int i = 0; all && i < count; ++i) all = TeamSocket::is_free(first + i);
            if (all) return first;
        }
    }
    void look() {
        if (const std::string bytes = team.newest(); !bytes.empty()) (void)response.ParseFromString(bytes);
        const messages::SSL_WrapperPacket before = seen;
        const std::string bytes = vision_.newest();
        if (bytes.empty()) return;
        ASSERT_TRUE(seen.ParseFromString(bytes));
        if (seen.has_geometry()) geometry = seen.geometry();
        if (before.detection().balls_size() == 0) return;
        const double time = seen.detection().t_capture() - before.detection().t_capture();
        const auto& was = before.detection().balls(0);
        ball_speed = std::hypot(ball().x() - was.x(), ball().y() - was.y()) / 1000 / time;
    }

    TeamSocket vision_;
    int control_port_ = 0, grsim_port_ = 0;
    roboss::Tick frame_ = 0;
    std::unique_ptr<roboss::Simulation> simulation_;
};

TEST(SslBridge, ATeamOfTheSimulationProtocolDribblesBackwardsAndKicks) {
    SslMatch match;
    messages::SimulatorCommand put;
    messages::TeleportBall& ball = *put.mutable_control()->mutable_teleport_ball();
    ball.set_x(-0.095F), ball.set_y(0);  // 1 cm before blue_1
    match.send_until(put.SerializeAsString(), match.control_port(),
                     [&] { return match.seen.has_detection() && std::fabs(match.ball().x() + 95) < 2; });
    messages::RobotControl control;
    messages::RobotCommand& command = *control.add_robot_commands();
    command.set_id(1), command.set_dribbler_speed(3000);
    messages::MoveLocalVelocity& velocity = *command.mutable_move_command()->mutable_local_velocity();
    velocity.set_forward(0.2F), velocity.set_left(0), velocity.set_angular(0);
    const int blue = match.control_port() + 1;
    match.send_until(control.SerializeAsString(), blue, [&] {
        return match.response.feedback_size() == 6 && match.response.feedback(1).dribbler_ball_contact() &&
               match.blue(1).x() > -160;
    });
    velocity.set_forward(-0.5F);
    match.send_until(control.SerializeAsString(), blue, [&] { return match.blue(1).x() < -700; });
    EXPECT_NEAR(match.ball().x() - match.blue(1).x(), 94.5, 2)
        << "the ball's backspin holds it at the dribbler";
    EXPECT_NEAR(match.ball().y(), 0, 10);
    velocity.set_forward(0), command.set_kick_speed(4), command.set_dribbler_speed(0);
    match.send_until(control.SerializeAsString(), blue, [&] { return match.ball_speed > 2; });
    EXPECT_NEAR(match.ball_speed, 4, 0.8) << "it slides on the carpet at first";
    EXPECT_EQ(match.response.errors_size(), 0);
    EXPECT_EQ(match.geometry.field().field_length(), 9000);
    EXPECT_EQ(match.geometry.field().field_lines_size(), 12);
}

TEST(SslBridge, ATeamOfGrSimMovesSidewaysWithoutTurning) {
    SslMatch match;
    messages::grSim_Packet packet;
    messages::grSim_Commands& commands = *packet.mutable_commands();
    commands.set_timestamp(0), commands.set_isteamyellow(false);
    messages::grSim_Robot_Command& command = *commands.add_robot_commands();
    command.set_id(1), command.set_kickspeedx(0), command.set_kickspeedz(0), command.set_spinner(false);
    command.set_veltangent(0), command.set_velnormal(1), command.set_velangular(0);
    command.set_wheelsspeed(false);
    match.send_until(packet.SerializeAsString(), match.grsim_port(),
                     [&] { return match.seen.has_detection() && match.blue(1).y() > 800; });
    EXPECT_NEAR(match.blue(1).x(), -200, 20);
    EXPECT_NEAR(match.blue(1).orientation(), 0, 0.03);
    EXPECT_EQ(match.seen.detection().robots_yellow_size(), 6);
}

TEST(SslBridge, ABallKeepsTheCoordinatesThatAreMissing) {
    SslMatch match;
    messages::SimulatorCommand put;
    messages::TeleportBall& ball = *put.mutable_control()->mutable_teleport_ball();
    ball.set_x(1), ball.set_y(0.5F), ball.set_z(1);
    match.send_until(put.SerializeAsString(), match.control_port(),
                     [&] { return match.seen.has_detection() && match.ball().z() > 900; });
    ball.Clear(), ball.set_x(2);
    match.send_until(put.SerializeAsString(), match.control_port(), [&] { return match.ball().x() > 1500; });
    EXPECT_NEAR(match.ball().y(), 500, 2);
    EXPECT_GT(match.ball().z(), 500);
}

TEST(SslBridge, RobotsThatAreMissingAreReportedOncePerTeam) {
    SslMatch match;
    messages::RobotControl control;
    for (std::uint32_t number = 100; number < 200; ++number) control.add_robot_commands()->set_id(number);
    testing::internal::CaptureStderr();
    match.send_until(control.SerializeAsString(), match.control_port() + 1,
                     [&] { return match.response.feedback_size() == 6; });
    const std::string said = testing::internal::GetCapturedStderr();
    const std::size_t first = said.find("there is no robot 100 of blue");
    ASSERT_NE(first, std::string::npos) << said;
    EXPECT_EQ(said.find("there is no robot", first + 1), std::string::npos) << said;
}

}  // namespace
}  // namespace soccer
