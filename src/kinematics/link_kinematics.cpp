// See link_kinematics.h.
#include "kinematics/link_kinematics.h"

#include <algorithm>

#include "kinematics/posed_robot.h"
#include "math/array_rows.h"

namespace roboss {
namespace {

void check_size(std::span<double> out, std::size_t wanted) {
    ROBOSS_CHECK(out.size() == wanted, std::to_string(out.size()) + " numbers for " + std::to_string(wanted));
}

}  // namespace

void tool_poses(const RobotModel& robot, std::span<const double> q, LinkId link, const Pose& X_LT,
                std::span<double> out) {
    const std::size_t rows = RobotModel::rows(q.size(), robot.q_columns());
    check_size(out, rows * 7);
    const Transform X = to_transform(X_LT);
    PosedRobot posed(robot);
    for (std::size_t i = 0; i < rows; ++i) {
        posed.place(&q[i * robot.q_columns()]);
        put_row(to_pose(posed.link_pose(link) * X), &out[i * 7]);
    }
}

void link_poses(const RobotModel& robot, std::span<const double> q, std::span<double> out) {
    const std::size_t rows = RobotModel::rows(q.size(), robot.q_columns()), links = robot.type().links.size();
    check_size(out, rows * links * 7);
    PosedRobot posed(robot);
    for (std::size_t i = 0; i < rows; ++i) {
        posed.place(&q[i * robot.q_columns()]);
        for (std::size_t l = 0; l < links; ++l)
            put_row(to_pose(posed.link_pose(LinkId(l))), &out[(i * links + l) * 7]);
    }
}

void tool_twists(const RobotModel& robot, std::span<const double> q, std::span<const double> v, LinkId link,
                 const Pose& X_LT, std::span<double> out) {
    const std::size_t rows = RobotModel::rows(q.size(), robot.q_columns());
    check_size(out, rows * 6);
    ROBOSS_CHECK(v.size() == rows * robot.v_columns(), std::to_string(v.size()) + " velocities");
    PosedRobot posed(robot);
    for (std::size_t i = 0; i < rows; ++i) {
        posed.place(&q[i * robot.q_columns()]);
        const double* velocity = &v[i * robot.v_columns()];
        const Vec3 p = posed.link_pose(link) * X_LT.p;
        Spatial twist;
        posed.visit_path(
            link, [&](std::size_t d) { twist += posed.point_motion(d, p) * velocity[robot.column_of(d)]; });
        put_row(twist.linear, twist.angular, &out[i * 6]);
    }
}

void tool_jacobians(const RobotModel& robot, std::span<const double> q, LinkId link, const Pose& X_LT,
                    FrameAxes axes, std::span<double> out) {
    const std::size_t rows = RobotModel::rows(q.size(), robot.q_columns()), columns = robot.v_columns();
    check_size(out, rows * 6 * columns);
    std::fill(out.begin(), out.end(), 0.0);
    const Transform X = to_transform(X_LT);
    PosedRobot posed(robot);
    for (std::size_t i = 0; i < rows; ++i) {
        posed.place(&q[i * robot.q_columns()]);
        const Transform X_WT = posed.link_pose(link) * X;
        const Mat3 turn = axes == FrameAxes::kTool ? transpose(X_WT.R) : Mat3::identity();
        double* matrix = &out[i * 6 * columns];
        posed.visit_path(link, [&](std::size_t d) {
            const Spatial motion = posed.point_motion(d, X_WT.p);
            const Vec3 linear = turn * motion.linear, angular = turn * motion.angular;
            for (std::size_t line = 0; line < 3; ++line) {
                matrix[line * columns + robot.column_of(d)] = linear[line];
                matrix[(3 + line) * columns + robot.column_of(d)] = angular[line];
            }
        });
    }
}

}  // namespace roboss
