// The parts that robots of one type, and of several, share.
#include "local/shared_parts.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "local/local_run.h"
#include "local/robot_set.h"

namespace roboss::test {
namespace {

/// A car with a scanner and a velocity control.
ModelSpec rover(const std::string& topic, double mu = 0.9) {
    ModelSpec spec = car({.mu = mu});
    SensorSpec sensor;
    sensor.name = "scan", sensor.parameters = LaserSpec{};
    spec.links[0].sensors.push_back(sensor);
    VelocityControlSpec control;
    control.topic = topic;
    spec.onboard.push_back({"go", control, {}});
    return spec;
}

std::shared_ptr<const Model> world_of(const std::vector<ModelSpec>& specs) {
    World world = empty_world(2e-3);
    for (std::size_t i = 0; i < specs.size(); ++i)
        place(world, specs[i], "robot_" + std::to_string(i), {{2.0 * static_cast<double>(i), 0, 0}, {}});
    return compiled(world);
}

RobotSet all_of(const std::shared_ptr<const Model>& model) {
    std::vector<RobotId> robots;
    for (std::size_t r = 0; r < model->robots.size(); ++r) robots.emplace_back(r);
    return {model, robots};
}

std::vector<std::string> names_of(const std::vector<SharedPart>& parts) {
    std::vector<std::string> names;
    for (const SharedPart& part : parts) names.push_back(part.name);
    return names;
}

TEST(SharedParts, OfOneTypeAreAllThatItHasWhateverItIsCalled) {
    ModelSpec other = rover("/b/cmd_vel");
    for (JointSpec& joint : other.joints) joint.name = "b_" + joint.name;
    const RobotSet set = all_of(world_of({rover("/a/cmd_vel"), other, rover("/c/cmd_vel")}));
    EXPECT_TRUE(set.shared().one_type);
    EXPECT_EQ(set.shared().types.size(), 3u);
    EXPECT_EQ(names_of(set.axes()), (std::vector<std::string>{"wheel_0", "wheel_1", "wheel_2", "wheel_3"}));
    EXPECT_EQ(set.axes_of_row(1)[2].name, "b_wheel_2");
    EXPECT_EQ(names_of(set.shared().commands), (std::vector<std::string>{"cmd_vel"}));
    EXPECT_EQ(names_of(set.shared().sensors), (std::vector<std::string>{"scan"}));
}

TEST(SharedParts, OfOneTypeAreFoundByNameWhereTheNamesAreTheSameInAnotherOrder) {
    ModelSpec other = rover("/b/cmd_vel");
    std::swap(other.joints[0].name, other.joints[1].name);
    const RobotSet set = all_of(world_of({rover("/a/cmd_vel"), other}));
    EXPECT_TRUE(set.shared().one_type);
    EXPECT_EQ(set.axes()[0].name, "wheel_0");
    EXPECT_EQ(set.axes_of_row(1)[0].name, "wheel_0");
    EXPECT_EQ(set.axes()[0].of, (std::vector<std::size_t>{0, 1}));
}

TEST(SharedParts, OfOneTypeWithMixedNamesAreNotTakenByPlace) {
    ModelSpec swapped = rover("/b/cmd_vel"), other = rover("/c/cmd_vel");
    std::swap(swapped.joints[0].name, swapped.joints[1].name);
    for (JointSpec& joint : other.joints) joint.name = "c_" + joint.name;
    const RobotSet set = all_of(world_of({rover("/a/cmd_vel"), swapped, other}));
    EXPECT_TRUE(set.shared().one_type);
    EXPECT_TRUE(set.axes().empty());  // "wheel_0" is the first wheel here, the second there
    EXPECT_EQ(names_of(set.shared().commands), (std::vector<std::string>{"cmd_vel"}));
}

TEST(SharedParts, OfSeveralTypesAreThoseOfOneNameAndKind) {
    ModelSpec other = rover("/b/cmd_vel", 0.5);
    other.joints[0].name = "only_here";                // another name
    other.joints[1].kind = JointSpecKind::kPrismatic;  // another unit
    other.links[0].sensors[0].parameters = ImuSpec{};  // another kind
    LinearBatterySpec battery;
    battery.battery_name = "battery", battery.voltage = 12, battery.capacity = 2;
    other.onboard.push_back({"battery", battery, {}});
    const RobotSet set = all_of(world_of({rover("/a/cmd_vel"), other}));
    EXPECT_FALSE(set.shared().one_type);
    EXPECT_EQ(names_of(set.axes()), (std::vector<std::string>{"wheel_2", "wheel_3"}));
    EXPECT_TRUE(set.shared().sensors.empty());
    EXPECT_EQ(names_of(set.shared().commands), (std::vector<std::string>{"cmd_vel"}));
    EXPECT_EQ(set.shared().links.size(), 5u);
}

TEST(SharedParts, OfRobotsWithoutAnyAreNone) {
    const RobotSet set = all_of(world_of({rover("/a/cmd_vel"), solid_box(1, {1, 1, 1}, surface(0.5))}));
    EXPECT_TRUE(set.axes().empty());
    EXPECT_TRUE(set.shared().commands.empty());
    const RobotSet none(world_of({car()}), {});
    EXPECT_TRUE(none.axes().empty());
}

TEST(RobotSet, OfSeveralTypesMovesWhatTheyShare) {
    const auto model = world_of({rover("/a/cmd_vel"), rover("/b/cmd_vel", 0.5)});
    const RobotSet set = all_of(model);
    ASSERT_FALSE(set.shared().one_type);
    const auto run = std::move(LocalRun::create(model, {})).value();
    const std::vector<double> rows{1, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0};
    ASSERT_TRUE(set.command(*run, 0, 6, rows).ok());
    ASSERT_TRUE(run->step(1).ok());
    std::vector<double> twists(12);
    set.twists(*run, twists);
    EXPECT_NEAR(twists[0], 1, 1e-6);
    EXPECT_NEAR(twists[6], 2, 1e-6);
    const std::vector<double> angles{1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<double> now(8);
    ASSERT_TRUE(set.set_joint_positions(*run, angles).ok());
    set.joint_positions(*run, now);
    EXPECT_EQ(now, angles);
}

}  // namespace
}  // namespace roboss::test
