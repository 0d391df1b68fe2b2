// Altimeter, magnetometer, contact and force-torque sensor against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using sensors_test::reading_of;

constexpr double kG = 9.81;

TEST(Altimeter, ReadsTheHeightAboveTheStartAndTheClimbRate) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("alt", AltimeterSpec{}, {{0.2, 0, 0.1}, {}})};
    test::place(world, box, "box", {{0, 0, 10}, {}});
    test::Simulation sim(world);
    sim.states[0].v[5] = 3;
    sim.run(0.5);
    const auto reading = reading_of<AltimeterReading>(sim);
    EXPECT_NEAR(reading.vertical_position, 3 * 0.5 - 0.5 * kG * 0.25, 1e-9);
    EXPECT_NEAR(reading.vertical_velocity, 3 - kG * 0.5, 1e-9);
    EXPECT_NEAR(reading.reference, 10.1, 1e-12);
}

TEST(Magnetometer, ReadsTheFieldInItsOwnAxes) {
    World world = test::empty_world(1e-3);
    world.magnetic_field_T = {1e-5, 2e-5, -4e-5};
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("mag", MagnetometerSpec{}, {{}, from_rpy(0, 0, kPi / 2)})};
    test::place(world, box, "box", {{0, 0, 1}, from_rpy(0, 0, kPi / 2)});
    const test::Simulation sim(world);
    EXPECT_NEAR(norm(reading_of<MagnetometerReading>(sim).field_S - Vec3{-1e-5, -2e-5, -4e-5}), 0, 1e-18);
}

TEST(ContactSensor, ReadsTheWeightOfARestingBox) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, test::ground(test::surface(0.5)), "ground");
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("bumper", ContactSpec{}, {})};
    test::place(world, box, "lower", {{0, 0, 0.05}, {}});
    test::place(world, box, "upper", {{0, 0, 0.15}, {}});
    test::Simulation sim(world);
    sim.run(1);
    double up = 0, from_above = 0;
    const auto lower = reading_of<ContactReading>(sim);
    ASSERT_EQ(lower.positions.size(), 3 * lower.count());
    for (std::size_t i = 0; i < lower.count(); ++i)
        (lower.others[i] < 0 ? up : from_above) += lower.forces[3 * i + 2];
    EXPECT_NEAR(up, 4 * kG, 0.01);
    EXPECT_NEAR(from_above, -2 * kG, 0.01);
    double on_upper = 0;
    const auto upper = reading_of<ContactReading>(sim, 1);
    for (std::size_t i = 0; i < upper.count(); ++i) {
        EXPECT_EQ(upper.others[i], 0);
        EXPECT_NEAR(upper.normals[3 * i + 2], 1, 1e-9);
        on_upper += upper.forces[3 * i + 2];
    }
    EXPECT_NEAR(on_upper, 2 * kG, 0.01);
}

/// A rod of 2 kg and 1 m that a position motor holds out level from a fixed hinge.
TEST(ForceTorqueSensor, ReadsTheWeightAndItsMomentInStaticEquilibrium) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec arm = test::pendulum(2, 1);
    ForceTorqueSpec sensor;
    sensor.joint = arm.joints[0].name, sensor.measure_direction = "parent_to_child";
    arm.links.back().sensors = {sensors_test::sensor("on_child", sensor, {})};
    sensor.measure_direction = "child_to_parent", sensor.frame = "parent";
    arm.links.back().sensors.push_back(sensors_test::sensor("on_parent", sensor, {}));
    test::place(world, arm, "arm", {{0, 0, 2}, {}});
    test::Simulation sim(world);
    sim.states[0].q[7] = -kPi / 2;  // along +x or -x
    sim.set_motor(0, 0, MotorMode::kPosition, -kPi / 2);
    sim.run(1);
    const LinkId rod(sim.type(0).links.size() - 1);
    const Transform X_WL = link_pose(sim.type(0), sim.states[0], rod);
    const Vec3 arm_W = X_WL.R * Vec3{0, 0, -0.5};
    const auto on_child = reading_of<ForceTorqueReading>(sim);
    EXPECT_NEAR(norm(X_WL.R * on_child.force - Vec3{0, 0, 2 * kG}), 0, 1e-3);
    EXPECT_NEAR(norm(X_WL.R * on_child.torque + cross(arm_W, Vec3{0, 0, -2 * kG})), 0, 1e-3);
    const auto on_parent = reading_of<ForceTorqueReading>(sim, 0, 1);
    EXPECT_NEAR(norm(on_parent.force - Vec3{0, 0, -2 * kG}), 0, 1e-3);
    EXPECT_NEAR(norm(on_parent.torque - cross(arm_W, Vec3{0, 0, -2 * kG})), 0, 1e-3);
}

}  // namespace
}  // namespace roboss
