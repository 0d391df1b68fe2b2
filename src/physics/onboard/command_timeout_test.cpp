// CommandTimeout in the step: a drive stops when its commands cease, and at no other time.
#include <gtest/gtest.h>

#include <support/drives.h>

namespace roboss::test {
namespace {

constexpr std::size_t kDrive = 1;  // place of the drive among the on-board controllers

/// two_wheeler() with a timeout of 0.2 s before its drive, on a plane, after it has settled.
class WatchedDrive {
  public:
    WatchedDrive() : sim(on_plane(watched())) { sim.run(0.5); }

    void command(double speed) { give(sim, "cmd_vel", {speed, 0, 0, 0, 0, 0}); }
    double speed() const { return memory(sim, 0, kDrive)[DiffDriveSpec::kSpeed]; }
    /// The tick of the last command, which stands before its values.
    double commanded_at() const {
        return sim.states[0].onboard[static_cast<std::size_t>(sim.type(0).channels[0].index)];
    }

    Simulation sim;

  private:
    static ModelSpec watched() {
        CommandTimeoutSpec timeout;
        timeout.timeout = 0.2, timeout.joints = {"left_joint", "right_joint"};
        return with_onboard(with_onboard(two_wheeler(), timeout), diff_drive());
    }
};

TEST(CommandTimeout, StopsTheDriveWhenCommandsCease) {
    WatchedDrive robot;
    ASSERT_EQ(robot.sim.type(0).onboard.size(), 2u);
    robot.command(0.4);
    robot.sim.run(0.199);
    EXPECT_EQ(robot.speed(), 0.4);
    EXPECT_NEAR(joint_velocity(robot.sim, "left_joint"), 0.4 / kWheelRadius, 1e-3);
    robot.sim.run(0.003);  // the timeout is exceeded
    EXPECT_EQ(robot.speed(), 0);
    robot.sim.run(0.3);
    EXPECT_NEAR(joint_velocity(robot.sim, "left_joint"), 0, 1e-3);
    EXPECT_NEAR(joint_velocity(robot.sim, "right_joint"), 0, 1e-3);
}

TEST(CommandTimeout, EachCommandBeginsItAnew) {
    WatchedDrive robot;
    for (int i = 0; i < 10; ++i) {
        robot.command(0.4);
        robot.sim.run(0.15);
        EXPECT_EQ(robot.speed(), 0.4) << "command " << i;
    }
    robot.sim.run(0.1);
    EXPECT_EQ(robot.speed(), 0);
    robot.command(-0.3);
    EXPECT_EQ(robot.speed(), -0.3) << "it drives again";
}

TEST(CommandTimeout, LeavesACommandToStandAsItIs) {
    WatchedDrive robot;
    EXPECT_EQ(robot.commanded_at(), -1);
    robot.command(0);
    const double at = robot.commanded_at();
    EXPECT_EQ(at, 500);
    robot.sim.run(0.5);
    EXPECT_EQ(robot.commanded_at(), at);
}

TEST(CommandTimeout, NeedsATimeAboveZero) {
    CommandTimeoutSpec timeout;
    EXPECT_TRUE(problems_of({"t", timeout, {}}).empty());
    timeout.timeout = 0;
    EXPECT_EQ(problems_of({"t", timeout, {}}).size(), 1u);
}

}  // namespace
}  // namespace roboss::test
