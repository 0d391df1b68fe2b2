// Commands and names of on-board controllers, of all kinds alike.
#include "onboard_kinds/onboard_spec.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace roboss {
namespace {

TEST(Channels, AreNamedAfterGazebosTopic) {
    const auto name = [](const char* topic) { return channel_of(topic, "cmd_vel", {}).name; };
    EXPECT_EQ(name(""), "cmd_vel");
    EXPECT_EQ(name("cmd"), "cmd");
    EXPECT_EQ(name("/cmd"), "cmd");
    EXPECT_EQ(name("/model/blue/cmd_vel"), "cmd_vel");
    EXPECT_EQ(name("/model/blue/joint/arm/0/cmd_pos"), "joint/arm/0/cmd_pos");
    EXPECT_EQ(name("model/"), "model/");
    EXPECT_EQ(name("/"), "cmd_vel");
}

TEST(Channels, KnowTheTopicOfTheirRobot) {
    EXPECT_EQ(channel_of("", "cmd_vel", {}).topic, "/model/{model}/cmd_vel");
    EXPECT_EQ(channel_of("/model/blue/go", "cmd_vel", {}).topic, "/model/blue/go");
    EXPECT_EQ(channel_of("go", "cmd_vel", {}).topic, "/go");
}

TEST(OnboardKinds, HaveNumbersAndNamesOfTheirOwn) {
    std::set<std::uint32_t> numbers;
    std::set<std::string> names;
    std::size_t kinds = 0;
    for_each_onboard_kind([&]<class Kind>(std::in_place_type_t<Kind>) {
        numbers.insert(Kind::kKind.number), names.insert(Kind::kKind.name);
        ++kinds;
    });
    EXPECT_EQ(numbers.size(), kinds);
    EXPECT_EQ(names.size(), kinds);
}

TEST(OnboardKinds, NameNoParameterTwice) {
    for_each_onboard_kind([]<class Kind>(std::in_place_type_t<Kind>) {
        std::set<std::string> names;
        std::size_t count = 0;
        const Kind kind;
        kind.parameters(
            [&](const Parameter& parameter, const auto&) {
                names.insert(parameter.name);
                ++count;
            },
            kind);
        EXPECT_EQ(names.size(), count) << Kind::kKind.name;
    });
}

TEST(OnboardKinds, RefuseParametersThatAreNotFinite) {
    VelocityControlSpec control;
    EXPECT_TRUE(problems_of({"go", control, {}}).empty());
    control.initial_linear.y = std::numeric_limits<double>::quiet_NaN();
    ASSERT_EQ(problems_of({"go", control, {}}).size(), 1u);
}

}  // namespace
}  // namespace roboss
