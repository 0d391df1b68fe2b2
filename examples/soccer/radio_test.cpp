// Commands over simulated radio: their bytes, their rate, robots that miss messages, and a match.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/worlds/soccer_world.h"
#include "client/plugin.h"
#include "radio_link.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace soccer {
namespace {

TEST(RadioLink, EachRobotFindsItsSpeedsInTheMessage) {
    const auto message = message_of({{1.234, -0.5}, {0, 9}, {-9, 0.001}});
    ASSERT_EQ(message.size(), 12u);
    EXPECT_EQ(speeds_in(message, 0)->left, 1.234);
    EXPECT_EQ(speeds_in(message, 0)->right, -0.5);
    EXPECT_EQ(speeds_in(message, 1)->right, kTopSpeed) << "no more than a robot does";
    EXPECT_EQ(speeds_in(message, 2)->left, -kTopSpeed);
    EXPECT_EQ(speeds_in(message, 2)->right, 0.001);
    EXPECT_FALSE(speeds_in(message, 3)) << "a message that is too short";
    EXPECT_FALSE(speeds_in(std::span(message).first(11), 2));
}

TEST(RadioLink, ATeamSendsAsOftenAsItsRateSays) {
    for (const int rate : {30, 45, 50, 60}) {
        int sent = 0;
        for (int frame = 0; frame < 600; ++frame) sent += is_time_to_send(frame * kFrame, rate) ? 1 : 0;
        EXPECT_EQ(sent, 10 * rate);
    }
}

TEST(RadioLink, ARateThatIsNoneIsRefused) {
    for (const char* text : {"29", "61", "fast", "60Hz", ""}) {
        ::setenv("ROBOSS_SOCCER_RADIO", text, 1);
        EXPECT_THROW((void)radio_rate_Hz(), std::runtime_error) << text;
    }
    ::setenv("ROBOSS_SOCCER_RADIO", "45", 1);
    EXPECT_EQ(radio_rate_Hz(), 45);
    ::unsetenv("ROBOSS_SOCCER_RADIO");
    EXPECT_EQ(radio_rate_Hz(), 60);
}

std::shared_ptr<const roboss::Model> radio_field(double loss) {
    roboss::Diagnostics diagnostics;
    const auto world =
        roboss::load_world_text(roboss::soccer_sdf({"small", true, loss}), "radio.sdf", {}, diagnostics);
    EXPECT_TRUE(diagnostics.items().empty());
    return roboss::compile(*world, {}, diagnostics);
}

/// Blue's station sends another speed in each frame: 1 mm/s more.
class Counter final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kFrame, -1, true}; }
    void control(roboss::Client& client) override {
        const double speed = std::round(client.time_s() / kFrame) / 1000;
        client.transmit("blue_station", kRadio, message_of({{speed, speed}, {speed, speed}, {speed, speed}}))
            .value();
    }
};

/// How many different commands blue_2 got in five seconds.
std::size_t commands_heard(double loss) {
    const auto model = radio_field(loss);
    std::vector<roboss::NamedProgram> programs;
    programs.push_back({"counter", std::make_unique<Counter>()});
    programs.push_back({"robots", roboss::load_control_program(ROBOSS_SOCCER_ROBOTS).value()});
    auto simulation = roboss::Simulation::create(model, {}, std::move(programs)).value();
    const std::size_t robot = model->find_robot("blue_2")->index(),
                      other = model->find_robot("yellow_2")->index();
    std::set<long> heard;
    long last = 0;
    for (int frame = 1; frame <= 300; ++frame) {
        EXPECT_TRUE(simulation->run_until(8 * frame).ok());
        const roboss::MotorSetpoint& motor = simulation->states()[robot].motors[0];
        const long now = std::lround(1000 * motor.target * kWheelRadius);
        EXPECT_GE(now, last) << "a robot that hears nothing keeps the last command";
        EXPECT_LT(now, frame) << "no command arrives before it was sent";
        last = now;
        if (now > 0) heard.insert(now);
        EXPECT_EQ(simulation->states()[other].motors[0].mode, roboss::MotorMode::kPassive)
            << "another channel";
    }
    return heard.size();
}

TEST(Radio, RobotsActOnWhatTheyHearAndKeepTheLastCommandOtherwise) {
    EXPECT_GE(commands_heard(0), 296u) << "of 300, and some are on their way";
    const std::size_t heard = commands_heard(0.4);
    EXPECT_GT(heard, 140u) << "180 are expected";
    EXPECT_LT(heard, 220u);
    EXPECT_EQ(commands_heard(1), 0u);
}

struct RadioMatch {
    std::uint64_t hash = 0;
    double driven = 0;  // m, of blue_1
};

RadioMatch play(std::size_t simulators) {
    ::setenv("ROBOSS_SOCCER_HALF", "300", 1);
    const auto model = radio_field(0.1);
    std::vector<roboss::NamedProgram> programs;
    for (const char* library :
         {ROBOSS_SOCCER_REFEREE, ROBOSS_SOCCER_BLUE, ROBOSS_SOCCER_YELLOW, ROBOSS_SOCCER_ROBOTS})
        programs.push_back({library, roboss::load_control_program(library).value()});
    roboss::SimulationOptions options;
    options.simulators = simulators;
    auto simulation = roboss::Simulation::create(model, options, std::move(programs)).value();
    const std::size_t robot = model->find_robot("blue_1")->index();
    RadioMatch match;
    for (int frame = 0; frame < 180; ++frame) {
        const roboss::Vec3 before = base_pose(simulation->states()[robot]).p;
        EXPECT_TRUE(simulation->run_until(8 * (frame + 1)).ok());
        match.driven += norm(base_pose(simulation->states()[robot]).p - before);
    }
    match.hash = simulation->hash();
    return match;
}

TEST(Radio, AMatchIsTheSameOnOneAndFourSimulators) {
    const RadioMatch one = play(1), four = play(4);
    EXPECT_EQ(one.hash, four.hash);
    EXPECT_GT(one.driven, 0.3) << "it plays";
}

}  // namespace
}  // namespace soccer
