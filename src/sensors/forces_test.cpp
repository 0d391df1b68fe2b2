// Altimeter, magnetometer, contact and force-torque sensor against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
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

/// A table on four legs of one link, whose sensors feel two legs, all, and the top.
TEST(ContactSensor, FeelsTheCollisionsThatItNames) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    test::place(world, test::ground(test::surface(0.5)), "ground");
    ModelSpec table = test::solid_box(4, {1, 1, 0.1}, test::surface(0.5));
    LinkSpec& link = table.links[0];
    link.collisions[0].name = "top";
    for (const double x : {-0.4, 0.4})
        for (const double y : {-0.4, 0.4}) {
            CollisionSpec leg = link.collisions[0];
            leg.name = "leg_" + std::to_string(link.collisions.size());
            leg.geometry.size = {0.1, 0.1, 0.5};
            leg.X_LS.p = {x, y, -0.3};
            link.collisions.push_back(leg);
        }
    const auto feels = [&](std::vector<std::string> names) {
        ContactSpec contact;
        contact.collisions = std::move(names);
        link.sensors.push_back(sensors_test::sensor("feels_" + std::to_string(link.sensors.size()), contact));
    };
    feels({"leg_1", "table::body::leg_2"});
    feels({"top", "leg_1", "leg_2", "leg_3", "leg_4"});
    feels({"top"});
    feels({"leg_3", "leg_5"});
    test::place(world, table, "table", {{0, 0, 0.55}, {}});
    test::Simulation sim(world);
    sim.run(1);
    const auto weight = [&](std::size_t sensor) {
        double up = 0;
        const auto reading = reading_of<ContactReading>(sim, 0, sensor);
        for (std::size_t i = 0; i < reading.count(); ++i) up += reading.forces[3 * i + 2];
        return up;
    };
    EXPECT_NEAR(weight(0), 2 * kG, 0.01);
    EXPECT_NEAR(weight(1), 4 * kG, 0.01);
    EXPECT_EQ(weight(2), 0);
    EXPECT_NEAR(weight(3), kG, 0.01) << "one that it does not have is left out";
    EXPECT_TRUE(sim.type(0).sensors[1].spec.as<ContactSpec>()->shapes.empty())
        << "the hash of a sensor of all";
}

TEST(ContactSensor, OfASceneryFeelsTheCollisionsThatItNames) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec shelf = test::solid_box(1, {1, 1, 0.1}, test::surface(0.5));
    shelf.is_static = true;
    LinkSpec& link = shelf.links[0];
    link.collisions[0].name = "low";
    link.collisions.push_back(link.collisions[0]);
    link.collisions[1].name = "high";
    link.collisions[1].X_LS.p = {5, 0, 1};
    ContactSpec contact;
    contact.collisions = {"high"};
    link.sensors = {sensors_test::sensor("high", contact)};
    const ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    test::place(world, shelf, "shelf");
    test::place(world, box, "on_low", {{0, 0, 0.1}, {}});
    test::place(world, box, "on_high", {{5, 0, 1.1}, {}});
    test::Simulation sim(world);
    sim.run(1);
    const auto reading = reading_of<ContactReading>(sim);
    double down = 0;
    for (std::size_t i = 0; i < reading.count(); ++i) {
        EXPECT_EQ(reading.others[i], 2) << "the box on the high board";
        down += reading.forces[3 * i + 2];
    }
    EXPECT_NEAR(down, -2 * kG, 0.01);
}

TEST(ContactSensor, ANameThatItsLinkDoesNotHaveIsAWarning) {
    World world = test::empty_world(1e-3);
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    ContactSpec contact;
    contact.collisions = {"bumper"};
    box.links[0].sensors = {sensors_test::sensor("feels", contact)};
    test::place(world, box, "box");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_NE(model, nullptr);
    EXPECT_TRUE(std::ranges::any_of(diagnostics.items(),
                                    [](const Diagnostic& d) { return d.code == "unknown-collision"; }));
    EXPECT_TRUE(model->types[0].sensors[0].spec.as<ContactSpec>()->shapes.empty()) << "all count";
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
