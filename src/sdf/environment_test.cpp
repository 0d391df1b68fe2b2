// Tables of EnvironmentPreload: what environmental sensors get of them, and what is reported.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

/// Rows in no order; a grid of 2 times, 1 x, 2 y, 1 z.
const std::string kTable =
    "time,east,y,z,humidity,wind\n1, 5,0,2, 11,0.5\n0,5,0,2,10,0.5\r\n\n0,5,1,2,20,0.5\n1,5,1,2,21,0.5\n";

std::string preload(const std::string& file, const std::string& space = "<space><x>east</x></space>") {
    return "<plugin name='gz::sim::systems::EnvironmentPreload' filename='gz-sim-environment-preload-system'>"
           "<data>" +
           file + "</data><dimensions><time>time</time>" + space + "</dimensions></plugin>";
}

const std::string kSystem =
    "<plugin name='gz::sim::systems::EnvironmentalSystem' filename='gz-sim-environmental-sensor-system'/>";

std::string sensor(const std::string& type, const std::string& elements = "") {
    return "<model name='m'>" +
           link("a", "<sensor name='s' type='custom' gz:type='environmental_sensor/" + type + "'>" +
                         elements + "</sensor>") +
           "</model>";
}

Loaded load(const std::string& elements, const std::string& table = kTable) {
    const TestFolder folder;
    (void)folder.write("data/table.csv", table);
    (void)folder.write("w.sdf", "<sdf version='1.9' xmlns:gz='http://gazebosim.org/schema'><world name='w'>" +
                                    elements + "</world></sdf>");
    return folder.load("w.sdf");
}

EnvironmentalSpec spec_of(const Loaded& loaded) {
    const auto* spec = loaded.world
                           ? loaded.world->prototypes.at(0).links.at(0).sensors.at(0).as<EnvironmentalSpec>()
                           : nullptr;
    EXPECT_NE(spec, nullptr) << loaded.text();
    return spec == nullptr ? EnvironmentalSpec{} : *spec;
}

TEST(Environment, ASensorGetsTheColumnThatItsTypeNames) {
    const Loaded loaded = load(preload("data/table.csv") + kSystem + sensor("humidity"));
    const EnvironmentalSpec spec = spec_of(loaded);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    EXPECT_EQ(spec.variable, "humidity");
    EXPECT_EQ(spec.reference, "global");
    EXPECT_EQ(spec.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(spec.xs, (std::vector<double>{5}));
    EXPECT_EQ(spec.ys, (std::vector<double>{0, 1}));
    EXPECT_EQ(spec.zs, (std::vector<double>{2}));
    EXPECT_EQ(spec.values, (std::vector<double>{10, 20, 11, 21}));
    for (const ExtensionElement& plugin : loaded.world->extensions)
        EXPECT_EQ(plugin.fate, PluginFate::kRuns) << plugin.plugin << plugin.reason;
}

TEST(Environment, AVectorHasThreeColumnsOrZeros) {
    const Loaded loaded = load(preload("data/table.csv") +
                               sensor("x",
                                      "<output_format>vector3</output_format><transform_type>LOCAL"
                                      "</transform_type><environment_variable_x>wind</environment_variable_x>"
                                      "<environment_variable_z>humidity</environment_variable_z>"));
    const EnvironmentalSpec spec = spec_of(loaded);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    EXPECT_EQ(spec.transform_type, "LOCAL");
    EXPECT_EQ(spec.values, (std::vector<double>{0.5, 0.5, 0.5, 0.5, 0, 0, 0, 0, 10, 20, 11, 21}));
}

TEST(Environment, ReferenceUnitsAndTimeOfTheTableAreKept) {
    const std::string ignores =
        "<ignore_time>true</ignore_time><space reference='spherical' units='degrees'>"
        "<x>east</x></space>";
    const EnvironmentalSpec spec = spec_of(load(preload("data/table.csv", ignores) + sensor("humidity")));
    EXPECT_EQ(spec.reference, "spherical");
    EXPECT_TRUE(spec.in_degrees);
    EXPECT_TRUE(spec.is_static);
}

/// What is reported, and that nothing is read.
void expect_reported(const std::string& elements, const std::string& table = kTable) {
    const Loaded loaded = load(elements, table);
    EXPECT_TRUE(spec_of(loaded).values.empty());
    EXPECT_NE(loaded.find("environment"), nullptr) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
}

TEST(Environment, WhatCannotBeReadIsReported) {
    expect_reported(preload("data/other.csv") + sensor("humidity"));
    expect_reported(preload("") + sensor("humidity"));
    expect_reported(sensor("humidity"));
    expect_reported(preload("data/table.csv") + sensor("dew"));
    expect_reported(preload("data/table.csv", "") + sensor("humidity"));  // no column x
    expect_reported(preload("data/table.csv", "<space reference='moon'><x>east</x></space>") +
                    sensor("humidity"));
    const std::string plugin = preload("data/table.csv") + sensor("humidity");
    expect_reported(plugin, "time,east,y,z,humidity\n0,0,0,0\n");
    expect_reported(plugin, "time,east,y,z,humidity\n0,0,0,0,wet\n");
    expect_reported(plugin, "time,east,y,z,humidity\n0,0,0,0,1\n0,1,1,0,1\n");  // 2 of 4 points
}

TEST(Environment, PluginsWithoutATableDoNotRun) {
    const Loaded loaded = load(preload("data/other.csv") + kSystem + sensor("humidity"));
    ASSERT_TRUE(loaded.world);
    for (const ExtensionElement& plugin : loaded.world->extensions) {
        EXPECT_EQ(plugin.fate, PluginFate::kNotRun) << plugin.plugin;
        EXPECT_FALSE(plugin.reason.empty());
    }
}

}  // namespace
}  // namespace roboss
