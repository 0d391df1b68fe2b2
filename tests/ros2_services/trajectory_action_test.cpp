// FollowJointTrajectory on a real run: arrival, tolerances, cancelling, preemption, refusals.
#include "ros2/trajectory_action.h"

#include "ros2/action_server.h"
#include "ros2/trajectory.h"
#include "ros2_types/messages/control_messages.h"
#include "ros2_types/messages/simulation_run_services.h"
#include "test_run.h"

namespace roboss::test {
namespace {

using Action = ros2::FollowJointTrajectory;
using Send = ros2::SendGoal<Action>;
using Get = ros2::GetResult<Action>;
using ros2::GoalStatus;

constexpr const char* kAction = "/arm/follow_joint_trajectory";

/// An arm that is playing, with its action.
struct Arm {
    TestRun run;
    std::unique_ptr<ros2::RobotAction> action;

    explicit Arm(const std::string& world = ball_and_arm()) : run(world) {
        namespace si = ros2::simulation_interfaces;
        const RobotId arm = *run.model().find_robot("arm");
        action = ros2::trajectory_action(run.transport, run.transport.add_node("/arm", "robot"), "/arm",
                                         run.control, arm,
                                         ros2::TrajectoryJoints::of(run.model().type_of(arm)), false);
        run.take = [this](const ros2::Incoming& call) { EXPECT_TRUE(action->take(call)); };
        run.advance = [this](std::int64_t now_ms) { action->advance(now_ms); };
        run.call<si::SetSimulationState>("/set_simulation_state", {{si::SimulationState::kPlaying}});
    }
    ros2::Uuid give(std::uint8_t number, const Action::Goal& goal, bool is_accepted = true) {
        Send::Request request{{}, goal};
        request.goal_id.uuid[0] = number;
        EXPECT_EQ(run.call<Send>(std::string(kAction) + "/_action/send_goal", request).accepted, is_accepted);
        return request.goal_id;
    }
    Get::Response result(const ros2::Uuid& goal) {
        return run.call<Get>(std::string(kAction) + "/_action/get_result", {goal});
    }
    double position(const char* joint) const {
        const RobotId arm = *run.model().find_robot("arm");
        const RobotType& type = run.model().type_of(arm);
        return joint_state(type, run.control.states()[arm.index()], *type.find_joint(joint)).position;
    }
};

Action::Goal goal_to(double shoulder, double elbow, double time_s) {
    Action::Goal goal;
    goal.trajectory.joint_names = {"elbow", "shoulder"};
    goal.trajectory.points = {{{elbow, shoulder}, {}, {}, {}, ros2::duration_of(time_s)}};
    return goal;
}

TEST(TrajectoryAction, JointsArriveInTimeAndFeedbackIsGiven) {
    Arm arm;
    Action::Goal goal = goal_to(0.5, -0.3, 0.4);
    goal.goal_tolerance = {{"shoulder", 0.02, 0, 0}, {"elbow", 0.02, 0, 0}};
    const auto result = arm.result(arm.give(1, goal));
    EXPECT_EQ(result.status, GoalStatus::kSucceeded) << result.result.error_string;
    EXPECT_EQ(result.result.error_code, Action::Result::kSuccessful);
    EXPECT_NEAR(arm.position("shoulder"), 0.5, 0.02);
    EXPECT_NEAR(arm.position("elbow"), -0.3, 0.02);
    const auto& feedback = arm.run.transport.published[std::string(kAction) + "/_action/feedback"];
    ASSERT_GT(feedback.size(), 5u);
    const auto last = ros2::from_cdr<ros2::FeedbackMessage<Action>>(feedback.back());
    ASSERT_TRUE(last);
    EXPECT_EQ(last.value().feedback.joint_names, goal.trajectory.joint_names);
    EXPECT_NEAR(last.value().feedback.desired.positions.at(0), -0.3, 0.05);
}

TEST(TrajectoryAction, CancelledJointsHoldTheirPositions) {
    Arm arm;
    const ros2::Uuid goal = arm.give(1, goal_to(2, 0, 2));
    const Tick begin = arm.run.tick();
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > begin + 500; }));
    ros2::CancelGoal::Request cancel;
    cancel.goal_info.goal_id = goal;
    const auto reply = arm.run.call<ros2::CancelGoal>(std::string(kAction) + "/_action/cancel_goal", cancel);
    EXPECT_EQ(reply.goals_canceling.size(), 1u);
    EXPECT_EQ(arm.result(goal).status, GoalStatus::kCanceled);
    const double held = arm.position("shoulder");
    EXPECT_GT(held, 0.2);
    EXPECT_LT(held, 1.5);
    const Tick then = arm.run.tick();
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > then + 500; }));
    EXPECT_NEAR(arm.position("shoulder"), held, 0.05);
}

TEST(TrajectoryAction, NewerGoalsTakeTheirPlace) {
    Arm arm;
    const ros2::Uuid first = arm.give(1, goal_to(2, 0, 5));
    const ros2::Uuid second = arm.give(2, goal_to(0.1, 0, 0.2));
    EXPECT_EQ(arm.result(first).status, GoalStatus::kAborted);
    EXPECT_EQ(arm.result(second).status, GoalStatus::kSucceeded);
}

TEST(TrajectoryAction, ToleranceOnTheWayEndsTheGoal) {
    Arm arm;
    Action::Goal goal = goal_to(3, 0, 0.001);
    goal.trajectory.points.push_back({{0, -3}, {}, {}, {}, ros2::duration_of(0.5)});
    goal.path_tolerance = {{"shoulder", 1e-6, 0, 0}};
    const auto result = arm.result(arm.give(1, goal));
    EXPECT_EQ(result.status, GoalStatus::kAborted);
    EXPECT_EQ(result.result.error_code, Action::Result::kPathToleranceViolated) << result.result.error_string;
}

TEST(TrajectoryAction, TrajectoriesOfTheTopicAreFollowedToo) {
    Arm arm;
    const ros2::Uuid goal = arm.give(1, goal_to(2, 0, 5));
    arm.run.transport.send("/arm/joint_trajectory", goal_to(0.3, -0.2, 0.3).trajectory);
    EXPECT_EQ(arm.result(goal).status, GoalStatus::kAborted) << "its place is taken";
    EXPECT_TRUE(arm.run.until([&] {
        return std::abs(arm.position("shoulder") - 0.3) < 0.02 &&
               std::abs(arm.position("elbow") + 0.2) < 0.02;
    }));
    arm.run.transport.send("/arm/joint_trajectory", goal_to(2, 0, 5).trajectory);
    const Tick begin = arm.run.tick();
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > begin + 500; }));
    arm.run.transport.send("/arm/joint_trajectory", ros2::JointTrajectory{});
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > begin + 700; }));
    const double held = arm.position("shoulder");
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > begin + 1500; }));
    EXPECT_NEAR(arm.position("shoulder"), held, 0.05) << "an empty trajectory stops it";
    EXPECT_TRUE(arm.action->take_notices().empty());
    arm.run.transport.send("/arm/joint_trajectory",
                           ros2::JointTrajectory{{}, {"knee"}, {{{1}, {}, {}, {}, {}}}});
    arm.run.transport.send_bytes("/arm/joint_trajectory", "no message");
    arm.run.turn(), arm.run.turn();
    EXPECT_EQ(arm.action->take_notices().size(), 2u);
}

TEST(TrajectoryAction, GoalsThatCannotBeFollowedAreRefused) {
    Arm arm;
    Action::Goal goal = goal_to(1, 1, 1);
    goal.trajectory.joint_names = {"elbow", "knee"};
    arm.give(1, goal, false);
    goal = goal_to(1, 1, 1);
    goal.trajectory.points.push_back(goal.trajectory.points.front());
    arm.give(2, goal, false);
    goal = goal_to(1, 1, 1);
    goal.path_tolerance = {{"wrist", 1, 0, 0}};
    arm.give(3, goal, false);
    goal = goal_to(1, 1, 1);
    goal.multi_dof_trajectory.points.resize(1);
    arm.give(4, goal, false);
    EXPECT_EQ(arm.action->take_notices().size(), 4u);
    EXPECT_EQ(arm.result({}).status, GoalStatus::kUnknown);
}

TEST(TrajectoryAction, ResetsOfTheRunEndTheGoal) {
    namespace si = ros2::simulation_interfaces;
    Arm arm;
    const ros2::Uuid goal = arm.give(1, goal_to(2, 0, 5));
    const Tick begin = arm.run.tick();
    ASSERT_TRUE(arm.run.until([&] { return arm.run.tick() > begin + 200; }));
    arm.run.call<si::ResetSimulation>("/reset_simulation", {});
    EXPECT_EQ(arm.result(goal).status, GoalStatus::kAborted);
}

/// The arm with Gazebo's controller on board.
std::string arm_with_controller() {
    std::string world = ball_and_arm();
    const std::string plugin = R"(<plugin name="c" filename="gz-sim-joint-trajectory-controller-system">
<joint_name>shoulder</joint_name><joint_name>elbow</joint_name>
<position_p_gain>2000</position_p_gain><position_d_gain>200</position_d_gain>
<position_p_gain>2000</position_p_gain><position_d_gain>200</position_d_gain></plugin>)";
    world.insert(world.rfind("</model>"), plugin);
    return world;
}

TEST(TrajectoryAction, OnBoardControllersFollowTheWholeTrajectory) {
    Arm arm(arm_with_controller());
    Action::Goal goal = goal_to(0.5, -0.3, 0.5);
    goal.goal_tolerance = {{"shoulder", 0.02, 0, 0}, {"elbow", 0.02, 0, 0}};
    const auto result = arm.result(arm.give(1, goal));
    EXPECT_EQ(result.status, GoalStatus::kSucceeded) << result.result.error_string;
    EXPECT_NEAR(arm.position("shoulder"), 0.5, 0.02);
    EXPECT_NEAR(arm.position("elbow"), -0.3, 0.02);
    goal.trajectory.joint_names = {"elbow"}, goal.trajectory.points[0].positions = {1};
    goal.goal_tolerance.clear();
    arm.give(2, goal, false);
}

}  // namespace
}  // namespace roboss::test
