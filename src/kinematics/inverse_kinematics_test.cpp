// Inverse kinematics: targets that are reachable are reached, within limits; masks, tools, followers, what is
// out of reach, and the same answer in every batch.
#include "kinematics/inverse_kinematics.h"

#include <gtest/gtest.h>

#include <support/kinematic_robots.h>

namespace roboss::test {
namespace {

using Numbers = std::vector<double>;

/// Seven hinges by turns about z and y, as arms with a redundant elbow have; limits of 2.8 rad.
ModelSpec seven_hinges() {
    ModelSpec m;
    m.name = "seven";
    m.canonical_link = "link_0";
    std::string parent = "world";
    for (int i = 0; i < 7; ++i) {
        const Pose X{{0.02 * (i % 2), 0, 0.2 + 0.18 * i}, {}};
        LinkSpec l = link("link_" + std::to_string(i), 2.0 - 0.2 * i, box_inertia(1, {0.1, 0.1, 0.2}), X);
        m.links.push_back(l);
        m.joints.push_back(joint(JointSpecKind::kRevolute, "joint_" + std::to_string(i), parent, l.name, X,
                                 i % 2 == 0 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}));
        m.joints.back().axes[0].lower = -2.8, m.joints.back().axes[0].upper = 2.8;
        parent = l.name;
    }
    return m;
}

struct Answer {
    Numbers q;
    std::vector<InverseKinematicsResult> results;
};

Answer solve(const RobotModel& robot, LinkId link, const Numbers& targets,
             const InverseKinematicsOptions& options = {}, const Numbers& start = {}) {
    Answer answer;
    answer.results.resize(targets.size() / 7);
    answer.q.resize(answer.results.size() * robot.q_columns());
    inverse_kinematics(robot, link, options, targets, start, answer.q, answer.results);
    return answer;
}

LinkId last_link(const RobotModel& robot) {
    return LinkId(robot.type().links.size() - 1);
}

Numbers poses_of(const RobotModel& robot, const Numbers& q, const Pose& X_LT = {}) {
    Numbers poses(q.size() / robot.q_columns() * 7);
    tool_poses(robot, q, last_link(robot), X_LT, poses);
    return poses;
}

Numbers random_configurations(const RobotModel& robot, std::size_t count, double size, std::uint64_t seed) {
    Random random(seed);
    Numbers q;
    for (std::size_t i = 0; i < count; ++i)
        for (const double x : random_row(robot.q_columns(), size, random)) q.push_back(x);
    return q;
}

TEST(InverseKinematics, ReachesWhatIsReachableWithinTheLimits) {
    const RobotModel robot = robot_of(seven_hinges());
    const Pose X_LT{{0, 0.02, 0.1}, from_rpy(0.1, 0.2, 0.3)};
    const Numbers targets = poses_of(robot, random_configurations(robot, 200, 2.7, 21), X_LT);
    const Answer answer = solve(robot, last_link(robot), targets, {.X_LT = X_LT});
    const Numbers reached = poses_of(robot, answer.q, X_LT);
    double worst = 0, iterations = 0;
    for (std::size_t i = 0; i < answer.results.size(); ++i) {
        EXPECT_TRUE(answer.results[i].success) << "target " << i;
        iterations += answer.results[i].iterations;
        const double* a = &reached[i * 7];
        const double* b = &targets[i * 7];
        const double sign = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
        for (std::size_t k = 0; k < 7; ++k)
            worst = std::max(worst, std::fabs(a[k] * (k < 3 ? 1 : sign) - b[k]));
    }
    tell("mean iterations a target", iterations / 200);
    EXPECT_LT(worst, 1e-8);
    for (const double x : answer.q) EXPECT_LE(std::fabs(x), 2.8);
}

TEST(InverseKinematics, GivesATargetTheSameAnswerInEveryBatch) {
    const RobotModel robot = robot_of(seven_hinges());
    const Numbers targets = poses_of(robot, random_configurations(robot, 20, 2.7, 22));
    const Answer all = solve(robot, last_link(robot), targets);
    const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(robot.q_columns());
    for (std::ptrdiff_t i = 0; i < 20; ++i) {
        const Answer one =
            solve(robot, last_link(robot), {targets.begin() + i * 7, targets.begin() + (i + 1) * 7});
        EXPECT_TRUE(std::equal(one.q.begin(), one.q.end(), all.q.begin() + i * n)) << "target " << i;
    }
}

TEST(InverseKinematics, StaysAtOnceWhereItIsAlreadyThere) {
    const RobotModel robot = robot_of(seven_hinges());
    const Numbers q = random_configurations(robot, 1, 2, 23);
    const Answer answer = solve(robot, last_link(robot), poses_of(robot, q), {}, q);
    EXPECT_EQ(answer.q, q);
    EXPECT_EQ(answer.results[0].iterations, 0);
}

TEST(InverseKinematics, FollowsAPathWithoutJumps) {
    const RobotModel robot = robot_of(seven_hinges());
    const Numbers first{0.3, 0.5, -0.2, 0.9, 0.4, 0.8, 0.1};
    Numbers targets, one = poses_of(robot, first);
    for (int i = 0; i < 50; ++i) targets.insert(targets.end(), one.begin(), one.end()), one[2] -= 0.004;
    Numbers start;
    for (int i = 0; i < 50; ++i) start.insert(start.end(), first.begin(), first.end());
    const Answer answer = solve(robot, last_link(robot), targets, {.path = true}, start);
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_TRUE(answer.results[i].success) << "target " << i;
        for (std::size_t c = 0; i > 0 && c < 7; ++c)
            EXPECT_LT(std::fabs(answer.q[i * 7 + c] - answer.q[(i - 1) * 7 + c]), 0.1) << "target " << i;
    }
}

TEST(InverseKinematics, AxesWithoutWeightAreFree) {
    const RobotModel robot = robot_of(arm());  // four joints reach positions, or two of them with a direction
    const Numbers q = random_configurations(robot, 30, 1.2, 24);
    InverseKinematicsOptions options;
    options.weights = {1, 1, 1, 0, 0, 0};
    options.attempts = 60;
    const Numbers targets = poses_of(robot, q);
    const Answer answer = solve(robot, last_link(robot), targets, options);
    const Numbers reached = poses_of(robot, answer.q);
    for (std::size_t i = 0; i < 30; ++i) {
        EXPECT_TRUE(answer.results[i].success) << "target " << i;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(reached[i * 7 + k], targets[i * 7 + k], 1e-8);
    }
}

TEST(InverseKinematics, TurnsFreelyAboutTheAxisOfTheTool) {
    const RobotModel robot = robot_of(seven_hinges());
    InverseKinematicsOptions options;
    options.weights = {1, 1, 1, 1, 1, 0};
    options.axes = FrameAxes::kTool;
    const Numbers targets = poses_of(robot, random_configurations(robot, 50, 2, 25));
    const Answer answer = solve(robot, last_link(robot), targets, options);
    const Numbers reached = poses_of(robot, answer.q);
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_TRUE(answer.results[i].success) << "target " << i;
        const auto axis = [](const double* p) { return rotate(Quat{p[6], p[3], p[4], p[5]}, {0, 0, 1}); };
        EXPECT_LT(norm(axis(&reached[i * 7]) - axis(&targets[i * 7])), 1e-7);
    }
}

TEST(InverseKinematics, TellsHowFarItStaysFromWhatIsOutOfReach) {
    const RobotModel robot = robot_of(seven_hinges());
    const Numbers far{50, 0, 0, 0, 0, 0, 1};
    InverseKinematicsOptions options;
    options.attempts = 3;
    const Answer answer = solve(robot, last_link(robot), far, options);
    EXPECT_FALSE(answer.results[0].success);
    EXPECT_EQ(answer.results[0].attempts, 3);
    EXPECT_GT(answer.results[0].position_error, 45);
    EXPECT_LT(answer.results[0].position_error, 52);
}

TEST(InverseKinematics, MovesOnlyWhatMayMove) {
    const RobotModel robot = robot_of(seven_hinges());
    const Numbers start = random_configurations(robot, 1, 1.5, 26);
    Numbers goal = start;
    goal[3] += 0.3, goal[5] -= 0.4;
    InverseKinematicsOptions options;
    options.moving = {0, 0, 0, 1, 1, 1, 0};
    const Answer answer = solve(robot, last_link(robot), poses_of(robot, goal), options, start);
    EXPECT_TRUE(answer.results[0].success);
    for (const std::size_t c : {0, 1, 2, 6}) EXPECT_EQ(answer.q[c], start[c]);
}

TEST(InverseKinematics, FollowersFollow) {
    ModelSpec spec = arm();
    MimicSpec mimic;
    mimic.joint = "joint_1", mimic.multiplier = -0.8, mimic.offset = 0.2;
    spec.joints[2].axes[0].mimic = mimic;
    const RobotModel robot = robot_of(spec);
    Numbers goal{0.3, 0.6, -0.8 * 0.6 + 0.2, 0.4};
    const Answer answer = solve(robot, last_link(robot), poses_of(robot, goal));
    EXPECT_TRUE(answer.results[0].success);
    EXPECT_NEAR(answer.q[2], -0.8 * answer.q[1] + 0.2, 1e-15);
}

TEST(InverseKinematics, LeavesAFreeBaseWhereItIsAndMovesJointsOfEveryKind) {
    for (const ModelSpec& spec : {mixed_tree(), arm_of_all_joints(), spider()}) {
        SCOPED_TRACE(spec.name);
        const RobotModel robot = robot_of(spec);
        Random random(27);
        Numbers start = random_configuration(robot, random), goal = start;
        for (std::size_t c = robot.base_q(); c < goal.size(); ++c) goal[c] += random.uniform(-0.3, 0.3);
        const Answer answer = solve(robot, last_link(robot), poses_of(robot, goal), {}, start);
        EXPECT_TRUE(answer.results[0].success);
        for (std::size_t c = 0; c < robot.base_q(); ++c) EXPECT_NEAR(answer.q[c], start[c], 1e-14);
    }
}

}  // namespace
}  // namespace roboss::test
