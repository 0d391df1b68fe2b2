// The drives of classic Gazebo in the step.
#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

namespace roboss::test {
namespace {

TEST(RosDiffDrive, RimsKeepTheirAccelerationAndMotorsTheirTorque) {
    RosDiffDriveSpec spec;
    spec.left = {"left_joint"}, spec.right = {"right_joint"};
    spec.separations = {kSeparation}, spec.diameters = {2 * kWheelRadius};
    spec.acceleration = 0.5, spec.torque = 3, spec.ros.odometry_source = "encoder";
    Simulation sim(on_plane(with_onboard(two_wheeler(), spec)));
    sim.run(0.3);
    const double x = stand(sim).x;
    give(sim, "cmd_vel", {0.4, 0, 0, 0, 0, 0});
    sim.run(0.4 - sim.model->dt_s);
    EXPECT_NEAR(joint_velocity(sim, "left_joint") * kWheelRadius, 0.2, 1e-3) << "a t";
    EXPECT_EQ(sim.states[0].motors[0].max_effort, 3);
    sim.run(0.6);
    EXPECT_NEAR(joint_velocity(sim, "left_joint") * kWheelRadius, 0.4, 1e-6);
    EXPECT_NEAR(stand(sim).x - x, 0.4 * 0.4 / (2 * 0.5) + 0.4 * 0.2, 2e-3);
    EXPECT_NEAR(memory(sim)[0], stand(sim).x - x, 2e-3) << "odometry of the wheels";
}

TEST(RosSkidSteer, BothWheelsOfASideTurnEquallyFast) {
    RosSkidSteerSpec spec;
    spec.left_front = {"wheel_0"}, spec.right_front = {"wheel_1"};
    spec.left_rear = {"wheel_2"}, spec.right_rear = {"wheel_3"};
    spec.separation = 0.26, spec.diameter = 0.1, spec.torque = 2;
    Simulation sim(on_plane(with_onboard(car(), spec)));
    give(sim, "cmd_vel", {0.3, 0, 0, 0, 0, 0.5});
    sim.run(1);
    for (const std::size_t wheel : {0u, 2u})
        EXPECT_NEAR(sim.states[0].motors[wheel].target, (0.3 - 0.5 * 0.13) / 0.05, 1e-9);
    for (const std::size_t wheel : {1u, 3u})
        EXPECT_NEAR(sim.states[0].motors[wheel].target, (0.3 + 0.5 * 0.13) / 0.05, 1e-9);
    EXPECT_NEAR(memory(sim)[0], stand(sim).x, 1e-3) << "odometry is the true pose";
}

}  // namespace
}  // namespace roboss::test
