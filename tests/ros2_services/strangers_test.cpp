// Damaged requests to every service get a reply or none, and the services stay.
#include <random>

#include "ros2/gazebo_services.h"
#include "ros2/gripper_action.h"
#include "ros2/node_parameters.h"
#include "ros2/trajectory_action.h"
#include "ros2_types/messages/simulation_run_services.h"
#include "test_run.h"

namespace roboss::test {
namespace {

namespace si = ros2::simulation_interfaces;

TEST(Strangers, AnyBytesAreSurvivedByAllServices) {
    TestRun run(ball_and_arm());
    const ros2::EntityId node = run.transport.add_node("/", "roboss");
    ros2::GazeboServices gazebo(run.transport, node, "hall", *run.services);
    ros2::NodeParameters parameters(run.transport, node, "/roboss");
    const RobotId arm = *run.model().find_robot("arm");
    const auto action = ros2::trajectory_action(run.transport, node, "/arm/follow", run.control, arm,
                                                ros2::TrajectoryJoints::of(run.model().type_of(arm)), true);
    const ros2::Controllers controllers = ros2::parse_controllers("hands.yaml", R"(
controller_manager: {ros__parameters: {
  hand: {type: position_controllers/GripperActionController},
  claw: {type: parallel_gripper_action_controller/GripperActionController}}}
hand: {ros__parameters: {joint: elbow}}
claw: {ros__parameters: {joint: elbow}}
)")
                                              .value();
    std::vector<std::unique_ptr<ros2::RobotAction>> grippers;
    for (const ros2::RobotController& gripper :
         ros2::controllers_of(controllers, run.model().type_of(arm), "arm"))
        grippers.push_back(ros2::gripper_action(run.transport, node, "/arm/" + gripper.entry->name,
                                                run.control, arm, gripper));
    ASSERT_EQ(grippers.size(), 2u);
    run.take = [&](const ros2::Incoming& call) {
        EXPECT_TRUE(gazebo.take(call) || parameters.take(call) || action->take(call) ||
                    grippers[0]->take(call) || grippers[1]->take(call));
    };
    std::mt19937 random(11);
    const std::string sane = ros2::to_cdr(si::GetEntities::Request{{"b", {{1}}, {{"x"}, 1}, {3, {{}, {}}}}});
    const auto services = run.transport.services;
    for (int round = 0; round < 4'000; ++round) {
        auto service = services.begin();
        std::advance(service, static_cast<std::ptrdiff_t>(random() % services.size()));
        if (service->first == "/set_simulation_state") continue;  // it would end the run, as asked for
        std::string bytes = round % 3 == 0 ? sane : std::string(random() % 80, '\0');
        for (char& byte : bytes)
            if (round % 3 == 1 || random() % 8 == 0) byte = static_cast<char>(random());
        if (bytes.size() > 4 && round % 2 == 0) bytes.replace(0, 4, std::string("\0\1\0\0", 4));
        run.transport.call(service->first, bytes);
        run.turn();
    }
    for (int i = 0; i < 500; ++i) run.turn();
    EXPECT_FALSE(run.call<si::GetSimulatorFeatures>("/get_simulator_features", {}).features.features.empty());
}

}  // namespace
}  // namespace roboss::test
