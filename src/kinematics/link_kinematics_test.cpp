// Poses, twists and Jacobians against the simulation's own readings and against finite differences.
#include "kinematics/link_kinematics.h"

#include <gtest/gtest.h>

#include <support/kinematic_robots.h>

#include "physics/dynamics/kinematics.h"

namespace roboss::test {
namespace {

const Pose kTool{{0.1, -0.05, 0.2}, from_rpy(0.4, 0.3, -0.6)};

Transform tool_pose(const RobotModel& robot, const std::vector<double>& q, LinkId link, const Pose& X_LT) {
    std::vector<double> p(7);
    tool_poses(robot, q, link, X_LT, p);
    return to_transform(Pose{{p[0], p[1], p[2]}, {p[6], p[3], p[4], p[5]}});
}

TEST(LinkKinematics, PosesAndTwistsAreThoseOfTheSimulation) {
    Random random(2);
    for (const ModelSpec& spec : sample_robots()) {
        const RobotModel robot = robot_of(spec);
        const std::vector<double> q = random_configuration(robot, random),
                                  v = random_row(robot.v_columns(), 2, random);
        const RobotState state = state_of(robot, q, v);
        std::vector<double> twist(6);
        for (std::size_t l = 0; l < robot.type().links.size(); ++l) {
            const Transform mine = tool_pose(robot, q, LinkId(l), {}),
                            theirs = link_pose(robot.type(), state, LinkId(l));
            EXPECT_LT(norm(mine.p - theirs.p), 1e-13) << spec.name;
            tool_twists(robot, q, v, LinkId(l), {}, twist);
            const Twist wanted = link_twist(robot.type(), state, LinkId(l));
            EXPECT_LT(norm(Vec3{twist[0], twist[1], twist[2]} - wanted.linear), 1e-12) << spec.name;
            EXPECT_LT(norm(Vec3{twist[3], twist[4], twist[5]} - wanted.angular), 1e-12) << spec.name;
        }
    }
}

TEST(LinkKinematics, JacobiansAreTheDerivativesOfPoses) {
    Random random(3);
    constexpr double kStep = 1e-5;
    double worst = 0;
    for (const ModelSpec& spec : sample_robots()) {
        const RobotModel robot = robot_of(spec);
        const std::size_t n = robot.v_columns();
        const std::vector<double> q = random_configuration(robot, random);
        std::vector<double> jacobian(6 * n), in_tool(6 * n);
        const LinkId link(robot.type().links.size() - 1);
        tool_jacobians(robot, q, link, kTool, FrameAxes::kWorld, jacobian);
        tool_jacobians(robot, q, link, kTool, FrameAxes::kTool, in_tool);
        const Mat3 R_TW = transpose(tool_pose(robot, q, link, kTool).R);
        for (std::size_t c = 0; c < n; ++c) {
            std::vector<double> unit(n, 0.0);
            unit[c] = 1;
            const Transform before = tool_pose(robot, moved(robot, q, unit, -kStep), link, kTool),
                            after = tool_pose(robot, moved(robot, q, unit, kStep), link, kTool);
            const Vec3 linear = (after.p - before.p) / (2 * kStep),
                       angular = logarithm(to_quat(after.R * transpose(before.R))) / (2 * kStep);
            const auto column = [&](const std::vector<double>& J, std::size_t line) {
                return Vec3{J[line * n + c], J[(line + 1) * n + c], J[(line + 2) * n + c]};
            };
            worst =
                std::max({worst, norm(column(jacobian, 0) - linear), norm(column(jacobian, 3) - angular)});
            EXPECT_LT(norm(column(in_tool, 0) - R_TW * column(jacobian, 0)), 1e-12) << spec.name;
            EXPECT_LT(norm(column(in_tool, 3) - R_TW * column(jacobian, 3)), 1e-12) << spec.name;
        }
    }
    tell("largest difference between Jacobian and finite differences", worst);
    EXPECT_LT(worst, 1e-8);
}

TEST(LinkKinematics, RowsOfABatchAreThoseOfSingleCalls) {
    Random random(4);
    const RobotModel robot = robot_of(mixed_tree());
    const std::size_t links = robot.type().links.size();
    std::vector<double> q, all(5 * links * 7), one(links * 7);
    for (int i = 0; i < 5; ++i)
        for (const double x : random_configuration(robot, random)) q.push_back(x);
    link_poses(robot, q, all);
    for (std::size_t i = 0; i < 5; ++i) {
        link_poses(robot, std::span<const double>(q).subspan(i * robot.q_columns(), robot.q_columns()), one);
        EXPECT_TRUE(
            std::equal(one.begin(), one.end(), all.begin() + static_cast<std::ptrdiff_t>(i * one.size())));
    }
}

}  // namespace
}  // namespace roboss::test
