// Filters are POSIX extended regular expressions; those that could stall are refused.
#include "ros2/name_filter.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss::ros2 {
namespace {

bool fits(const std::string& expression, const std::string& name) {
    const auto filter = NameFilter::of(expression);
    EXPECT_TRUE(filter) << expression;
    return filter && filter.value().fits(name);
}

TEST(NameFilter, PartsOfNamesFitUnlessAnchored) {
    EXPECT_TRUE(fits("", "car"));
    EXPECT_TRUE(fits("a", "car"));
    EXPECT_FALSE(fits("^a", "car"));
    EXPECT_TRUE(fits("^(car|van)_[[:digit:]]+$", "van_12"));
    EXPECT_TRUE(fits("^a{2,3}$", "aaa"));
    EXPECT_FALSE(fits("^a{2,3}$", "aaaa"));
}

TEST(NameFilter, ExpressionsThatCouldStallAreRefused) {
    for (const std::string& bad :
         {std::string("("), std::string("a{9,2}"), std::string("(a*)\\1"), std::string("((a{99}){99}){99}"),
          std::string("a{99999999999999999999}"), std::string(300, 'a')})
        EXPECT_FALSE(NameFilter::of(bad)) << bad;
    EXPECT_TRUE(fits("\\.", "a.b"));
}

TEST(NameFilter, AnyTextIsAnsweredSoon) {
    std::mt19937 random(3);
    const std::string characters = "ab(){}[]*+?|.^$\\1259,-:";
    for (int round = 0; round < 2'000; ++round) {
        std::string expression;
        for (std::size_t i = random() % 60; i > 0; --i)
            expression += characters[random() % characters.size()];
        const auto filter = NameFilter::of(expression);
        if (filter) (void)filter.value().fits(std::string(100, 'a'));
    }
}

}  // namespace
}  // namespace roboss::ros2
