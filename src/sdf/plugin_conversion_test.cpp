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
