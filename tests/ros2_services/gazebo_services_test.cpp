// Scripts for Gazebo on a real run.
#include "ros2/gazebo_services.h"

#include "ros2_types/messages/gazebo_services.h"
#include "test_run.h"

namespace roboss::test {
namespace {

namespace gz = ros2::ros_gz_interfaces;

TEST(GazeboServices, ScriptsSpawnMoveStepAndRemove) {
    TestRun run(ball_and_arm());
    ros2::GazeboServices services(run.transport, run.transport.add_node("/", "roboss"), "hall",
                                  *run.services);
    run.take = [&](const ros2::Incoming& call) { EXPECT_TRUE(services.take(call)); };
    gz::SpawnEntity::Request create;
    create.entity_factory.name = "crate", create.entity_factory.sdf = box_model();
    create.entity_factory.pose.position = {3, 0, 9};
    EXPECT_TRUE(run.call<gz::SpawnEntity>("/world/hall/create", create).success);
    EXPECT_TRUE(run.model().find_robot("crate"));
    EXPECT_FALSE(run.call<gz::SpawnEntity>("/world/hall/create", create).success) << "the name is taken";

    gz::SetEntityPose::Request pose;
    pose.entity.name = "crate", pose.pose.position = {1, 2, 20};
    EXPECT_TRUE(run.call<gz::SetEntityPose>("/world/hall/set_pose", pose).success);
    gz::ControlWorld::Request control;
    control.world_control.pause = true, control.world_control.multi_step = 20;
    EXPECT_TRUE(run.call<gz::ControlWorld>("/world/hall/control", control).success);
    ASSERT_TRUE(run.until([&] { return run.tick() == 20 && run.control.tick() == 20; }));
    const RobotId crate = *run.model().find_robot("crate");
    EXPECT_NEAR(base_pose(run.control.states()[crate.index()]).p.z, 20, 0.01);
    control = {};
    control.world_control.seed = 4;
    EXPECT_FALSE(run.call<gz::ControlWorld>("/world/hall/control", control).success);

    EXPECT_TRUE(run.call<gz::DeleteEntity>("/world/hall/remove", {{0, "crate", 2}}).success);
    EXPECT_FALSE(run.model().find_robot("crate"));
    EXPECT_FALSE(run.call<gz::DeleteEntity>("/world/hall/remove", {{0, "crate", 2}}).success);
    control = {};
    control.world_control.pause = true, control.world_control.reset.all = true;
    EXPECT_TRUE(run.call<gz::ControlWorld>("/world/hall/control", control).success);
    EXPECT_EQ(run.tick(), 0);
    EXPECT_EQ(run.control.tick(), 0) << "the services see it before the reply";

    control = {};
    EXPECT_TRUE(run.call<gz::ControlWorld>("/world/hall/control", control).success) << "it plays";
    ASSERT_TRUE(run.until([&] { return run.tick() > 100; }));
    control.world_control.pause = true, control.world_control.reset.all = true;
    EXPECT_TRUE(run.call<gz::ControlWorld>("/world/hall/control", control).success);
    EXPECT_EQ(run.tick(), 0) << "it is paused at its beginning";
    control.world_control.run_to_sim_time = {0, 30'000'000};
    EXPECT_TRUE(run.call<gz::ControlWorld>("/world/hall/control", control).success);
    ASSERT_TRUE(run.until([&] { return run.paused() && run.tick() == 30; })) << "counted from the beginning";
}

}  // namespace
}  // namespace roboss::test
