// Rows of a RobotModel: to the kernel's coordinates and back, columns, followers, loops.
#include <gtest/gtest.h>

#include <support/kinematic_robots.h>

#include "kinematics/dynamics.h"
#include "kinematics/link_kinematics.h"

namespace roboss::test {
namespace {

TEST(RobotModel, RowsComeBackFromTheKernelsCoordinates) {
    Random random(1);
    for (const ModelSpec& spec : sample_robots()) {
        const RobotModel robot = robot_of(spec);
        const std::vector<double> row = random_configuration(robot, random);
        std::vector<double> q(static_cast<std::size_t>(robot.type().nq)), back(row.size());
        robot.to_coordinates(row.data(), q);
        robot.to_row(q, back.data());
        const double sign = robot.base_q() > 0 && back[6] * row[6] < 0 ? -1 : 1;  // q and -q are one rotation
        for (std::size_t c = 0; c < row.size(); ++c)
            EXPECT_NEAR(back[c] * (c >= 3 && c < robot.base_q() ? sign : 1), row[c], 1e-12)
                << spec.name << " " << c;
    }
}

TEST(RobotModel, ColumnsAreTheJointsOfTheFile) {
    const RobotModel robot = robot_of(arm_of_all_joints());
    std::vector<std::string> names;
    for (const JointAxis& axis : robot.axes()) names.push_back(axis.name);
    EXPECT_EQ(names, (std::vector<std::string>{"hinge", "slide", "thread", "cardan:0", "cardan:1", "wheel:0",
                                               "wheel:1", "turn", "ball:0", "ball:1", "ball:2", "plane:0",
                                               "plane:1", "plane:2"}));
    EXPECT_EQ(robot.q_columns(), 14u);
    EXPECT_EQ(robot_of(spider()).q_columns(), 7u + 18u);
    EXPECT_EQ(robot_of(spider()).v_columns(), 6u + 18u);
}

TEST(RobotModel, StartsWhereTheWorldDoes) {
    const RobotModel robot = robot_of(spider());
    const std::vector<double> start = robot.start();
    EXPECT_NEAR(start[0], 0.4, 1e-12);
    EXPECT_NEAR(start[2], 0.2, 1e-12);
    for (std::size_t c = 7; c < start.size(); ++c) EXPECT_EQ(start[c], 0) << c;
}

TEST(RobotModel, StandsWhereItIsPut) {
    const Pose X_WR{{1, 2, 3}, from_rpy(0, 0, 0.5)};
    const RobotModel robot = robot_of(arm(), {.X_WR = X_WR});
    std::vector<double> poses(robot.type().links.size() * 7);
    link_poses(robot, std::vector<double>(4, 0.0), poses);
    EXPECT_NEAR(poses[0], 1, 1e-12);
    EXPECT_NEAR(poses[2], 4, 1e-12);  // the arm hangs 1 m above its origin
}

TEST(RobotModel, RefusesLoopsUnlessTheyMayBeCut) {
    World world = empty_world(1e-3);
    place(world, four_bar(), "linkage");
    const auto model = compiled(world);
    const Result<RobotModel> refused = RobotModel::create(model, RobotId(0U));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, "closed-loop");
    const RobotModel cut = RobotModel::create(model, RobotId(0U), {.cut_loops = true}).value();
    EXPECT_EQ(cut.cut_joints(), std::vector<std::string>{"closing"});
    EXPECT_EQ(cut.v_columns(), 3u);
}

TEST(RobotModel, RefusesWhatCannotMove) {
    World world = empty_world(1e-3);
    ModelSpec post = one_link(link("post", 1, Mat3::diagonal(1, 1, 1)));
    post.joints.push_back(joint(JointSpecKind::kFixed, "ground", "world", "post", {}));
    place(world, post, "post");
    place(world, arm(), "arm", {{1, 0, 0}, {}});
    const auto model = compiled(world);
    for (const Robot& robot : model->robots)
        if (model->types[robot.type.index()].nv == 0) {
            const Result<RobotModel> refused = RobotModel::create(model, *model->find_robot(robot.name));
            ASSERT_FALSE(refused.ok());
            EXPECT_EQ(refused.error().code, "no-joints");
        }
}

TEST(RobotModel, FollowersAreResolvedToTheFirstLeader) {
    ModelSpec chain = arm();
    const auto follow = [&](std::size_t follower, const std::string& leader, double multiplier,
                            double offset) {
        MimicSpec mimic;
        mimic.joint = leader, mimic.multiplier = multiplier, mimic.offset = offset;
        chain.joints[follower].axes[0].mimic = mimic;
    };
    follow(2, "joint_1", -2, 0.1);
    follow(3, "joint_2", 0.5, 0.2);
    const RobotModel robot = robot_of(chain);
    const RobotModel::Column& last = robot.columns()[3];
    EXPECT_EQ(last.leader, 1);
    EXPECT_NEAR(last.multiplier, -1, 1e-15);
    EXPECT_NEAR(last.leader_offset, 0.5 * 0.1 + 0.2, 1e-15);
}

}  // namespace
}  // namespace roboss::test
