// Reports of refused orders.
#include "client/refusals.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

Error refused_by(int robot) {
    return {"wrench on 'X" + std::to_string(robot) + "' is not finite", "give finite numbers", "not-finite"};
}

TEST(Refusals, OrdersOfManyRobotsThatAreRefusedForOneCauseAreOneLine) {
    Refusals refusals;
    for (int robot = 0; robot < 20; ++robot) refusals.add_order(refused_by(robot));
    refusals.add_order({"order for a joint that it does not have", "", "no-joint"});
    const std::vector<std::string> lines = refusals.take();
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_NE(lines[0].find("'X0' is not finite (and 19 more like it)"), std::string::npos) << lines[0];
    EXPECT_EQ(lines[1].find("more like it"), std::string::npos) << lines[1];
}

TEST(Refusals, WhatWasReportedIsNotReportedAgain) {
    Refusals refusals;
    refusals.add_order(refused_by(1));
    EXPECT_EQ(refusals.take().size(), 1u);
    refusals.add_order(refused_by(1));
    EXPECT_TRUE(refusals.take().empty());
    refusals.add_order(refused_by(2));
    EXPECT_EQ(refusals.take().size(), 1u);
}

}  // namespace
}  // namespace roboss
