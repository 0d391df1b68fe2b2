// The actions of a gripper on a real run: arrival, a stop on the way, cancelling, refusals.
#include "ros2/gripper_action.h"

#include "physics/dynamics/kinematics.h"
#include "ros2/action_server.h"
#include "ros2_types/messages/gripper_messages.h"
#include "ros2_types/messages/simulation_run_services.h"
#include "test_run.h"

namespace roboss::test {
namespace {

using ros2::GoalStatus, ros2::GripperCommand, ros2::ParallelGripperCommand;

constexpr const char* kFile = R"(
controller_manager: {ros__parameters: {
  hand: {type: position_controllers/GripperActionController},
  claw: {type: parallel_gripper_action_controller/GripperActionController},
  patient: {type: effort_controllers/GripperActionController}}}
hand: {ros__parameters: {joint: finger, stall_timeout: 0.2}}
claw: {ros__parameters: {joint: finger, stall_timeout: 0.2}}
patient: {ros__parameters: {joint: finger, stall_timeout: 0.2, allow_stalling: true}}
)";

/// A finger that slides from -0.1 to 0.1 m, with a block at 0.06 m in its way.
std::string hand() {
    return R"(<sdf version="1.9"><world name="hall"><gravity>0 0 0</gravity>
<model name="block"><static>true</static><link name="l"><pose>0.16 0 1 0 0 0</pose><collision name="c"><geometry><box>
<size>0.1 1 1</size></box></geometry></collision></link></model>
<model name="arm"><pose>0 0 1 0 0 0</pose><link name="palm"/><link name="tip"><collision name="c"><geometry><box>
<size>0.1 0.1 0.1</size></box></geometry></collision></link>
<joint name="weld" type="fixed"><parent>world</parent><child>palm</child></joint>
<joint name="finger" type="prismatic"><parent>palm</parent><child>tip</child><axis><xyz>1 0 0</xyz><limit>
<lower>-0.1</lower><upper>0.1</upper><effort>20</effort></limit></axis></joint></model></world></sdf>)";
}

struct Hand {
    TestRun run{hand()};
    ros2::Controllers controllers = ros2::parse_controllers("hands.yaml", kFile).value();
    std::vector<std::unique_ptr<ros2::RobotAction>> actions;

    Hand() {
        namespace si = ros2::simulation_interfaces;
        const RobotId arm = *run.model().find_robot("arm");
        const ros2::EntityId node = run.transport.add_node("/arm", "robot");
        for (const ros2::RobotController& gripper :
             ros2::controllers_of(controllers, run.model().type_of(arm), "arm"))
            actions.push_back(ros2::gripper_action(run.transport, node, "/" + gripper.entry->name,
                                                   run.control, arm, gripper));
        EXPECT_EQ(actions.size(), 3u);
        run.take = [this](const ros2::Incoming& call) {
            EXPECT_TRUE(std::ranges::any_of(actions, [&](const auto& action) { return action->take(call); }));
        };
        run.advance = [this](std::int64_t now_ms) {
            for (const auto& action : actions) action->advance(now_ms);
        };
        run.call<si::SetSimulationState>("/set_simulation_state", {{si::SimulationState::kPlaying}});
    }
    template <class A>
    ros2::Uuid give(const std::string& name, const typename A::Goal& goal, bool is_accepted = true) {
        typename ros2::SendGoal<A>::Request request{{}, goal};
        request.goal_id.uuid[0] = ++last_;
        const auto reply =
            run.call<ros2::SendGoal<A>>("/" + name + "/gripper_cmd/_action/send_goal", request);
        EXPECT_EQ(reply.accepted, is_accepted);
        return request.goal_id;
    }
    template <class A>
    auto result(const std::string& name, const ros2::Uuid& goal) {
        return run.call<ros2::GetResult<A>>("/" + name + "/gripper_cmd/_action/get_result", {goal});
    }
    double position() const {
        const RobotId arm = *run.model().find_robot("arm");
        const RobotType& type = run.model().type_of(arm);
        return joint_state(type, run.control.states()[arm.index()], *type.find_joint("finger")).position;
    }

  private:
    std::uint8_t last_ = 0;
};

TEST(GripperAction, ItArrives) {
    Hand hand;
    const auto result = hand.result<GripperCommand>("hand", hand.give<GripperCommand>("hand", {{-0.05, 5}}));
    EXPECT_EQ(result.status, GoalStatus::kSucceeded);
    EXPECT_TRUE(result.result.reached_goal);
    EXPECT_FALSE(result.result.stalled);
    EXPECT_NEAR(result.result.position, -0.05, 0.0101);
    const auto& feedback = hand.run.transport.published["/hand/gripper_cmd/_action/feedback"];
    ASSERT_FALSE(feedback.empty());
    EXPECT_TRUE(ros2::from_cdr<ros2::FeedbackMessage<GripperCommand>>(feedback.back()));
}

TEST(GripperAction, WhatStopsItEndsTheGoalAndItGoesOnPressing) {
    Hand hand;
    const auto stalled = hand.result<GripperCommand>("hand", hand.give<GripperCommand>("hand", {{0.09, 5}}));
    EXPECT_EQ(stalled.status, GoalStatus::kAborted);
    EXPECT_TRUE(stalled.result.stalled);
    EXPECT_NEAR(stalled.result.position, 0.06, 1e-3);
    EXPECT_NEAR(stalled.result.effort, 5, 0.1) << "the most that the goal allows";
    const auto held =
        hand.result<GripperCommand>("patient", hand.give<GripperCommand>("patient", {{0.09, 7}}));
    EXPECT_EQ(held.status, GoalStatus::kSucceeded);
    EXPECT_TRUE(held.result.stalled);
    EXPECT_NEAR(held.result.effort, 7, 0.1);
}

TEST(GripperAction, ParallelGrippersTakeTheStateOfTheirJoint) {
    Hand hand;
    ParallelGripperCommand::Goal goal;
    goal.command.name = {"finger"}, goal.command.position = {-0.08};
    const auto result =
        hand.result<ParallelGripperCommand>("claw", hand.give<ParallelGripperCommand>("claw", goal));
    EXPECT_EQ(result.status, GoalStatus::kSucceeded);
    EXPECT_EQ(result.result.state.name, std::vector<std::string>{"finger"});
    EXPECT_NEAR(result.result.state.position.at(0), -0.08, 0.0101);
    goal.command.name = {"thumb"};
    hand.give<ParallelGripperCommand>("claw", goal, false);
    goal.command.name.clear(), goal.command.position.clear();
    hand.give<ParallelGripperCommand>("claw", goal, false);
    EXPECT_EQ(hand.actions[1]->take_notices().size(), 2u);
}

TEST(GripperAction, CancelsResetsAndNumbersThatAreNone) {
    namespace si = ros2::simulation_interfaces;
    Hand hand;
    hand.give<GripperCommand>("hand", {{std::numeric_limits<double>::quiet_NaN(), 0}}, false);
    ros2::Uuid goal = hand.give<GripperCommand>("hand", {{0.09, 1}});
    ros2::CancelGoal::Request cancel;
    cancel.goal_info.goal_id = goal;
    hand.run.call<ros2::CancelGoal>("/hand/gripper_cmd/_action/cancel_goal", cancel);
    EXPECT_EQ(hand.result<GripperCommand>("hand", goal).status, GoalStatus::kCanceled);
    const Tick then = hand.run.tick();
    ASSERT_TRUE(hand.run.until([&] { return hand.run.tick() > then + 500; }));
    EXPECT_LT(hand.position(), 0.05) << "it holds where it was";
    goal = hand.give<GripperCommand>("hand", {{-0.09, 0.01}});
    hand.run.call<si::ResetSimulation>("/reset_simulation", {});
    EXPECT_EQ(hand.result<GripperCommand>("hand", goal).status, GoalStatus::kAborted);
}

}  // namespace
}  // namespace roboss::test
