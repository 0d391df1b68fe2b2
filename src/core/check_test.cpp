// A broken invariant ends the program, in every build, and says what was broken.
#include "core/check.h"

#include <gtest/gtest.h>

#include <string>

namespace roboss {
namespace {

TEST(CheckDeathTest, EndsTheProgramWithConditionAndValues) {
    const int robots = 3;
    EXPECT_DEATH(ROBOSS_CHECK(robots == 4, "robots=" + std::to_string(robots)),
                 "check_test.cpp.*robots == 4 is false .robots=3");
}

TEST(Check, PassesATrueConditionWithoutMakingItsText) {
    int made = 0;
    const auto text = [&] {
        ++made;
        return std::string("never");
    };
    ROBOSS_CHECK(1 + 1 == 2, text());
    EXPECT_EQ(made, 0);
}

}  // namespace
}  // namespace roboss
