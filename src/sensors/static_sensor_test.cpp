// Sensors on static models: a lidar on a mast is read like any other, does not see its mast, and cannot be
// ordered about.
#include <gtest/gtest.h>

#include "model/order.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

ModelSpec static_box(const std::string& name, const Vec3& size) {
    ModelSpec spec;
    spec.name = name;
    spec.is_static = true;
    spec.links.resize(1);
    spec.links[0].name = "body";
    CollisionSpec collision;
    collision.geometry.size = size;
    spec.links[0].collisions = {collision};
    return spec;
}

std::shared_ptr<const Model> mast_before_wall() {
    World world;
    ModelSpec mast = static_box("mast", {0.2, 0.2, 2});
    SensorSpec lidar;
    lidar.name = "lidar";
    LaserSpec beam;
    beam.range_max = 50;
    lidar.parameters = beam;
    lidar.X_LS = {{0, 0, 0.5}, {}};
    mast.links[0].sensors = {lidar};
    world.prototypes = {mast, static_box("wall", {0.5, 10, 3})};
    world.instances = {{"wall", 1, {{5, 0, 1}, {}}, {}}, {"mast", 0, {{1, 0, 1}, {}}, {}}};
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

TEST(StaticSensor, IsReadAndDoesNotSeeItsOwnMast) {
    const auto model = mast_before_wall();
    ASSERT_EQ(model->robots.size(), 1u);
    EXPECT_EQ(model->robots[0].name, "mast");
    EXPECT_EQ(model->statics.size(), 2u);
    const RobotId mast(std::size_t{0});
    const RobotState state = initial_state(*model, mast);
    const LaserReading reading = sensors_test::read_as<LaserReading>(model, {&state}, 0);
    ASSERT_EQ(reading.ranges.size(), 1u);
    EXPECT_DOUBLE_EQ(reading.ranges[0], 3.75) << "from x = 1 to the wall's face at x = 4.75";
}

TEST(StaticSensor, CannotBeMoved) {
    const auto model = mast_before_wall();
    const Result<> checked = check_order(*model, {0, ClientId(0u), 1, RobotId(0u), SetPose{}});
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().message.find("static"), std::string::npos);
}

}  // namespace
}  // namespace roboss
