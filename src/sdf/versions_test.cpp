// Versions of SDFormat: each is read as it means what it says.
#include <gtest/gtest.h>

#include "sdf/source_file.h"
#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

TEST(Versions, VersionsAreParsed) {
    EXPECT_EQ(sdf_import::parse_version("1.6"), 106);
    EXPECT_EQ(sdf_import::parse_version("1.12"), 112);
    EXPECT_EQ(sdf_import::parse_version("one"), 0);
    EXPECT_EQ(sdf_import::parse_version("1."), 0);
}

TEST(Versions, EveryVersionFrom14To112Loads) {
    for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"}) {
        const Loaded loaded =
            load_elements("<model name='m'><pose>0 0 1 0 0 0</pose>" + link("a") + "</model>", version);
        ASSERT_TRUE(loaded.world) << version;
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << version << "\n" << loaded.text();
        EXPECT_EQ(loaded.world->instances.size(), 1u);
    }
    EXPECT_NE(load_elements("<model name='m'>" + link("a") + "</model>", "1.13").find("newer-version"),
              nullptr);
    EXPECT_NE(load_elements("<model name='m'>" + link("a") + "</model>", "x").find("no-version"), nullptr);
}

TEST(Versions, MimicIsRead) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + link("b") + link("c") +
            "<joint name='k' type='universal'><parent>a</parent><child>c</child><axis><xyz>0 0 1</xyz></axis>"
            "<axis2><xyz>0 1 0</xyz></axis2></joint>"
            "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
            "<mimic joint='k' axis='axis2'><multiplier>2</multiplier><offset>0.1</offset>"
            "<reference>-0.3</reference></mimic></axis></joint></model>",
        "1.11");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const auto& mimic = loaded.world->prototypes[0].joints[1].axes[0].mimic;
    ASSERT_TRUE(mimic.has_value());
    EXPECT_EQ(mimic->joint, "k");
    EXPECT_EQ(mimic->axis, 1);
    EXPECT_EQ(mimic->multiplier, 2);
    EXPECT_EQ(mimic->offset, 0.1);
    EXPECT_EQ(mimic->reference, -0.3);
    EXPECT_FALSE(loaded.world->prototypes[0].joints[0].axes[0].mimic.has_value());
}

TEST(Versions, AutomaticInertiaIsComputedFromTheCollisions) {
    const Loaded loaded = load_elements(
        "<model name='m'><link name='a'><inertial auto='true'><density>500</density></inertial>"
        "<collision name='x'><pose>0 0 1 0 0 0</pose><geometry><box><size>1 2 "
        "3</size></box></geometry></collision>"
        "<collision name='y'><pose>0 0 -1 0 0 0</pose><density>1500</density><geometry><box><size>1 2 "
        "1</size></box></geometry></collision>"
        "</link></model>",
        "1.11");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("automatic-inertia"), nullptr);
    const LinkSpec& l = loaded.world->prototypes[0].links[0];
    // Two boxes of 3000 kg each, their centres 1 m to either side of the middle.
    EXPECT_NEAR(l.mass, 6000, 1e-9);
    EXPECT_NEAR(l.p_LC.z, 0, 1e-12);
    EXPECT_NEAR(l.inertia_C(0, 0), 3000 * (4 + 9) / 12.0 + 3000 * (4 + 1) / 12.0 + 6000, 1e-6);
    EXPECT_NEAR(l.inertia_C(2, 2), 2 * 3000 * (1 + 4) / 12.0, 1e-6);
}

TEST(Versions, AutomaticInertiaOfRoundSolidsIsThatOfTheTextbook) {
    const auto inertia = [](const std::string& shape) {
        const Loaded loaded = load_elements(
            "<model name='m'><link name='a'><inertial auto='true'/><collision name='x'><geometry>" + shape +
                "</geometry></collision></link></model>",
            "1.12");
        return loaded.world->prototypes.at(0).links.at(0);
    };
    const LinkSpec ball = inertia("<sphere><radius>0.1</radius></sphere>");
    EXPECT_NEAR(ball.mass, 4000.0 / 3 * kPi * 1e-3, 1e-9);
    EXPECT_NEAR(ball.inertia_C(0, 0), 0.4 * ball.mass * 0.01, 1e-12);
    const LinkSpec rod = inertia("<cylinder><radius>0.1</radius><length>2</length></cylinder>");
    EXPECT_NEAR(rod.inertia_C(0, 0), rod.mass * (3 * 0.01 + 4) / 12, 1e-9);
    // A capsule without a straight part is a ball.
    const LinkSpec capsule = inertia("<capsule><radius>0.1</radius><length>0.000000001</length></capsule>");
    EXPECT_NEAR(capsule.inertia_C(0, 0), ball.inertia_C(0, 0), 1e-7);
    EXPECT_NEAR(capsule.inertia_C(2, 2), ball.inertia_C(2, 2), 1e-7);
    const LinkSpec cone = inertia("<cone><radius>0.1</radius><length>0.4</length></cone>");
    EXPECT_NEAR(cone.mass, 1000 * kPi * 0.01 * 0.4 / 3, 1e-9);
    EXPECT_NEAR(cone.p_LC.z, -0.1, 1e-12);
}

TEST(Versions, AutomaticInertiaWithoutAVolumeIsAWarning) {
    const Loaded loaded =
        load_elements("<model name='m'><link name='a'><inertial auto='true'/></link></model>", "1.11");
    ASSERT_NE(loaded.find("automatic-inertia"), nullptr);
    EXPECT_EQ(loaded.find("automatic-inertia")->severity, Severity::kWarning);
}

TEST(Versions, AWorldsJointIsReported) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") +
            "</model><joint name='j' type='fixed'><parent>world</parent><child>m</child></joint>",
        "1.11");
    ASSERT_NE(loaded.find("world-joint"), nullptr);
}

TEST(Versions, AConeCollides) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
            link("a",
                 "<collision name='c'><geometry><cone><radius>1</radius></cone></geometry></collision>") +
            "</model>",
        "1.12");
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    ASSERT_EQ(loaded.world->prototypes[0].links[0].collisions.size(), 1u);
    const GeometrySpec& geometry = loaded.world->prototypes[0].links[0].collisions[0].geometry;
    EXPECT_EQ(geometry.kind, GeometryKind::kCone);
    EXPECT_EQ(geometry.radius, 1);
    EXPECT_EQ(geometry.length, 1);
}

}  // namespace
}  // namespace roboss
