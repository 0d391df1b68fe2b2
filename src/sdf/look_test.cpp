// Lights, sky and first camera of a world.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kModel = "<model name='m'><pose>1 2 3 0 0 0</pose>" + link("a") + "</model>";

TEST(SdfLook, AWorldWithoutLightsHasNone) {
    const Loaded loaded = load_elements(kModel);
    EXPECT_TRUE(loaded.world->look.lights.empty());
    EXPECT_FALSE(loaded.world->look.scene);
    EXPECT_FALSE(loaded.world->look.camera);
}

TEST(SdfLook, LightsAreReadWithTheirNumbers) {
    const Loaded loaded = load_elements(
        kModel +
            "<light name='sun' type='directional'><cast_shadows>true</cast_shadows><pose>0 0 10 0 0 0</pose>"
            "<diffuse>0.8 0.7 0.6 1</diffuse><direction>-0.5 0.1 -0.9</direction></light>"
            "<light name='lamp' type='spot'><pose relative_to='m'>0 0 1 0 0 0</pose><intensity>2</intensity>"
            "<attenuation><range>20</range><constant>0.5</constant><linear>0.01</linear>"
            "<quadratic>0.001</quadratic></attenuation>"
            "<spot><inner_angle>0.1</inner_angle><outer_angle>0.5</outer_angle><falloff>0.8</falloff></"
            "spot></light>"
            "<light name='off' type='point'><light_on>false</light_on></light>",
        "1.10");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const auto& lights = loaded.world->look.lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].kind, LightKind::kDirectional);
    EXPECT_EQ(lights[0].diffuse, (Vec3{0.8, 0.7, 0.6}));
    EXPECT_EQ(lights[0].direction, (Vec3{-0.5, 0.1, -0.9}));
    EXPECT_TRUE(lights[0].cast_shadows);
    EXPECT_EQ(lights[1].kind, LightKind::kSpot);
    EXPECT_EQ(lights[1].X_FL.p, (Vec3{1, 2, 4})) << "relative to the model";
    EXPECT_EQ(lights[1].range, 20);
    EXPECT_EQ(lights[1].constant, 0.5);
    EXPECT_EQ(lights[1].quadratic, 0.001);
    EXPECT_EQ(lights[1].outer_angle, 0.5);
    EXPECT_EQ(lights[1].intensity, 2);
}

TEST(SdfLook, ALightOfALinkStaysInItsLink) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
            link("a",
                 "<light name='head' type='spot'><pose>0.5 0 0 0 0 0</pose></light>"
                 "<light name='tail' type='point'><pose relative_to='b'>0.1 0 0 0 0 0</pose></light>") +
            "<link name='b'><pose>-1 0 0 0 0 0</pose>" + kInertial +
            "</link><joint name='j' type='fixed'><parent>a</parent><child>b</child></joint></model>",
        "1.9");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const auto& lights = loaded.world->prototypes[0].links[0].lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].X_FL.p, (Vec3{0.5, 0, 0}));
    EXPECT_NEAR(lights[1].X_FL.p.x, -0.9, 1e-12);
}

TEST(SdfLook, AnUnknownTypeOfLightIsAWarning) {
    const Loaded loaded = load_elements(kModel + "<light name='l' type='laser'/>");
    ASSERT_NE(loaded.find("unknown-light"), nullptr) << loaded.text();
    EXPECT_TRUE(loaded.world->look.lights.empty());
}

TEST(SdfLook, TheSceneIsRead) {
    const Loaded loaded = load_elements(
        kModel +
        "<scene><ambient>0.4 0.5 0.6 1</ambient><background>0.1 0.2 0.3 1</background><sky/>"
        "<shadows>false</shadows><grid>false</grid><fog><type>linear</type><color>1 0 0 1</color>"
        "<start>5</start><end>50</end><density>0.5</density></fog></scene>");
    ASSERT_TRUE(loaded.world->look.scene);
    const SceneSpec& scene = *loaded.world->look.scene;
    EXPECT_EQ(scene.ambient, (Vec3{0.4, 0.5, 0.6}));
    EXPECT_EQ(scene.background, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_TRUE(scene.sky);
    EXPECT_FALSE(scene.shadows);
    EXPECT_FALSE(scene.grid);
    ASSERT_TRUE(scene.fog);
    EXPECT_EQ(scene.fog->start, 5);
    EXPECT_EQ(scene.fog->end, 50);
}

TEST(SdfLook, TheCameraOfTheGuiIsRead) {
    const Loaded loaded = load_elements(
        kModel +
        "<gui><camera name='user'><pose>1 2 3 0 0.5 1</pose><view_controller>ortho</view_controller>"
        "<projection_type>orthographic</projection_type><track_visual><name>m</name></track_visual>"
        "</camera></gui>");
    ASSERT_TRUE(loaded.world->look.camera);
    EXPECT_EQ(loaded.world->look.camera->X_WC.p, (Vec3{1, 2, 3}));
    EXPECT_TRUE(loaded.world->look.camera->orthographic);
    EXPECT_EQ(loaded.world->look.camera->view, "ortho");
    EXPECT_EQ(loaded.world->look.camera->track, "m");
}

TEST(SdfLook, TheCameraOfMinimalSceneIsRead) {
    const Loaded loaded = load_elements(
        kModel +
        "<gui><plugin filename='MinimalScene' name='3D View'><ambient_light>0.4 0.4 0.4</ambient_light>"
        "<background_color>0.8 0.8 0.8</background_color><camera_pose>-6 0 6 0 0.5 0</camera_pose>"
        "</plugin></gui>");
    ASSERT_TRUE(loaded.world->look.camera);
    EXPECT_EQ(loaded.world->look.camera->X_WC.p, (Vec3{-6, 0, 6}));
    ASSERT_TRUE(loaded.world->look.scene);
    EXPECT_EQ(loaded.world->look.scene->background, (Vec3{0.8, 0.8, 0.8}));
}

}  // namespace
}  // namespace roboss
