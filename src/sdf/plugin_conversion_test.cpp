// Plugins: which become on-board controllers, and what is said of the others.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

Loaded with_plugin(const std::string& attributes, const std::string& children = "") {
    return load_elements("<model name='m'>" + link("a") + "<plugin " + attributes + ">" + children +
                         "</plugin></model>");
}

const ModelSpec& model_of(const Loaded& loaded) {
    return loaded.world->prototypes.at(0);
}

TEST(Plugins, AreKnownByClassOrElseByFile) {
    for (const std::string attributes :
         {"name='gz::sim::systems::VelocityControl' filename='gz-sim-velocity-control-system'",
          "name='ignition::gazebo::systems::VelocityControl' filename='x'",
          "name='drive' filename='libignition-gazebo-velocity-control-system.so'",
          "name='drive' filename='ignition-gazebo6-velocity-control-system'",
          "name='drive' filename='/usr/lib/libgz-sim8-velocity-control-system.so.8'"}) {
        const Loaded loaded = with_plugin(attributes);
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << attributes << "\n" << loaded.text();
        ASSERT_EQ(model_of(loaded).onboard.size(), 1u) << attributes;
        EXPECT_EQ(model_of(loaded).extensions.at(0).fate, PluginFate::kRuns);
    }
}

TEST(Plugins, AreReadWithTheirParameters) {
    const Loaded loaded = with_plugin("name='gz::sim::systems::VelocityControl' filename='x'",
                                      "<topic> /go </topic><initial_linear>1 2 3</initial_linear>"
                                      "<initial_angular>0 0 0.5</initial_angular>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(model_of(loaded).onboard.size(), 1u);
    VelocityControlSpec expected;
    expected.topic = "/go";
    expected.initial_linear = {1, 2, 3}, expected.initial_angular = {0, 0, 0.5};
    EXPECT_EQ(std::get<VelocityControlSpec>(model_of(loaded).onboard[0].parameters), expected);
}

TEST(Plugins, WithValuesThatCannotBeReadAreNotRunAndTheModelStays) {
    const Loaded loaded = with_plugin("name='gz::sim::systems::VelocityControl' filename='x'",
                                      "<initial_linear>fast 0 0</initial_linear>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("bad-value"), nullptr);
    EXPECT_NE(loaded.find("plugin-not-run"), nullptr);
    EXPECT_TRUE(model_of(loaded).onboard.empty());
    EXPECT_EQ(model_of(loaded).extensions.at(0).fate, PluginFate::kNotRun);
    EXPECT_FALSE(model_of(loaded).extensions.at(0).reason.empty());
}

TEST(Plugins, DetachableJointsNameTheirChild) {
    const std::string name = "name='gz::sim::systems::DetachableJoint' filename='x'";
    const Loaded loaded =
        with_plugin(name,
                    "<parent_link>a</parent_link><child_model>box</child_model><child_link>body</child_link>"
                    "<topic>/old/detach</topic><attach_topic>/new/attach</attach_topic>"
                    "<suppress_child_warning>true</suppress_child_warning>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(model_of(loaded).onboard.size(), 1u);
    const auto& read = std::get<DetachableJointSpec>(model_of(loaded).onboard[0].parameters);
    EXPECT_EQ(read.parent_link, LinkNames{"a"});
    EXPECT_EQ(read.child_model, "box");
    EXPECT_EQ(read.child_link, "body");
    EXPECT_EQ(read.channels().at(0).name, "old/detach");
    EXPECT_EQ(read.channels().at(1).name, "new/attach");
    EXPECT_NE(with_plugin(name, "<parent_link>a</parent_link>").find("plugin-not-run"), nullptr);
}

Loaded with_gripper(const std::string& children) {
    return load_elements("<model name='m'>" +
                         link("a", "<roboss:gripper name='cup'>" + children + "</roboss:gripper>") +
                         "</model>");
}

TEST(Grippers, AreReadWithTheirParameters) {
    const Loaded loaded = with_gripper(
        "<type>magnetic</type><pose>0 0 -0.1 0 0 0</pose><reach>0.05</reach>"
        "<max_force>20</max_force><on>true</on>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(model_of(loaded).onboard.size(), 1u);
    GripperSpec expected;
    expected.link = {"a"}, expected.name = "cup", expected.type = "magnetic";
    expected.X_LC.p = {0, 0, -0.1};
    expected.reach = 0.05, expected.max_force = 20, expected.on = true;
    EXPECT_EQ(std::get<GripperSpec>(model_of(loaded).onboard[0].parameters), expected);
}

TEST(Grippers, ThatMakeNoSenseAreErrors) {
    for (const std::string wrong : {"<type>glue</type>", "<reach>0</reach>", "<max_force>-1</max_force>"})
        EXPECT_NE(with_gripper(wrong).find("bad-gripper"), nullptr) << wrong;
    EXPECT_NE(with_gripper("<raech>1</raech>").text().find("raech"), std::string::npos);
}

TEST(Plugins, ThatDrawOrServeNeedNothingAndGetNoNote) {
    for (const std::string name : {"SceneBroadcaster", "UserCommands", "Physics", "Label"}) {
        const Loaded loaded = with_plugin("name='gz::sim::systems::" + name + "' filename='x'");
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
        EXPECT_EQ(model_of(loaded).extensions.at(0).fate, PluginFate::kNotNeeded);
    }
}

TEST(Plugins, WithoutCounterpartGetANote) {
    const Loaded loaded = with_plugin("name='my::own::Thing' filename='libthing.so'");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_NE(loaded.find("plugin"), nullptr);
    EXPECT_EQ(loaded.find("plugin")->severity, Severity::kNote);
    EXPECT_EQ(model_of(loaded).extensions.at(0).fate, PluginFate::kNotRun);
}

}  // namespace
}  // namespace roboss
