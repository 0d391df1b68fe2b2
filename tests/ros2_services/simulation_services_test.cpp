// simulation_interfaces on a real run: what tools do with a simulator, and what strangers send.
#include <cmath>

#include "ros2/action_server.h"
#include "ros2_types/messages/simulation_run_services.h"
#include "ros2_types/messages/simulation_services_v1.h"
#include "test_run.h"

namespace roboss::test {
namespace {

namespace si = ros2::simulation_interfaces;
using State = si::SimulationState;
using Code = si::Result;

std::uint8_t state_of(TestRun& run) {
    return run.call<si::GetSimulationState>("/get_simulation_state", {}).state.state;
}

std::uint8_t set_state(TestRun& run, std::uint8_t state) {
    return run.call<si::SetSimulationState>("/set_simulation_state", {{state}}).result.result;
}

std::vector<std::string> entities(TestRun& run, const si::EntityFilters& filters = {}) {
    return run.call<si::GetEntities>("/get_entities", {filters}).entities;
}

si::SpawnEntity::Response spawn(TestRun& run, const si::SpawnEntity::Request& request) {
    return run.call<si::SpawnEntity>("/spawn_entity", request);
}

si::SpawnEntity::Request box(const std::string& name, bool may_rename = false) {
    si::SpawnEntity::Request request;
    request.name = name, request.allow_renaming = may_rename;
    request.entity_resource.resource_string = box_model();
    request.initial_pose.pose.position = {3, 4, 5};
    return request;
}

double height(TestRun& run, const std::string& name) {
    return run.call<si::GetEntityState>("/get_entity_state", {name}).state.pose.position.z;
}

TEST(SimulationServices, AllServicesOfTheStandardAreThere) {
    TestRun run(ball_and_arm());
    std::size_t services = 0;
    for (const auto& [name, type] : run.transport.types)
        services += type.starts_with("simulation_interfaces/srv/") ? 1 : 0;
    EXPECT_EQ(services, 22u);
    EXPECT_EQ(run.transport.types["/simulate_steps/_action/send_goal"],
              "simulation_interfaces/action/SimulateSteps_SendGoal");
    EXPECT_TRUE(run.services->take_notices().empty());
}

TEST(SimulationServices, StatesFollowTheStandard) {
    TestRun run(ball_and_arm());
    EXPECT_EQ(state_of(run), State::kStopped);
    EXPECT_EQ(set_state(run, State::kStopped), si::SetSimulationState::Response::kAlreadyInTargetState);
    EXPECT_EQ(set_state(run, State::kPaused), Code::kOk);
    EXPECT_EQ(state_of(run), State::kPaused);
    EXPECT_EQ(run.tick(), 0);
    EXPECT_EQ(set_state(run, State::kPlaying), Code::kOk);
    EXPECT_TRUE(run.until([&] { return run.tick() > 100; }));
    EXPECT_EQ(state_of(run), State::kPlaying);
    EXPECT_EQ(set_state(run, State::kPaused), Code::kOk);
    EXPECT_EQ(state_of(run), State::kPaused);
    EXPECT_EQ(set_state(run, State::kStopped), Code::kOk);
    EXPECT_EQ(state_of(run), State::kStopped);
    EXPECT_EQ(run.tick(), 0);
    EXPECT_EQ(set_state(run, State::kNoWorld), si::SetSimulationState::Response::kIncorrectTransition);
    EXPECT_EQ(set_state(run, 77), si::SetSimulationState::Response::kIncorrectTransition);
}

TEST(SimulationServices, StepsAreDoneWhenTheReplyComes) {
    TestRun run(ball_and_arm());
    EXPECT_EQ(run.call<si::StepSimulation>("/step_simulation", {25}).result.result, Code::kOk);
    EXPECT_EQ(run.tick(), 25);
    EXPECT_TRUE(run.paused());
    EXPECT_EQ(run.call<si::StepSimulation>("/step_simulation", {0}).result.result, Code::kOk);
    EXPECT_EQ(run.call<si::StepSimulation>("/step_simulation", {~0ull}).result.result,
              Code::kOperationFailed);
    set_state(run, State::kPlaying);
    EXPECT_EQ(run.call<si::StepSimulation>("/step_simulation", {5}).result.result, Code::kOperationFailed);
}

TEST(SimulationServices, SimulateStepsReportsAndCanBeCancelled) {
    TestRun run(ball_and_arm());
    ros2::SendGoal<si::SimulateSteps>::Request goal;
    goal.goal_id.uuid[0] = 1, goal.goal.steps = 60;
    EXPECT_TRUE(
        run.call<ros2::SendGoal<si::SimulateSteps>>("/simulate_steps/_action/send_goal", goal).accepted);
    const auto result =
        run.call<ros2::GetResult<si::SimulateSteps>>("/simulate_steps/_action/get_result", {goal.goal_id});
    EXPECT_EQ(result.status, ros2::GoalStatus::kSucceeded);
    EXPECT_EQ(result.result.result.result, Code::kOk);
    EXPECT_EQ(run.tick(), 60);
    EXPECT_FALSE(run.transport.published["/simulate_steps/_action/feedback"].empty());

    goal.goal_id.uuid[0] = 2, goal.goal.steps = 1'000'000;
    EXPECT_TRUE(
        run.call<ros2::SendGoal<si::SimulateSteps>>("/simulate_steps/_action/send_goal", goal).accepted);
    ASSERT_TRUE(run.until([&] { return run.tick() > 200; }));
    ros2::CancelGoal::Request cancel;
    cancel.goal_info.goal_id = goal.goal_id;
    const auto cancelled = run.call<ros2::CancelGoal>("/simulate_steps/_action/cancel_goal", cancel);
    EXPECT_EQ(cancelled.return_code, ros2::CancelGoal::Response::kNone);
    EXPECT_EQ(cancelled.goals_canceling.size(), 1u);
    const auto end =
        run.call<ros2::GetResult<si::SimulateSteps>>("/simulate_steps/_action/get_result", {goal.goal_id});
    EXPECT_EQ(end.status, ros2::GoalStatus::kCanceled);
    EXPECT_TRUE(run.paused());
    EXPECT_EQ(run.call<ros2::CancelGoal>("/simulate_steps/_action/cancel_goal", cancel).return_code,
              ros2::CancelGoal::Response::kGoalTerminated);
}

TEST(SimulationServices, ACancelEndsStepsHoweverFarTheyAre) {
    for (int turns = 0; turns < 6; ++turns) {
        TestRun run(ball_and_arm());
        ros2::SendGoal<si::SimulateSteps>::Request goal;
        goal.goal_id.uuid[0] = 1, goal.goal.steps = 1'000'000;
        run.transport.call("/simulate_steps/_action/send_goal", ros2::to_cdr(goal));
        for (int turn = 0; turn < turns; ++turn) run.turn();
        ros2::CancelGoal::Request cancel;
        cancel.goal_info.goal_id = goal.goal_id;
        const auto cancelled = run.call<ros2::CancelGoal>("/simulate_steps/_action/cancel_goal", cancel);
        EXPECT_EQ(cancelled.goals_canceling.size(), 1u);
        const auto end = run.call<ros2::GetResult<si::SimulateSteps>>("/simulate_steps/_action/get_result",
                                                                      {goal.goal_id});
        EXPECT_EQ(end.status, ros2::GoalStatus::kCanceled) << "cancelled after " << turns << " turns";
        EXPECT_TRUE(run.paused());
    }
}

TEST(SimulationServices, EntitiesComeAndGo) {
    TestRun run(ball_and_arm());
    EXPECT_EQ(entities(run), (std::vector<std::string>{"ball", "arm"}));
    const auto spawned = spawn(run, box("crate"));
    EXPECT_EQ(spawned.result.result, Code::kOk) << spawned.result.error_message;
    EXPECT_EQ(spawned.entity_name, "crate");
    EXPECT_EQ(entities(run), (std::vector<std::string>{"ball", "arm", "crate"}));
    const auto state = run.call<si::GetEntityState>("/get_entity_state", {"crate"});
    EXPECT_EQ(state.result.result, Code::kOk);
    EXPECT_NEAR(state.state.pose.position.x, 3, 1e-9);
    EXPECT_NEAR(state.state.pose.position.z, 5, 1e-9) << "the pose in the file does not add up";
    EXPECT_EQ(state.state.header.frame_id, "world");
    EXPECT_EQ(run.call<si::DeleteEntity>("/delete_entity", {"crate"}).result.result, Code::kOk);
    EXPECT_EQ(entities(run), (std::vector<std::string>{"ball", "arm"}));
    EXPECT_EQ(run.call<si::DeleteEntity>("/delete_entity", {"crate"}).result.result, Code::kNotFound);
}

TEST(SimulationServices, SpawningNamesWhatIsWrong) {
    using Codes = si::SpawnEntity::Response;
    TestRun run(ball_and_arm());
    const auto code = [&](const si::SpawnEntity::Request& request) {
        return spawn(run, request).result.result;
    };
    EXPECT_EQ(code(box("ball")), Codes::kNameNotUnique);
    EXPECT_EQ(spawn(run, box("ball", true)).entity_name, "ball_2");
    EXPECT_EQ(spawn(run, box("")).entity_name, "box") << "the name of the description";
    EXPECT_EQ(code(box("a\nb")), Codes::kNameInvalid);
    si::SpawnEntity::Request request = box("");
    request.entity_resource.resource_string = box_model("");
    EXPECT_EQ(code(request), Codes::kNameInvalid);
    request = box("b");
    request.entity_resource = {};
    EXPECT_EQ(code(request), Codes::kNoResource);
    request.entity_resource.resource_string = "<usd/>";
    EXPECT_EQ(code(request), Codes::kUnsupportedFormat);
    request.entity_resource.resource_string = "<sdf";
    EXPECT_EQ(code(request), Codes::kResourceParseError);
    request.entity_resource.resource_string = "<sdf version='1.9'><model name='m'><link/></model></sdf>";
    EXPECT_EQ(code(request), Codes::kResourceParseError);
    request.entity_resource.uri = "file:///etc/hostname.sdf";
    EXPECT_EQ(code(request), Code::kNotFound);
    request = box("b");
    request.initial_pose.pose.orientation = {0, 0, 0, 0};
    EXPECT_EQ(code(request), Codes::kInvalidPose);
    request.initial_pose.pose.orientation = {0, 0, 0, 1};
    request.initial_pose.header.frame_id = "nowhere";
    EXPECT_EQ(code(request), Codes::kInvalidPose);
    request.initial_pose.header.frame_id = "arm";
    EXPECT_EQ(code(request), Code::kOk);
    EXPECT_NEAR(run.call<si::GetEntityState>("/get_entity_state", {"b"}).state.pose.position.x, 8, 1e-9);
    request = box("c");
    request.entity_namespace = "a b";
    EXPECT_EQ(code(request), Codes::kNamespaceInvalid);
    request.entity_namespace = "/fleet";
    EXPECT_EQ(spawn(run, request).entity_name, "fleet::c");
}

TEST(SimulationServices, SeveralAreSpawnedByOneCall) {
    TestRun run(ball_and_arm());
    si::SpawnEntities::Request request;
    for (const char* name : {"a", "ball", "c"}) {
        const si::SpawnEntity::Request one = box(name);
        request.spawn_requests.push_back({one.name, false, one.entity_resource, "", one.initial_pose});
    }
    const auto response = run.call<si::SpawnEntities>("/spawn_entities", request);
    EXPECT_EQ(response.result.result, si::SpawnEntities::Response::kEntitiesSpawnFailed);
    ASSERT_EQ(response.results.size(), 3u);
    EXPECT_EQ(response.results[0].entity_name, "a");
    EXPECT_EQ(response.results[1].result.result, si::SpawnResult::kNameNotUnique);
    EXPECT_EQ(response.results[2].entity_name, "c");
}

TEST(SimulationServices, AFloodOfDescriptionsIsRefused) {
    TestRun run(ball_and_arm());
    std::vector<std::int64_t> calls;
    const auto ask = [&](const si::SpawnEntity::Request& request) {
        calls.push_back(run.transport.call("/spawn_entity", ros2::to_cdr(request), ""));
    };
    ask(box("first"));
    si::SpawnEntity::Request large = box("large");
    large.entity_resource.resource_string.assign(std::size_t{8} << 20, 'x');
    for (int i = 0; i < 20; ++i) ask(large);
    std::map<std::uint8_t, int> codes;
    for (const std::int64_t call : calls)
        ++codes[ros2::from_cdr<si::SpawnEntity::Response>(run.wait_for(call)).value().result.result];
    EXPECT_EQ(codes[Code::kOk], 1);
    EXPECT_EQ(codes[si::SpawnEntity::Response::kResourceParseError], 7) << "those that had room to wait";
    EXPECT_EQ(codes[Code::kOperationFailed], 13);
    EXPECT_EQ(spawn(run, box("later")).entity_name, "later");
}

TEST(SimulationServices, StatesAreSetAsFarAsTheRequestSays) {
    TestRun run(ball_and_arm());
    si::SetEntityState::Request request;
    request.entity = "ball", request.state.pose.position = {0, 0, 7}, request.state.twist.linear = {1, 0, 0};
    const auto code = [&] {
        return run.call<si::SetEntityState>("/set_entity_state", request).result.result;
    };
    EXPECT_EQ(code(), Code::kOk);
    run.call<si::StepSimulation>("/step_simulation", {10});
    EXPECT_LT(height(run, "ball"), 2) << "nothing is set";
    request.set_pose = request.set_twist = true;
    EXPECT_EQ(code(), Code::kOk);
    run.call<si::StepSimulation>("/step_simulation", {10});
    const auto moved = run.call<si::GetEntityState>("/get_entity_state", {"ball"}).state;
    EXPECT_NEAR(moved.pose.position.z, 7, 0.01);
    EXPECT_NEAR(moved.twist.linear.x, 1, 1e-6);
    request.entity = "arm";
    EXPECT_EQ(code(), Code::kOperationFailed) << "its base is fixed";
    request.entity = "nobody";
    EXPECT_EQ(code(), Code::kNotFound);
    request.entity = "ball", request.state.pose.orientation = {2, 0, 0, 0};
    EXPECT_EQ(code(), si::SetEntityState::Response::kInvalidPose);
}

TEST(SimulationServices, ClientsOfVersion1AreUnderstood) {
    namespace v1 = ros2::simulation_interfaces_v1;
    TestRun run(ball_and_arm());
    v1::SetEntityState::Request request;
    request.entity = "ball", request.state.pose.position = {0, 0, 7};
    EXPECT_EQ(run.call<v1::SetEntityState>("/set_entity_state", request).result.result, Code::kOk);
    run.call<si::StepSimulation>("/step_simulation", {10});
    EXPECT_NEAR(height(run, "ball"), 7, 0.01) << "1.x sets everything";
    const auto spawnables = run.call<v1::GetSpawnables>("/get_spawnables", {{"web"}},
                                                        ros2::type_of_service<v1::GetSpawnables>().hash);
    EXPECT_EQ(spawnables.result.result, Code::kOk);
    EXPECT_NE(spawnables.result.error_message.find("web"), std::string::npos);
    v1::SpawnEntity::Request box_of_1;
    box_of_1.name = "old", box_of_1.resource_string = box_model();
    EXPECT_EQ(run.call<v1::SpawnEntity>("/spawn_entity", box_of_1).entity_name, "old");
}

TEST(SimulationServices, FiltersSelect) {
    TestRun run(ball_and_arm());
    spawn(run, box("crate_1"));
    si::EntityFilters filters;
    filters.filter = "^crate_[0-9]+$|^ball$";
    EXPECT_EQ(entities(run, filters), (std::vector<std::string>{"ball", "crate_1"}));
    filters.filter = "(";
    EXPECT_EQ(run.call<si::GetEntities>("/get_entities", {filters}).result.result, Code::kOperationFailed);
    filters.filter = "((a{255}){255}){255}";
    EXPECT_EQ(run.call<si::GetEntities>("/get_entities", {filters}).result.result, Code::kOperationFailed);
    filters = {};
    filters.categories = {{si::EntityCategory::kRobot}};
    EXPECT_EQ(entities(run, filters), (std::vector<std::string>{"arm"}));
    EXPECT_EQ(
        run.call<si::SetEntityInfo>("/set_entity_info",
                                    {"ball", {{si::EntityCategory::kDynamicObject}, "round", {"toy", "red"}}})
            .result.result,
        Code::kOk);
    filters = {};
    filters.tags = {{"red", "blue"}, si::TagsFilter::kAny};
    EXPECT_EQ(entities(run, filters), (std::vector<std::string>{"ball"}));
    filters.tags.filter_mode = si::TagsFilter::kAll;
    EXPECT_TRUE(entities(run, filters).empty());
    filters = {};
    filters.bounds = {si::Bounds::kSphere, {{3, 4, 6}, {0.7, 0, 0}}};
    EXPECT_EQ(entities(run, filters), (std::vector<std::string>{"crate_1"}));
    filters.bounds = {si::Bounds::kBox, {{1, 1, 3}, {-1, -1, 1}}};
    EXPECT_EQ(entities(run, filters), (std::vector<std::string>{"ball"}));
    filters.bounds.type = si::Bounds::kConvexHull;
    EXPECT_EQ(run.call<si::GetEntities>("/get_entities", {filters}).result.result, Code::kFeatureUnsupported);
    const auto bounds = run.call<si::GetEntityBounds>("/get_entity_bounds", {"ball"}).bounds;
    ASSERT_EQ(bounds.type, si::Bounds::kBox);
    EXPECT_NEAR(bounds.points[0].z, 0.5, 1e-9) << "along its canonical link";
    filters = {};
    filters.tags.tags.resize(1'000);
    EXPECT_EQ(run.call<si::GetEntities>("/get_entities", {filters}).result.result, Code::kOperationFailed);
    filters = {};
    filters.categories.resize(1'000);
    EXPECT_EQ(run.call<si::GetEntities>("/get_entities", {filters}).result.result, Code::kOperationFailed);
    EXPECT_NEAR(bounds.points[1].z, -0.5, 1e-9);
}

TEST(SimulationServices, ResetsHaveScopes) {
    using Scope = si::ResetSimulation::Request;
    TestRun run(ball_and_arm());
    const auto reset = [&](std::uint8_t scope) {
        return run.call<si::ResetSimulation>("/reset_simulation", {scope}).result.result;
    };
    spawn(run, box("crate"));
    run.call<si::StepSimulation>("/step_simulation", {200});
    EXPECT_LT(height(run, "ball"), 1.9);
    EXPECT_EQ(reset(Scope::kTime), Code::kFeatureUnsupported);
    EXPECT_EQ(reset(Scope::kState), Code::kOk);
    run.call<si::StepSimulation>("/step_simulation", {10});
    EXPECT_NEAR(height(run, "ball"), 2, 0.01);
    EXPECT_EQ(run.tick(), 210) << "time goes on";
    EXPECT_EQ(reset(Scope::kSpawned), Code::kOk);
    EXPECT_EQ(entities(run), (std::vector<std::string>{"ball", "arm"}));
    EXPECT_EQ(reset(Scope::kDefault), Code::kOk);
    EXPECT_EQ(run.tick(), 0);
    EXPECT_EQ(run.control.tick(), 0) << "the services see it before the reply";
    EXPECT_EQ(state_of(run), State::kStopped);
}

TEST(SimulationServices, WorldsAreThoseThatARunCanHave) {
    TestRun run(ball_and_arm());
    const auto world = run.call<si::GetCurrentWorld>("/get_current_world", {});
    EXPECT_EQ(world.world.name, "hall");
    EXPECT_EQ(world.world.world_resource.uri, "test.sdf");
    run.call<si::StepSimulation>("/step_simulation", {20});
    EXPECT_EQ(run.call<si::LoadWorld>("/load_world", {{"other.sdf", ""}, false, false}).result.result,
              Code::kFeatureUnsupported);
    EXPECT_EQ(run.call<si::LoadWorld>("/load_world", {{"test.sdf", ""}, false, false}).result.result,
              Code::kOk);
    EXPECT_EQ(run.tick(), 0);
    EXPECT_EQ(run.call<si::UnloadWorld>("/unload_world", {}).result.result, Code::kFeatureUnsupported);
    EXPECT_EQ(run.call<si::GetNamedPoses>("/get_named_poses", {}).result.result, Code::kFeatureUnsupported);
}

}  // namespace
}  // namespace roboss::test
