// A URDF as robots have it, driven by the file of its ros2_control.
#include <gtest/gtest.h>

#include <support/drives.h>

#include "app/run/run_options.h"
#include "ros2/controllers_file.h"
#include "sdf/load_world.h"
#include "world/bare_model.h"

namespace roboss {
namespace {

/// Two wheels of 0.1 m, 0.4 m apart, and a caster without friction under the tail; it stands on z = 0.
constexpr const char* kRover = R"(<?xml version="1.0"?>
<robot name="rover">
  <link name="base_link">
    <inertial><origin xyz="-0.03 0 0.1"/><mass value="5"/>
      <inertia ixx="0.05" iyy="0.07" izz="0.09" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision name="caster"><origin xyz="-0.2 0 0.05"/><geometry><sphere radius="0.05"/></geometry></collision>
    <collision name="nose"><origin xyz="0.2 0 0.06"/><geometry><sphere radius="0.05"/></geometry></collision>
  </link>
  <gazebo reference="base_link"><mu1>0</mu1><mu2>0</mu2></gazebo>
  <link name="left_tire">
    <inertial><mass value="0.5"/><inertia ixx="0.0025" iyy="0.0025" izz="0.0025" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <link name="right_tire">
    <inertial><mass value="0.5"/><inertia ixx="0.0025" iyy="0.0025" izz="0.0025" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <joint name="left_wheel" type="continuous"><parent link="base_link"/><child link="left_tire"/>
    <origin xyz="0 0.2 0.1"/><axis xyz="0 1 0"/><limit effort="5" velocity="30"/></joint>
  <joint name="right_wheel" type="continuous"><parent link="base_link"/><child link="right_tire"/>
    <origin xyz="0 -0.2 0.1"/><axis xyz="0 1 0"/><limit effort="5" velocity="30"/></joint>
</robot>)";

constexpr const char* kControllers = R"(
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster:
      type: joint_state_broadcaster/JointStateBroadcaster
    diff_cont:
      type: diff_drive_controller/DiffDriveController
diff_cont:
  ros__parameters:
    left_wheel_names: ['left_wheel']
    right_wheel_names: ['right_wheel']
    wheel_separation: 0.4
    wheel_radius: 0.1
    publish_rate: 25.0
    base_frame_id: base_link
    linear.x.has_acceleration_limits: true
    linear.x.max_acceleration: 2.0
)";

TEST(DrivenUrdf, DrivesAtTheCommandedVelocity) {
    Diagnostics diagnostics;
    std::optional<World> world = load_world_text(kRover, "rover.urdf", {}, diagnostics);
    ASSERT_TRUE(world);
    BareModelOptions bare;
    bare.ground = true;
    ASSERT_TRUE(complete(*world, bare));
    RunOptions options;
    const Result<ros2::Controllers> controllers = ros2::parse_controllers("c.yaml", kControllers);
    ASSERT_TRUE(controllers) << controllers.error().text();
    EXPECT_TRUE(controllers.value().notices.empty());
    options.ros2.face.topics.controllers = std::make_shared<const ros2::Controllers>(controllers.value());
    options.foxglove.face.topics.controllers = options.ros2.face.topics.controllers;  // it counts once
    add_drives(options, "", *world);

    test::Simulation sim(*world);
    ASSERT_EQ(sim.type(0).onboard.size(), 2u);
    ASSERT_EQ(sim.type(0).sensors.size(), 1u);
    EXPECT_EQ(sim.type(0).sensors[0].spec.update_rate_hz, 25);
    sim.run(0.5);
    const auto drive = [&](double speed, double turn) {
        for (int i = 0; i < 4; ++i) {
            test::give(sim, "diff_cont/cmd_vel", {speed, 0, 0, 0, 0, turn});
            sim.run(0.2);
        }
    };
    drive(0.5, 0);
    EXPECT_NEAR(test::joint_velocity(sim, "left_wheel"), 0.5 / 0.1, 1e-3) << "speed = radius * rate";
    EXPECT_NEAR(test::joint_velocity(sim, "right_wheel"), 0.5 / 0.1, 1e-3);
    const double x = test::stand(sim).x;
    sim.run(0.25);
    EXPECT_NEAR(test::stand(sim).x - x, 0.5 * 0.25, 2e-3);
    EXPECT_NEAR(test::memory(sim, 0, 1)[3], 0.5, 1e-3) << "the odometry's velocity";
    drive(0, 1);
    EXPECT_NEAR(test::joint_velocity(sim, "left_wheel"), -0.5 * 0.4 / 0.1, 1e-3);
    EXPECT_NEAR(test::joint_velocity(sim, "right_wheel"), 0.5 * 0.4 / 0.1, 1e-3);
    sim.run(1);
    EXPECT_NEAR(test::joint_velocity(sim, "left_wheel"), 0, 1e-3) << "no command for 0.5 s";
}

}  // namespace
}  // namespace roboss
