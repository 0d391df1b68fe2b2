// The profile of the steps as pages and `roboss control profile` get it.
#include "gateway/run_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace roboss {
namespace {

using Json = nlohmann::json;

RunProfile a_profile() {
    RunProfile p;
    p.ticks = 500;
    p.stages = {{"narrow phase", 0.25}, {"solve velocities", 0.75}};
    p.islands = 2'000, p.largest_island = 40, p.most_contacts = 312, p.largest_part = 30;
    p.iterations = 6'000, p.iterations_most = 17, p.residual = 2e-9;
    p.friction_solves = 1'000, p.friction_misses = 20, p.friction_error = 0.015;
    p.friction_tolerance = 1e-3;
    return p;
}

TEST(ProfileLine, HasStagesAndWhatTheSolverDid) {
    const Json line = Json::parse(profile_line(a_profile()));
    EXPECT_EQ(line["type"], "profile");
    EXPECT_EQ(line["ticks"], 500);
    ASSERT_EQ(line["stages"].size(), 2u);
    EXPECT_EQ(line["stages"][1]["name"], "solve velocities");
    EXPECT_EQ(line["stages"][1]["seconds"], 0.75);
    EXPECT_EQ(line["largest_island_robots"], 40);
    EXPECT_EQ(line["most_contacts"], 312);
    EXPECT_EQ(line["iterations_per_tick_mean"], 12);
    EXPECT_EQ(line["iterations_per_island_mean"], 3);
    EXPECT_EQ(line["iterations_per_island_most"], 17);
    EXPECT_EQ(line["friction_missed_share"], 0.02);
    EXPECT_EQ(line["friction_error_worst"], 0.015);
}

TEST(ProfileLine, OfNothingMeasuredHasNoNumbersThatAreNone) {
    const Json line = Json::parse(profile_line(RunProfile{}));
    EXPECT_EQ(line["ticks"], 0);
    EXPECT_EQ(line["friction_missed_share"], 0);
    RunProfile infinite = a_profile();
    infinite.residual = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(Json::parse(profile_line(infinite))["residual_worst"].is_null());
}

TEST(ProfileLine, ARefusalSaysWhy) {
    const Json line = Json::parse(profile_line(Error{"a program steps this world", "measure it there"}));
    EXPECT_EQ(line["ticks"], 0);
    EXPECT_NE(line["why"].get<std::string>().find("a program steps this world"), std::string::npos);
}

TEST(ProfileJson, IsTheLineWithoutItsType) {
    Json line = Json::parse(profile_line(a_profile()));
    line.erase("type");
    EXPECT_EQ(Json::parse(profile_json(a_profile())), line);
}

}  // namespace
}  // namespace roboss
