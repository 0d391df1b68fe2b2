// Robots by name and pattern.
#include "model/robot_names.h"

#include <gtest/gtest.h>

#include <support/robots.h>

namespace roboss::test {
namespace {

std::shared_ptr<const Model> world_of(const std::vector<std::string>& names) {
    World world = empty_world(1e-3);
    for (const std::string& name : names) place(world, car(), name);
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

std::vector<std::uint32_t> found(const Model& model, const std::string& wanted) {
    std::vector<std::uint32_t> numbers;
    for (const RobotId robot : find_robots(model, wanted)) numbers.push_back(robot.value);
    return numbers;
}

TEST(RobotNames, FitPatterns) {
    for (const char* pattern : {"X12", "X*", "*", "*2", "X?2", "X*2*", "?1?", "X**2", "***"})
        EXPECT_TRUE(fits_pattern("X12", pattern)) << pattern;
    for (const char* pattern : {"", "x*", "X1", "X12?", "*3", "X?", "?", "X*3*", "12", "X12X12"})
        EXPECT_FALSE(fits_pattern("X12", pattern)) << pattern;
    EXPECT_TRUE(fits_pattern("", "*"));
    EXPECT_FALSE(fits_pattern("", "?"));
    EXPECT_TRUE(fits_pattern("ababac", "*abac"));
    EXPECT_TRUE(fits_pattern(std::string(5000, 'a'), "*a*a*a*"));
    EXPECT_FALSE(fits_pattern(std::string(5000, 'a'), "*a*a*a*b"));
}

TEST(RobotNames, FitPatternsWithSetsAsInPython) {
    for (const char* pattern :
         {"[XY]12", "X[0-9][0-9]", "X[!a-z]*", "*[2]", "X[]1]2", "[!]]12", "X[-1]2", "X[1-]2"})
        EXPECT_TRUE(fits_pattern("X12", pattern)) << pattern;
    for (const char* pattern : {"[xy]12", "X[2-9]2", "X[!1]2", "[X]", "X[12", "X[!0-9]2", "X[]2", "X[9-0]2"})
        EXPECT_FALSE(fits_pattern("X12", pattern)) << pattern;
    EXPECT_TRUE(fits_pattern("a[1", "a[1")) << "a bracket that nothing closes";
    EXPECT_TRUE(fits_pattern("a]", "a[]]"));
    EXPECT_TRUE(fits_pattern("ababac", "*[b][a]c"));
}

TEST(RobotNames, ComeInTheOrderOfTheRobots) {
    const auto model = world_of({"X2", "Y1", "X10", "X1"});
    EXPECT_EQ(found(*model, "X*"), (std::vector<std::uint32_t>{0, 2, 3}));
    EXPECT_EQ(found(*model, "X?"), (std::vector<std::uint32_t>{0, 3}));
    EXPECT_EQ(found(*model, "[XY]1"), (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(found(*model, "Y1"), (std::vector<std::uint32_t>{1}));
    EXPECT_TRUE(found(*model, "Z*").empty());
    EXPECT_TRUE(found(*model, "X").empty());
}

TEST(RobotNames, ARobotThatIsCalledLikeAPatternIsItAlone) {
    const auto model = world_of({"X1", "X*"});
    EXPECT_EQ(found(*model, "X*"), (std::vector<std::uint32_t>{1}));
}

TEST(RobotNames, ThatDoNotExistAreAnsweredByNamesThatDo) {
    const auto model = world_of({"rover_1", "rover_2", "drone", "crane"});
    const Error mistyped = no_such_robot(*model, "rovr_*");
    EXPECT_EQ(mistyped.code, "no-robot");
    EXPECT_NE(mistyped.message.find("rovr_*"), std::string::npos);
    EXPECT_NE(mistyped.remedy.find("'rover_1'"), std::string::npos) << mistyped.remedy;
    EXPECT_NE(no_such_robot(*model, "zebra").remedy.find("'rover_1', 'rover_2', 'drone' and 1 more"),
              std::string::npos);
}

}  // namespace
}  // namespace roboss::test
