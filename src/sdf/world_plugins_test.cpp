// Parameters of drives as files write them, plugins that become several controllers, plugins of a world.
#include "sdf/world_plugins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdf/test_files.h"

namespace roboss::sdf_test {
namespace {

const std::string kBox =
    "<link name='link'><collision name='c'><geometry><box><size>1 1 "
    "1</size></box></geometry></collision></link>";

Loaded load(const std::string& in_world) {
    const TestFolder folder;
    folder.write("world.sdf", "<sdf version='1.9'><world name='w'>" + in_world + "</world></sdf>");
    return folder.load("world.sdf");
}

std::string wheels(const std::string& plugin) {
    std::string joints;
    for (const std::string side : {"left", "right"})
        joints += "<link name='" + side + "'/><joint name='" + side +
                  "_joint' type='revolute'><parent>link</parent><child>" + side +
                  "</child><axis><xyz>0 1 0</xyz></axis></joint>";
    return "<model name='car'>" + kBox + joints + plugin + "</model>";
}

template <class Spec>
const Spec* first(const Loaded& loaded) {
    if (!loaded.world || loaded.world->prototypes.empty()) return nullptr;
    for (const OnboardSpec& onboard : loaded.world->prototypes[0].onboard)
        if (const Spec* spec = std::get_if<Spec>(&onboard.parameters)) return spec;
    return nullptr;
}

TEST(DrivePlugins, ALimitOfOneMotionReplacesThatOfBoth) {
    const Loaded loaded = load(wheels(
        "<plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>"
        "<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>"
        "<min_velocity>-2</min_velocity><max_velocity>2</max_velocity>"
        "<max_linear_velocity>0.5</max_linear_velocity><max_angular_jerk>7</max_angular_jerk></plugin>"));
    const auto* spec = first<DiffDriveSpec>(loaded);
    ASSERT_NE(spec, nullptr) << loaded.text();
    EXPECT_EQ(spec->linear.max_velocity, 0.5);
    EXPECT_EQ(spec->linear.min_velocity, -2);
    EXPECT_EQ(spec->angular.max_velocity, 2);
    EXPECT_EQ(spec->angular.max_jerk, 7);
    EXPECT_FALSE(std::isfinite(spec->linear.max_jerk));
}

TEST(DrivePlugins, ADriveWithoutWheelsIsNotRun) {
    const Loaded loaded =
        load(wheels("<plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>"
                    "<left_joint>left_joint</left_joint></plugin>"));
    EXPECT_EQ(first<DiffDriveSpec>(loaded), nullptr);
    EXPECT_NE(loaded.find("plugin-not-run"), nullptr) << loaded.text();
}

TEST(DrivePlugins, BothDialectsOfTheClassicDriveAreRead) {
    const Loaded ros2 = load(
        wheels("<plugin filename='libgazebo_ros_diff_drive.so' name='drive'><ros><namespace>/demo</namespace>"
               "<remapping>cmd_vel:=go</remapping></ros><left_joint>left_joint</left_joint>"
               "<right_joint>right_joint</right_joint><wheel_separation>0.6</wheel_separation></plugin>"));
    const auto* spec = first<RosDiffDriveSpec>(ros2);
    ASSERT_NE(spec, nullptr) << ros2.text();
    EXPECT_EQ(spec->separation(0), 0.6);
    EXPECT_EQ(spec->diameter(0), 0.15) << "the default";
    EXPECT_EQ(spec->channels()[0].name, "go");
    EXPECT_EQ(spec->channels()[0].topic, "/demo/go");
    const Loaded ros1 =
        load(wheels("<plugin filename='libgazebo_ros_diff_drive.so' name='drive'>"
                    "<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>"
                    "<wheelDiameter>0.3</wheelDiameter><wheelTorque>9</wheelTorque></plugin>"));
    spec = first<RosDiffDriveSpec>(ros1);
    ASSERT_NE(spec, nullptr) << ros1.text();
    EXPECT_EQ(spec->left, (JointNames{"left_joint"}));
    EXPECT_EQ(spec->diameter(0), 0.3);
    EXPECT_EQ(spec->torque, 9);
}

TEST(DrivePlugins, AVelocityControlWithLinksBecomesOneControllerForEach) {
    const Loaded loaded =
        load("<model name='m'>" + kBox +
             "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'>"
             "<link_name>link</link_name><initial_linear>1 0 0</initial_linear></plugin></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto& onboard = loaded.world->prototypes[0].onboard;
    ASSERT_EQ(onboard.size(), 2u);
    EXPECT_EQ(channels_of(onboard[0].parameters)[0].name, "cmd_vel");
    EXPECT_EQ(channels_of(onboard[1].parameters)[0].name, "link/link/cmd_vel");
}

TEST(DrivePlugins, FrictionDirectionsMayBeInTheFrameOfAnotherLink) {
    const Loaded loaded = load(
        "<model name='m'><link name='link'><collision "
        "name='c'><geometry><sphere><radius>1</radius></sphere></geometry>"
        "<surface><friction><ode><mu>1</mu><mu2>0</mu2><fdir1 gz:expressed_in='base'>1 -1 "
        "0</fdir1></ode></friction>"
        "</surface></collision></link></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[0].surface.fdir1_link, "base");
}

std::string wrench_plugin(const std::string& persistent) {
    return "<plugin filename='gz-sim-apply-link-wrench-system' name='gz::sim::systems::ApplyLinkWrench'>" +
           persistent + "</plugin>";
}

TEST(WorldPlugins, EachModelGetsItsControllersAndEqualOnesShareAPrototype) {
    std::string models;
    for (const std::string name : {"a", "b", "c"})
        models += "<model name='" + name + "'>" + kBox + "</model>";
    const Loaded loaded =
        load(wrench_plugin("<persistent><entity_name>b</entity_name><entity_type>model</entity_type>"
                           "<force>-10 0 0</force></persistent><persistent><entity_name>b::link</entity_name>"
                           "<entity_type>link</entity_type><torque>0 0 1</torque></persistent>") +
             models);
    ASSERT_TRUE(loaded.world) << loaded.text();
    const World& world = *loaded.world;
    ASSERT_EQ(world.instances.size(), 3u);
    ASSERT_EQ(world.prototypes.size(), 2u);
    EXPECT_EQ(world.instances[0].prototype, world.instances[2].prototype);
    const auto& pushed = world.prototypes[world.instances[1].prototype].onboard;
    ASSERT_EQ(pushed.size(), 2u) << "its canonical link, and the link that is named";
    const auto& model = std::get<ApplyLinkWrenchSpec>(pushed[0].parameters);
    ASSERT_EQ(model.persistent.size(), 1u);
    EXPECT_EQ(model.persistent[0].force, (Vec3{-10, 0, 0}));
    EXPECT_EQ(model.channels()[0].topic, "/world/w/wrench");
    EXPECT_EQ(std::get<ApplyLinkWrenchSpec>(pushed[1].parameters).link, (LinkNames{"link"}));
    EXPECT_EQ(world.prototypes[world.instances[0].prototype].onboard.size(), 1u);
}

TEST(WorldPlugins, APluginOfAModelInTheWorldIsReported) {
    const Loaded loaded = load(
        "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/><model "
        "name='m'>" +
        kBox + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("plugin-not-run"), nullptr) << loaded.text();
}

}  // namespace
}  // namespace roboss::sdf_test
