// Lights, sky and camera reach the viewer: in the scene's JSON, and lights of scenery in the world.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/model.h"
#include "scene/scene_file.h"

namespace roboss {
namespace {

LightSpec lamp(const std::string& name, const Vec3& p) {
    LightSpec light;
    light.name = name;
    light.X_FL.p = p;
    return light;
}

ModelSpec ball(bool is_static) {
    ModelSpec model;
    model.name = model.canonical_link = "ball";
    model.is_static = is_static;
    LinkSpec& link = model.links.emplace_back();
    link.name = "ball";
    CollisionSpec& collision = link.collisions.emplace_back();
    collision.name = "c";
    collision.geometry.kind = GeometryKind::kSphere;
    collision.geometry.radius = 0.1;
    VisualSpec& visual = link.visuals.emplace_back();
    visual.name = "v";
    visual.geometry.kind = GeometryKind::kCone;
    visual.geometry.radius = 0.2;
    visual.geometry.length = 0.5;
    visual.emissive = Vec3{0, 1, 0};
    visual.cast_shadows = false;
    link.lights.push_back(lamp("on_link", {0, 0, 1}));
    return model;
}

nlohmann::json json_of(const World& world) {
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    return nlohmann::json::parse(scene_file(make_scene(*model, &world), *model, 1).json);
}

World two_balls() {
    World world;
    world.name = "w";
    world.prototypes = {ball(false), ball(true)};
    world.instances.push_back({"moves", 0, {}, {}});
    world.instances.push_back({"stands", 1, {{5, 0, 0}, {}}, {}});
    return world;
}

TEST(SceneLook, AWorldThatSaysNothingHasNone) {
    World world = two_balls();
    for (ModelSpec& model : world.prototypes) model.links[0].lights.clear();
    EXPECT_FALSE(json_of(world).contains("look"));
}

TEST(SceneLook, LightsOfRobotsAreInTheirLinksAndThoseOfSceneryInTheWorld) {
    World world = two_balls();
    world.look.lights.push_back(lamp("of_world", {1, 2, 3}));
    const nlohmann::json scene = json_of(world), lights = scene["look"]["lights"];
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0]["name"], "of_world");
    EXPECT_EQ(lights[1]["frame"][0], 5.0);
    EXPECT_EQ(lights[1]["frame"][2], 1.0);
    EXPECT_EQ(scene["types"][0]["links"][0]["lights"][0]["name"], "on_link");
}

TEST(SceneLook, AVisualHasItsGlowAndThrowsNoShadow) {
    const nlohmann::json visual = json_of(two_balls())["types"][0]["links"][0]["visuals"][0];
    EXPECT_EQ(visual["shape"], "cone");
    EXPECT_EQ(visual["length"], 0.5);
    EXPECT_EQ(visual["finish"]["emissive"][1], 1.0);
    EXPECT_EQ(visual["casts"], false);
}

TEST(SceneLook, TheLookIsNotPartOfTheModel) {
    World world = two_balls();
    Diagnostics diagnostics;
    const std::uint64_t plain = compile(world, {}, diagnostics)->hash;
    world.look.lights.push_back(lamp("l", {1, 2, 3}));
    world.look.camera = CameraSpec{};
    world.look.scene = SceneSpec{};
    world.prototypes[0].links[0].lights.clear();
    EXPECT_EQ(compile(world, {}, diagnostics)->hash, plain);
}

}  // namespace
}  // namespace roboss
