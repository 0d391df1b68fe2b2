// What the census of plugins says of controllers that compile() leaves out.
#include "app/worlds/plugin_census.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

/// A model with one link and a VelocityControl, and the plugin that it came from.
ModelSpec controlled(const std::string& topic, int line) {
    ModelSpec spec;
    spec.name = "m" + std::to_string(line), spec.canonical_link = "a";
    spec.links.emplace_back().name = "a";
    spec.links.back().inertia_C = Mat3::identity();
    const SourceLocation where{"w.sdf", line};
    VelocityControlSpec control;
    control.topic = topic;
    spec.onboard.push_back({"VelocityControl", control, where});
    ExtensionElement element;
    element.name = "plugin", element.where = where, element.plugin = "gz::sim::systems::VelocityControl";
    element.parent = "model", element.fate = PluginFate::kRuns;
    spec.extensions.push_back(element);
    return spec;
}

World world_of(std::vector<ModelSpec> models) {
    World world;
    for (ModelSpec& model : models) {
        world.instances.push_back({model.name, world.prototypes.size(), {}, {}});
        world.prototypes.push_back(std::move(model));
    }
    return world;
}

TEST(PluginCensus, AControllerInTheModelRuns) {
    const World world = world_of({controlled("", 3)});
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_NE(model, nullptr);
    const auto plugins = list_plugins(world, model.get(), diagnostics);
    ASSERT_EQ(plugins.size(), 1u);
    EXPECT_EQ(plugins[0].fate, PluginFate::kRuns);
}

TEST(PluginCensus, EqualTypesOfSeveralModelsRunAll) {
    const World world = world_of({controlled("/cmd", 3), controlled("/cmd", 9)});
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_NE(model, nullptr);
    ASSERT_EQ(model->types.size(), 1u) << "the second one's place in the file is nowhere in the Model";
    for (const PluginReport& plugin : list_plugins(world, model.get(), diagnostics))
        EXPECT_EQ(plugin.fate, PluginFate::kRuns) << plugin.where.line;
}

TEST(PluginCensus, AControllerThatIsLeftOutIsNotRunAndSaysWhy) {
    World world = world_of({controlled("/cmd", 3), controlled("/cmd", 9)});
    world.prototypes[1].onboard.clear();  // as compile() leaves it: nothing of it runs
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_NE(model, nullptr);
    world.prototypes[1].onboard = world.prototypes[0].onboard;
    world.prototypes[1].onboard[0].where.line = 9;
    diagnostics.warning({"w.sdf", 9}, "plugin-not-run", "the reason");
    const auto plugins = list_plugins(world, model.get(), diagnostics);
    ASSERT_EQ(plugins.size(), 2u);
    EXPECT_EQ(plugins[0].fate, PluginFate::kRuns);
    EXPECT_EQ(plugins[1].fate, PluginFate::kNotRun);
    EXPECT_EQ(plugins[1].reason, "the reason");
}

TEST(PluginCensus, NothingRunsInAWorldThatDoesNot) {
    const World world = world_of({controlled("", 3)});
    const auto plugins = list_plugins(world, nullptr, {});
    ASSERT_EQ(plugins.size(), 1u);
    EXPECT_EQ(plugins[0].fate, PluginFate::kNotRun);
}

}  // namespace
}  // namespace roboss
