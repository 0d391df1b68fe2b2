// A row of a batch allocates nothing: operator new of this program is counted for few rows and for many.
#include <gtest/gtest.h>

#include <functional>

#include <support/count_allocations.h>
#include <support/kinematic_robots.h>

#include "kinematics/dynamics.h"
#include "kinematics/inverse_kinematics.h"

namespace roboss::test {
namespace {

struct Rows {
    std::vector<double> q, v, start, row, matrix, poses, jacobians;
    std::vector<InverseKinematicsResult> results;
};

Rows rows_of(const RobotModel& robot, std::size_t count) {
    Random random(41);
    Rows rows;
    for (std::size_t i = 0; i < count; ++i) {
        for (const double x : random_configuration(robot, random)) rows.q.push_back(x);
        for (const double x : random_row(robot.v_columns(), 1, random)) rows.v.push_back(x);
    }
    rows.start = rows.q;
    const std::size_t n = robot.v_columns();
    rows.row.resize(count * n), rows.matrix.resize(count * n * n), rows.jacobians.resize(count * 6 * n);
    rows.poses.resize(count * 7), rows.results.resize(count);
    return rows;
}

using Call = std::function<void(const RobotModel&, Rows&)>;

std::vector<Call> calls() {
    const LinkId link(3U);
    return {
        [=](const RobotModel& r, Rows& x) { tool_poses(r, x.q, link, {}, x.poses); },
        [=](const RobotModel& r, Rows& x) {
            tool_jacobians(r, x.q, link, {}, FrameAxes::kTool, x.jacobians);
        },
        [](const RobotModel& r, Rows& x) {
            inverse_dynamics(r, x.q, x.v, x.v, {0, 0, -9.8}, x.row);
        },
        [](const RobotModel& r, Rows& x) {
            forward_dynamics(r, x.q, x.v, x.v, {0, 0, -9.8}, x.row);
        },
        [](const RobotModel& r, Rows& x) { mass_matrices(r, x.q, x.matrix); },
        [](const RobotModel& r, Rows& x) { coriolis_matrices(r, x.q, x.v, x.matrix); },
        [=](const RobotModel& r, Rows& x) {
            inverse_kinematics(r, link, {.attempts = 3}, x.poses, x.start, x.q, x.results);
        },
    };
}

TEST(RowAllocation, IsNoneBeyondThoseOfTheCall) {
    for (const ModelSpec& spec : {spider(), arm_of_all_joints(), mixed_tree()}) {
        SCOPED_TRACE(spec.name);
        const RobotModel robot = robot_of(spec);
        Rows few = rows_of(robot, 2), many = rows_of(robot, 200);
        const std::vector<Call> all = calls();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto count = [&](Rows& rows) {
                const std::size_t before = allocations;
                all[i](robot, rows);
                return allocations - before;
            };
            const std::size_t of_few = count(few);
            EXPECT_GT(of_few, 0u) << "call " << i;
            EXPECT_EQ(count(many), of_few) << "call " << i;
        }
    }
}

}  // namespace
}  // namespace roboss::test
