// `roboss check`: exit codes, the census and the JSON.
#include "app/commands/check_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/worlds/world_census.h"

namespace roboss {
namespace {

struct Outcome {
    int exit_code = -1;
    std::string printed;
};

Outcome check(const std::string& world_text, const std::vector<std::string>& more = {}) {
    std::string file = (std::filesystem::temp_directory_path() / "roboss-check-XXXXXX").string();
    const int handle = mkstemp(file.data());
    if (handle >= 0) close(handle);
    std::ofstream(file) << world_text;
    CLI::App app;
    Outcome outcome;
    add_check_command(app, outcome.exit_code);
    std::vector<std::string> arguments(more.rbegin(), more.rend());  // CLI11 takes them from the back
    arguments.push_back(file);
    arguments.push_back("check");
    testing::internal::CaptureStdout();
    app.parse(arguments);
    std::fflush(stdout);
    outcome.printed = testing::internal::GetCapturedStdout();
    std::filesystem::remove(file);
    return outcome;
}

std::string world(const std::string& mass) {
    const std::string link =
        "<link name='a'><inertial><mass>" + mass +
        "</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
        "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>"
        "<sensor name='g' type='gps'/></link>";
    return "<sdf version='1.9'><world name='two'><model name='x'>" + link + "</model><model name='y'>" +
           link +
           "</model><model name='floor'><static>1</static><link name='l'><collision "
           "name='c'><geometry><plane/></geometry>"
           "</collision></link></model></world></sdf>";
}

TEST(CheckCommand, ASoundWorldGivesZeroAndItsCensus) {
    const Outcome outcome = check(world("1"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.printed;
    std::set<std::string> words;
    std::istringstream text(outcome.printed);
    for (std::string word; text >> word;) words.insert(word);
    for (const char* counted : {"robots", "static", "plane,", "sphere", "gps"})
        EXPECT_TRUE(words.contains(counted)) << counted;
}

TEST(CheckCommand, AnErrorInTheWorldGivesOne) {
    const Outcome outcome = check(world("-1"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.printed.find("[bad-mass]"), std::string::npos) << outcome.printed;
}

TEST(CheckCommand, AFileThatCannotBeReadGivesOneAsInAllCommands) {
    EXPECT_EQ(check("<sdf").exit_code, 1);
}

TEST(CheckCommand, JsonHoldsTheSame) {
    const auto sound = nlohmann::json::parse(check(world("1"), {"--json"}).printed);
    EXPECT_EQ(sound.at("robots"), 2);
    EXPECT_EQ(sound.at("robot_types"), 1);
    EXPECT_EQ(sound.at("sensors").at("gps"), 2);
    EXPECT_EQ(sound.at("errors"), 0);
    EXPECT_EQ(sound.at("runs"), true);
    const auto report = nlohmann::json::parse(check(world("-1"), {"--json"}).printed);
    EXPECT_EQ(report.at("robots"), 0) << "left out";
    EXPECT_EQ(report.at("errors"), 2) << "what is wrong, and who is left out";
    EXPECT_EQ(report.at("runs"), true) << "the floor is left";
    EXPECT_EQ(report.at("diagnostics").at(0).at("code"), "bad-mass");
    EXPECT_EQ(report.at("diagnostics").at(0).at("line"), 1);
    EXPECT_EQ(report.at("diagnostics").at(0).at("left_out"), true);
}

std::string ball(const std::string& name, const std::string& inside) {
    return "<model name='" + name +
           "'><link name='a'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia>"
           "</inertial></link>" +
           inside + "</model>\n";
}

nlohmann::json check_models(const std::string& models) {
    const std::string text = "<sdf version='1.9'><world name='w'>\n" + models + "</world></sdf>";
    return nlohmann::json::parse(check(text, {"--json"}).printed);
}

TEST(CheckCommand, ListsTheCommandsOfEachTypeOfRobot) {
    const std::string moves =
        "<plugin filename='gz-sim-velocity-control-system' "
        "name='gz::sim::systems::VelocityControl'/>";
    const auto report = check_models(ball("x", moves) + ball("y", moves) + ball("z", ""));
    ASSERT_EQ(report.at("commands").size(), 1u);
    const auto& type = report.at("commands").at(0);
    EXPECT_EQ(type.at("robot"), "x");
    EXPECT_EQ(type.at("robots"), 2);
    EXPECT_EQ(type.at("commands").at(0).at("name"), "cmd_vel");
    EXPECT_EQ(type.at("commands").at(0).at("topic"), "/model/{model}/cmd_vel");
    EXPECT_EQ(type.at("commands").at(0).at("values").at(5).at("name"), "angular_z");
    EXPECT_EQ(type.at("commands").at(0).at("values").at(5).at("unit"), "rad/s");
}

TEST(CheckCommand, TypesWithTheSameNamesAreListedOnce) {
    std::string heavy = ball("y", "");
    heavy.replace(heavy.find("<mass>1"), 7, "<mass>2");
    const std::string text =
        "<sdf version='1.9'><world name='w'>\n" + ball("x", "") + heavy + "</world></sdf>";
    const auto report = nlohmann::json::parse(check(text, {"--json", "--names"}).printed);
    EXPECT_EQ(report.at("robot_types"), 2);
    ASSERT_EQ(report.at("names").size(), 1u);
    EXPECT_EQ(report.at("names").at(0).at("robots"), nlohmann::json({"x", "y"}));
}

TEST(CheckCommand, SaysWhatBecomesOfEachPlugin) {
    const std::string moves =
        "<plugin filename='gz-sim-velocity-control-system' "
        "name='gz::sim::systems::VelocityControl'/>";
    const std::string unknown = "<plugin filename='libmine.so' name='mine'/>";
    const auto report =
        check_models("<plugin filename='gz-sim-physics-system' name='gz::sim::systems::Physics'/>\n" +
                     ball("x", moves) + ball("y", moves) + ball("z", unknown));
    ASSERT_EQ(report.at("plugins").size(), 3u);
    const auto& physics = report.at("plugins").at(0);
    EXPECT_EQ(physics.at("fate"), "not needed");
    EXPECT_EQ(physics.at("in"), "world");
    EXPECT_EQ(physics.at("line"), 2);
    const auto& control = report.at("plugins").at(1);
    EXPECT_EQ(control.at("class"), "gz::sim::systems::VelocityControl");
    EXPECT_EQ(control.at("fate"), "runs");
    EXPECT_EQ(control.at("model"), "x");
    EXPECT_EQ(control.at("count"), 2) << "copies of a model";
    EXPECT_EQ(control.at("line"), 3);
    const auto& mine = report.at("plugins").at(2);
    EXPECT_EQ(mine.at("class"), "libmine.so");
    EXPECT_EQ(mine.at("fate"), "not run");
    EXPECT_FALSE(mine.at("reason").get<std::string>().empty());
}

TEST(CheckCommand, NamesTheSensorsThatGiveNoReadings) {
    const auto report = nlohmann::json::parse(check(world("1"), {"--json"}).printed);
    EXPECT_TRUE(report.at("sensors_without_readings").empty());
    const auto silent = check_models(
        "<model name='m'><link name='a'><sensor name='s' type='thermal_camera'/>"
        "</link></model>");
    EXPECT_EQ(silent.at("sensors_without_readings").at("thermal_camera"), 1) << silent;
}

TEST(CheckCommand, CountsTheRobotsOfTheRunAndTheSensorsOfStaticModels) {
    const std::string link =
        "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>";
    const auto report =
        check_models("<model name='parts'><link name='a'>" + link + "</link><link name='b'>" + link +
                     "</link></model><model name='post'><static>1</static><link name='l'>"
                     "<sensor name='g' type='gps'/></link></model>");
    EXPECT_EQ(report.at("robots"), 3) << "two parts that no joint connects, and the post, which senses";
    EXPECT_EQ(report.at("links"), 3);
    EXPECT_EQ(report.at("static_models"), 1);
    EXPECT_EQ(report.at("sensors").at("gps"), 1);
}

TEST(CheckCommand, PrintsALineForEachKindOfPluginAndForFindingsThatAreAlike) {
    std::string models;
    for (const std::string name : {"a", "b", "c", "d", "e"})
        models += ball(name, "<link name='b'/><joint name='j_" + name +
                                 "' type='fixed'><parent>a</parent><child>b</child>"
                                 "<physics><ode><cfm_damping>1</cfm_damping></ode></physics></joint>"
                                 "<plugin filename='libmine.so' name='" +
                                 name + "'/>");
    const std::string text = "<sdf version='1.9'><world name='w'>\n" + models + "</world></sdf>";
    const auto lines_with = [](const std::string& printed, const std::string& word) {
        std::size_t count = 0;
        std::istringstream in(printed);
        for (std::string line; std::getline(in, line);) count += line.find(word) != std::string::npos ? 1 : 0;
        return count;
    };
    const std::string printed = check(text).printed, all = check(text, {"--all"}).printed;
    EXPECT_EQ(lines_with(printed, "libmine.so"), 1u) << printed;
    EXPECT_EQ(lines_with(printed, "and 4 more:"), 1u) << printed;
    EXPECT_EQ(lines_with(printed, "is not run [plugin]"), 0u) << printed;
    EXPECT_EQ(lines_with(all, "is not run [plugin]"), 5u) << all;
    EXPECT_EQ(lines_with(printed, "[joint-physics]"), 1u) << printed;
    EXPECT_EQ(lines_with(printed, "(and 4 more like it)"), 1u) << printed;
    EXPECT_EQ(lines_with(all, "[joint-physics]"), 5u) << all;
}

TEST(CheckCommand, AWrongOptionIsRefused) {
    CLI::App app;
    int exit_code = 0;
    add_check_command(app, exit_code);
    EXPECT_THROW(app.parse("check world.sdf --jsn"), CLI::ParseError);
    EXPECT_THROW(app.parse("check"), CLI::ParseError);
}

std::string codes(const Outcome& outcome) {
    std::string text;
    const nlohmann::json report = nlohmann::json::parse(outcome.printed);
    for (const auto& d : report["diagnostics"]) text += d["code"].get<std::string>() + " ";
    return text;
}

TEST(CheckCommand, OnGroundMendsARobotThatStartsInTheGround) {
    const std::string ball =
        "<robot name='ball'><link name='l'><inertial><mass value='1'/>"
        "<inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' iyz='0'/></inertial>"
        "<collision><geometry><sphere radius='.5'/></geometry></collision></link></robot>";
    EXPECT_EQ(codes(check(ball, {"--json"})).find("start"), std::string::npos) << "it has no ground";
    const Outcome deep = check(ball, {"--json", "--ground"});
    EXPECT_EQ(deep.exit_code, 0) << "a warning";
    EXPECT_NE(codes(deep).find("start-overlap"), std::string::npos) << deep.printed;
    const Outcome stands = check(ball, {"--json", "--ground", "--on-ground"});
    EXPECT_EQ(codes(stands).find("start-overlap"), std::string::npos) << stands.printed;
    EXPECT_NE(codes(stands).find("start-on-ground"), std::string::npos) << stands.printed;
    EXPECT_NE(codes(check(ball, {"--json", "--on-ground"})).find("start-no-ground"), std::string::npos);
    EXPECT_EQ(check(ball, {"--json", "--fixed-base", "nobody"}).exit_code, 1);
}

TEST(CheckCommand, SaysWhatOfAFileOfRos2ControlHasNoEffect) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "roboss-check-drive.yaml";
    std::ofstream(file)
        << "controller_manager: {ros__parameters: {base: {type: "
           "diff_drive_controller/DiffDriveController}}}\n"
           "base: {ros__parameters: {left_wheel_names: [l], right_wheel_names: [r], wheel_separation: 1,\n"
           "  wheel_radius: 1, open_loop: true}}\n";
    const Outcome outcome = check(world("1"), {"--ros2-controllers", file.string()});
    std::filesystem::remove(file);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.printed;
    EXPECT_NE(outcome.printed.find(":3: open_loop of 'base' has no effect"), std::string::npos)
        << outcome.printed;
    EXPECT_NE(outcome.printed.find(":1: the controller 'base' has no effect: no robot has the joint 'l'"),
              std::string::npos)
        << outcome.printed;
}

}  // namespace
}  // namespace roboss
