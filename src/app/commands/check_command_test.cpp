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

TEST(CheckCommand, AFileThatCannotBeReadGivesTwo) {
    EXPECT_EQ(check("<sdf").exit_code, 2);
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

TEST(CheckCommand, AWrongOptionIsRefused) {
    CLI::App app;
    int exit_code = 0;
    add_check_command(app, exit_code);
    EXPECT_THROW(app.parse("check world.sdf --jsn"), CLI::ParseError);
    EXPECT_THROW(app.parse("check"), CLI::ParseError);
}

}  // namespace
}  // namespace roboss
