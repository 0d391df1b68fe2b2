// FIRASim's messages, as its published classes write them, and a team that drives a robot over UDP.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "client/plugin.h"
#include "firasim.h"
#include "firasim.pb.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"
#include "team_socket.h"
#include "udp.h"

namespace soccer {
namespace {

// Written by the classes that protoc made of FIRASim's files (rsoccer-gym 1.4), with protobuf 3.19.
const std::string kCommands = from_hex(
    "0a300a000a140801310000000000003e40390000000000003e400a16080210013100000000000024c0390000000000002440");
const std::string kPlacements = from_hex(
    "12390a1209333333333333d33f119a9999999999d9bf12230a1d0802119a9999999999c9bf19333333333333d33f21182d4454fb"
    "21f9"
    "3f28013001");

TEST(FiraSim, ReadsCommandsOfThePublishedClasses) {
    const auto packet = firasim::packet_of(kCommands);
    ASSERT_TRUE(packet);
    ASSERT_EQ(packet->commands.size(), 3u);
    EXPECT_EQ(packet->commands[0].robot, 0u);
    EXPECT_EQ(packet->commands[1].robot, 1u);
    EXPECT_EQ(packet->commands[1].team, Team::kBlue);
    EXPECT_EQ(packet->commands[1].left, 30);
    EXPECT_EQ(packet->commands[2].team, Team::kYellow);
    EXPECT_EQ(packet->commands[2].left, -10);
    EXPECT_EQ(packet->commands[2].right, 10);
    EXPECT_FALSE(packet->ball);
}

TEST(FiraSim, ReadsPlacementsOfThePublishedClasses) {
    const auto packet = firasim::packet_of(kPlacements);
    ASSERT_TRUE(packet);
    ASSERT_TRUE(packet->ball);
    EXPECT_EQ(packet->ball->x, 0.3);
    EXPECT_EQ(packet->ball->y, -0.4);
    ASSERT_EQ(packet->robots.size(), 1u);
    EXPECT_EQ(packet->robots[0].team, Team::kYellow);
    EXPECT_EQ(packet->robots[0].robot, 2u);
    EXPECT_EQ(packet->robots[0].stand.y, 0.3);
}

TEST(FiraSim, DamagedBytesAreNoPacketAndNeverCrash) {
    EXPECT_FALSE(firasim::packet_of("\xff\xff\xff"));
    for (const std::string& good : {kCommands, kPlacements})
        for (std::size_t i = 0; i < good.size(); ++i) {
            (void)firasim::packet_of(good.substr(0, i));
            for (const char other : {'\0', '\x7f', '\xff'}) {
                std::string bad = good;
                bad[i] = other;
                (void)firasim::packet_of(bad);
            }
        }
    EXPECT_FALSE(firasim::packet_of(kCommands.substr(0, kCommands.size() - 1)));
}

TEST(FiraSim, AnAngleFarBeyondATurnIsRefused) {
    messages::FiraPacket message;
    messages::FiraRobot& robot = *message.mutable_replace()->add_robots()->mutable_position();
    robot.set_orientation(-1e5);
    EXPECT_TRUE(firasim::packet_of(message.SerializeAsString()));
    for (const double angle : {1e7, -1e300, HUGE_VAL}) {
        robot.set_orientation(angle);
        EXPECT_FALSE(firasim::packet_of(message.SerializeAsString())) << angle;
    }
}

TEST(Udp, AnAddressThatIsNoneLeavesNoSocketOpen) {
    const auto lowest_free = [] {
        const int descriptor = ::dup(0);
        ::close(descriptor);
        return descriptor;
    };
    const int before = lowest_free();
    EXPECT_THROW(UdpReceiver({"nonsense", 20011}), std::runtime_error);
    EXPECT_THROW(UdpSender({"nonsense", 20011}, {"127.0.0.1", 20011}), std::runtime_error);
    EXPECT_EQ(lowest_free(), before);
}

TEST(Bridge, ATeamElsewhereDrivesARobotAndSeesIt) {
    TeamSocket team;
    const int port = TeamSocket().port();  // free again
    ::setenv("ROBOSS_SOCCER_COMMANDS", ("127.0.0.1:" + std::to_string(port)).c_str(), 1);
    ::setenv("ROBOSS_SOCCER_VISION", ("127.0.0.1:" + std::to_string(team.port())).c_str(), 1);
    roboss::Diagnostics diagnostics;
    const auto world = roboss::load_world(ROBOSS_WORLDS "/soccer.sdf", {}, diagnostics);
    const auto model = roboss::compile(*world, {}, diagnostics);
    std::vector<roboss::NamedProgram> programs;
    programs.push_back({"bridge", roboss::load_control_program(ROBOSS_SOCCER_BRIDGE).value()});
    auto simulation = roboss::Simulation::create(model, {}, std::move(programs)).value();
    // The bridge is free-running: it drives when it gets to it, here within some frames.
    double speed = 0;
    messages::FiraEnvironment seen;
    for (int frame = 1; frame < 2000 && speed < 0.6; ++frame) {
        ASSERT_TRUE(simulation->run_until(8 * frame).ok());
        team.send(kCommands, port);
        const std::string newest = team.newest();
        if (newest.empty()) continue;
        ASSERT_TRUE(seen.ParseFromString(newest));
        ASSERT_EQ(seen.frame().robots_yellow_size(), 3);
        ASSERT_EQ(seen.frame().robots_blue_size(), 3);
        speed = seen.frame().robots_blue(1).vx();
    }
    EXPECT_NEAR(speed, 30 * kWheelRadius, 0.06);
    EXPECT_EQ(seen.field().width(), 1.3);
    EXPECT_EQ(seen.field().length(), 1.5);
}

}  // namespace
}  // namespace soccer
