// Between the points of a trajectory: straight, cubic and quintic, as ros2_control has it.
#include "ros2/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roboss::ros2 {
namespace {

JointTrajectory trajectory(std::vector<JointTrajectoryPoint> points) {
    JointTrajectory message;
    message.joint_names = {"a"};
    message.points = std::move(points);
    return message;
}

JointTrajectoryPoint point(double time_s, double position, std::vector<double> velocity = {},
                           std::vector<double> acceleration = {}) {
    return {{position}, std::move(velocity), std::move(acceleration), {}, duration_of(time_s)};
}

TEST(Trajectory, PositionsAloneAreJoinedByStraightLines) {
    const auto made = Trajectory::of(trajectory({point(1, 2), point(3, 4)}), {{0, 5, 0}});
    ASSERT_TRUE(made);
    EXPECT_NEAR(made.value().at(0.5)[0].position, 1, 1e-9);
    EXPECT_NEAR(made.value().at(0.5)[0].velocity, 2, 1e-9);
    EXPECT_NEAR(made.value().at(2)[0].position, 3, 1e-9);
    EXPECT_NEAR(made.value().at(9)[0].position, 4, 1e-9);
    EXPECT_EQ(made.value().at(9)[0].velocity, 0);
    EXPECT_EQ(made.value().next(0.5), 0u);
    EXPECT_EQ(made.value().next(2), 1u);
    EXPECT_EQ(made.value().next(9), 1u);
}

TEST(Trajectory, VelocitiesMakeItCubicAndAccelerationsQuintic) {
    for (const bool quintic : {false, true}) {
        const std::vector<double> a = quintic ? std::vector<double>{0.5} : std::vector<double>{};
        const std::vector<double> end = quintic ? std::vector<double>{0.0} : std::vector<double>{};
        const auto made =
            Trajectory::of(trajectory({point(1, 1, {0.7}, a), point(3, 2, {0}, end)}), {{0, 0.2, 0}});
        ASSERT_TRUE(made);
        for (const double t : {1.0, 3.0}) {
            const double h = 1e-6;
            const JointPoint before = made.value().at(t - h)[0], at = made.value().at(t - 1e-12)[0];
            EXPECT_NEAR(at.position, t == 1 ? 1 : 2, 1e-6) << t;
            EXPECT_NEAR(at.velocity, t == 1 ? 0.7 : 0, 1e-6) << t;
            EXPECT_NEAR((at.position - before.position) / h, at.velocity, 1e-4) << "the derivative";
            EXPECT_NEAR((at.velocity - before.velocity) / h, at.acceleration, 1e-4) << "the derivative";
            if (quintic) {
                EXPECT_NEAR(at.acceleration, t == 1 ? 0.5 : 0, 1e-6);
            }
        }
        EXPECT_NEAR(made.value().at(0)[0].velocity, 0.2, 1e-9) << "it begins as the joint moves";
    }
}

TEST(Trajectory, WhatIsWrongIsRefused) {
    const auto code = [](const JointTrajectory& message) {
        const auto made = Trajectory::of(message, {{}, {}});
        return made ? std::string() : made.error().code;
    };
    EXPECT_EQ(code(trajectory({})), "bad-points");
    EXPECT_EQ(code(trajectory({point(1, 0), point(1, 1)})), "bad-points") << "times do not rise";
    EXPECT_EQ(code(trajectory({point(-1, 0)})), "bad-points");
    EXPECT_EQ(code(trajectory({point(1, std::nan(""))})), "bad-points");
    EXPECT_EQ(code(trajectory({point(1, 0, {1})})), "bad-points") << "it ends in motion";
    EXPECT_EQ(code(trajectory({point(1, 0, {0, 0})})), "bad-points") << "more values than joints";
    JointTrajectory twice = trajectory({point(1, 0)});
    twice.joint_names = {"a", "a"};
    EXPECT_EQ(code(twice), "bad-joints");
}

}  // namespace
}  // namespace roboss::ros2
