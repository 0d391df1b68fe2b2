// A period is complete with one message of each topic, however they arrive.
#include "ros2/lockstep.h"

#include <gtest/gtest.h>

#include <support/drives.h>

namespace roboss::ros2 {
namespace {

/// Two cars with a drive each.
RobotCommands two_cars() {
    World world = test::on_plane(test::skid_car());
    test::place(world, test::skid_car(), "other");
    return RobotCommands(test::compiled(world), {});
}

std::size_t topic_named(const RobotCommands& commands, const std::string& name) {
    for (std::size_t t = 0; t < commands.topics().size(); ++t)
        if (commands.topics()[t].name == name) return t;
    ADD_FAILURE() << "no topic " << name;
    return 0;
}

class LockstepTest : public testing::Test {
  protected:
    std::vector<std::string> accepted() {
        std::vector<std::string> bytes;
        for (const Lockstep::Accepted& message : lockstep.accepted()) bytes.push_back(message.bytes);
        return bytes;
    }
    RobotCommands commands = two_cars();
    std::size_t first = topic_named(commands, "/robot/cmd_vel"),
                second = topic_named(commands, "/other/cmd_vel");
    Lockstep lockstep = Lockstep::of({"/*/cmd_vel"}, commands).value();
};

TEST_F(LockstepTest, TheOrderOfArrivalDoesNotCount) {
    lockstep.begin(0);
    EXPECT_EQ(lockstep.missing(), (std::vector{first, second}));
    EXPECT_TRUE(lockstep.take(second, "b", {}));
    EXPECT_FALSE(lockstep.is_complete());
    EXPECT_TRUE(lockstep.take(first, "a", {}));
    EXPECT_TRUE(lockstep.is_complete());
    EXPECT_EQ(accepted(), (std::vector<std::string>{"a", "b"}));
}

TEST_F(LockstepTest, AMessageTooManyCountsForTheNextPeriod) {
    lockstep.begin(0);
    lockstep.take(first, "a0", {}), lockstep.take(first, "a1", {}), lockstep.take(second, "b0", {});
    EXPECT_EQ(accepted(), (std::vector<std::string>{"a0", "b0"}));
    EXPECT_EQ(lockstep.early(), 1u);
    lockstep.begin(1);
    EXPECT_EQ(lockstep.missing(), std::vector{second});
    lockstep.take(second, "b1", {});
    EXPECT_EQ(accepted(), (std::vector<std::string>{"a1", "b1"}));
}

TEST_F(LockstepTest, AMessageBetweenTwoPeriodsIsNotLost) {
    lockstep.take(first, "a0", {});  // before the first one
    lockstep.begin(0);
    EXPECT_EQ(lockstep.missing(), std::vector{second});
    lockstep.take(second, "b0", {});
    EXPECT_EQ(accepted(), (std::vector<std::string>{"a0", "b0"}));
    lockstep.take(first, "a1", {}), lockstep.take(second, "b1", {});
    lockstep.begin(1);
    ASSERT_TRUE(lockstep.is_complete());
    EXPECT_EQ(accepted(), (std::vector<std::string>{"a1", "b1"}));
    EXPECT_EQ(lockstep.early(), 3u);
}

TEST_F(LockstepTest, ARunThatGoesBackForgetsTheAnswersToItsFuture) {
    lockstep.begin(5);
    lockstep.take(first, "old", {}), lockstep.take(first, "older", {});
    lockstep.forget();
    lockstep.begin(1);
    EXPECT_EQ(lockstep.missing(), (std::vector{first, second}));
}

TEST_F(LockstepTest, AStampNamesThePeriod) {
    lockstep.begin(2'000);
    lockstep.take(first, "late", 1'000), lockstep.take(first, "now", 2'000);
    lockstep.take(second, "next", 3'000);
    EXPECT_EQ(lockstep.dropped(), 1u);
    EXPECT_EQ(lockstep.missing(), std::vector{second});
    lockstep.take(second, "never", 2'000);
    EXPECT_FALSE(lockstep.is_complete()) << "it stands behind one of the next period";
}

TEST_F(LockstepTest, OthersHaveNoEffectAndAFloodIsBounded) {
    lockstep.begin(0);
    EXPECT_FALSE(lockstep.take(topic_named(commands, "/robot/enable"), "x", {}));
    for (int i = 0; i < 1000; ++i) lockstep.take(first, "a", {});
    EXPECT_GE(lockstep.dropped(), 800u);
}

TEST_F(LockstepTest, AFloodOfLargeMessagesLeavesRoomForOthers) {
    lockstep.begin(0);
    const std::string large(std::size_t{16} << 20, 'x');
    for (int i = 0; i < 40; ++i) lockstep.take(first, large, {});
    EXPECT_GE(lockstep.dropped(), 20u);
    lockstep.take(second, large, {});
    EXPECT_TRUE(lockstep.is_complete());
    lockstep.forget();
    lockstep.begin(0);
    for (int i = 0; i < 10; ++i) lockstep.take(first, large, {});
    EXPECT_LT(lockstep.dropped(), 40u) << "what was forgotten takes no room";
}

TEST_F(LockstepTest, APatternThatMatchesNothingIsRefused) {
    const Result<Lockstep> made = Lockstep::of({"/robot/cmd_vel", "/robot/cmd_wel"}, commands);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, "no-topic");
    EXPECT_NE(made.error().message.find("cmd_wel"), std::string::npos);
}

}  // namespace
}  // namespace roboss::ros2
