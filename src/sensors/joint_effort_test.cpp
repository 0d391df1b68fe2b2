// What joints pass on, against static equilibrium: the effort sensor, joints to the world, and the sum of all
// wrenches.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using sensors_test::reading_of;

constexpr double kG = 9.81;

/// A rod of 2 kg and 1 m that a position motor holds out level from a fixed hinge.
TEST(JointEffort, IsTheTorqueThatHoldsAnArmLevel) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec arm = test::pendulum(2, 1);
    JointEffortSpec sensor;
    sensor.joints = {arm.joints[0].name};
    arm.links.back().sensors = {sensors_test::sensor("effort", sensor, {})};
    test::place(world, arm, "arm", {{0, 0, 2}, {}});
    for (const double angle : {-kPi / 2, kPi / 2}) {
        test::Simulation sim(world);
        sim.states[0].q[7] = angle;
        sim.set_motor(0, 0, MotorMode::kPosition, angle);
        sim.run(1);
        const auto reading = reading_of<JointEffortReading>(sim);
        ASSERT_EQ(reading.efforts.size(), 1u);
        EXPECT_NEAR(std::fabs(reading.efforts[0]), 2 * kG * 0.5, 1e-3);
        // it drives the joint against the weight, which drives it back to zero
        EXPECT_EQ(reading.efforts[0] > 0, angle > 0);
        EXPECT_NEAR(reading.efforts[0], sim.states[0].motors[0].impulse / 1e-3, 1e-3)
            << "all of it the motor's";
    }
}

/// Two boxes on a vertical slide, the file's child above or below: the motor carries what hangs on it.
TEST(JointEffort, OfASlideIsTheForceAlongItAndCountsOnTheFilesChild) {
    for (const bool child_carries : {false, true}) {
        World world = test::empty_world(1e-3, {0, 0, -kG});
        ModelSpec lift;
        lift.name = "lift";
        const auto block = [](const std::string& name, double mass, double z) {
            LinkSpec link = test::solid_box(mass, {0.2, 0.2, 0.2}, test::surface(0.5)).links[0];
            link.name = name, link.X_ML.p = {0, 0, z};
            link.collisions.clear();
            return link;
        };
        lift.links = {block("foot", 5, 0), block("load", 3, 1)};
        const std::string base = "foot";
        lift.joints.push_back(test::joint(JointSpecKind::kFixed, "weld", "world", base, {}));
        lift.joints.push_back(test::joint(JointSpecKind::kPrismatic, "slide", child_carries ? "load" : "foot",
                                          child_carries ? "foot" : "load", {}, {0, 0, 1}));
        JointEffortSpec effort;
        effort.joints = {"slide"};
        ForceTorqueSpec weld;
        weld.joint = "weld", weld.measure_direction = "parent_to_child", weld.frame = "parent";
        lift.links[0].sensors = {sensors_test::sensor("effort", effort), sensors_test::sensor("weld", weld)};
        test::place(world, lift, "lift", {{0, 0, 2}, {}});
        test::Simulation sim(world);
        sim.set_motor(0, 0, MotorMode::kPosition, 0);
        sim.run(0.5);
        const double expected = child_carries ? -3 * kG : 3 * kG;  // on the child
        EXPECT_NEAR(reading_of<JointEffortReading>(sim).efforts.at(0), expected, 1e-3) << child_carries;
        // the joint to the world carries all: the sum of all wrenches is zero
        const auto held = reading_of<ForceTorqueReading>(sim, 0, 1);
        EXPECT_NEAR(norm(held.force - Vec3{0, 0, 8 * kG}), 0, 1e-3) << child_carries;
        EXPECT_NEAR(norm(held.torque), 0, 1e-3) << child_carries;
    }
}

}  // namespace
}  // namespace roboss
