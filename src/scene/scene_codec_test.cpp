// A Scene comes back as it was, bit for bit, and damaged bytes are refused.
#include "scene/scene_codec.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include <random>

namespace roboss {
namespace {

GeometrySpec mesh_geometry() {
    GeometrySpec geometry;
    geometry.kind = GeometryKind::kMesh;
    auto mesh = std::make_shared<MeshSpec>();
    mesh->vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 1.0 / 3, 0}, {0, 0, 0.7}};
    mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    geometry.mesh = std::move(mesh);
    return geometry;
}

/// A car with a mesh, a picture, a label, a temperature and a lamp, before a wall, under a sky with fog.
World painted_world() {
    World world;
    world.prototypes = {test::scenery(test::box_shape({2, 3, 4}, test::surface(1))), test::car()};
    auto picture = std::make_shared<PictureSpec>();
    picture->source = "wood.png", picture->width = 2, picture->height = 1, picture->bytes = {1, 2, 3, 4, 5};
    VisualSpec body{"body", mesh_geometry(), {{0.1, 0.2, 1.0 / 3}, {}}, {1.0 / 3, 0.2, 0.1}, 0.7};
    body.finish.colour = picture;
    body.finish.roughness = 0.4;
    body.label = 7, body.labels_model = true, body.temperature = 310.5, body.cast_shadows = false;
    world.prototypes[1].links[0].visuals.push_back(body);
    LightSpec lamp;
    lamp.name = "lamp", lamp.kind = LightKind::kSpot, lamp.outer_angle = 0.9;
    world.prototypes[1].links[0].lights.push_back(lamp);
    world.look.scene = SceneSpec{Vec3{0.1, 0.2, 0.3}, {}, true, true, false, FogSpec{}};
    world.look.camera = CameraSpec{"user", {{1, 2, 3}, {}}, true, "orbit", "a"};
    world.instances = {{"wall", 0, {{5, 0, 1}, {}}, {}}, {"a", 1, {{0, 0, 0.4}, {}}, {}}};
    return world;
}

TEST(SceneCodec, ASceneComesBackAsItWas) {
    const World world = painted_world();
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.textures.size(), 1u);
    const std::vector<std::uint8_t> bytes = encode_scene(scene, *model);
    const Result<Scene> back = decode_scene(bytes, *model);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(encode_scene(back.value(), *model), bytes);
    const SceneShape& was = scene.types[0].links[0].visuals[0];
    const SceneShape& is = back.value().types[0].links[0].visuals[0];
    EXPECT_EQ(is.name, was.name);
    EXPECT_EQ(is.kind, SceneShapeKind::kMesh);
    EXPECT_EQ(is.rgb, was.rgb);
    EXPECT_EQ(is.alpha, was.alpha);
    EXPECT_EQ(is.frame.p, was.frame.p);
    EXPECT_EQ(is.finish.colour, was.finish.colour);
    EXPECT_EQ(is.finish.roughness, was.finish.roughness);
    EXPECT_EQ(is.label, 7);
    EXPECT_TRUE(is.labels_model);
    EXPECT_EQ(is.temperature, 310.5);
    EXPECT_FALSE(is.casts);
    EXPECT_EQ(back.value().meshes[0].vertices, scene.meshes[0].vertices);
    EXPECT_EQ(back.value().textures[0].picture->bytes, scene.textures[0].picture->bytes);
    EXPECT_EQ(back.value().types[0].links[0].lights.at(0).outer_angle, 0.9);
    EXPECT_TRUE(back.value().look.scene.value().fog.has_value());
    EXPECT_EQ(back.value().look.camera.value().track, "a");
    EXPECT_EQ(back.value().robots, scene.robots);
}

TEST(SceneCodec, TheSceneOfAnotherModelIsRefusedByName) {
    const World world = painted_world();
    World other = world;
    other.instances.pop_back();
    const auto model = test::compiled(world), changed = test::compiled(other);
    const Result<Scene> back = decode_scene(encode_scene(make_scene(*model, &world), *model), *changed);
    ASSERT_FALSE(back.ok());
    EXPECT_EQ(back.error().code, "changed-world");
}

TEST(SceneCodec, DamagedBytesGiveAnErrorOrASceneWhoseIndicesPointToSomething) {
    const World world = painted_world();
    const auto model = test::compiled(world);
    const std::vector<std::uint8_t> whole = encode_scene(make_scene(*model, &world), *model);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_FALSE(decode_scene(std::span(whole).first(length), *model).ok()) << length;
    std::mt19937 random(26);  // NOLINT: the same damage in every run
    for (int i = 0; i < 20'000; ++i) {
        std::vector<std::uint8_t> bytes = whole;
        for (int k = 0; k < 3; ++k)
            bytes[12 + random() % (bytes.size() - 12)] = static_cast<std::uint8_t>(random());
        const Result<Scene> back = decode_scene(bytes, *model);
        if (!back) continue;
        const Scene& scene = back.value();
        for (const SceneType& type : scene.types)
            for (const SceneLink& link : type.links)
                for (const SceneShape& shape : link.visuals) {
                    const bool is_mesh = shape.kind == SceneShapeKind::kMesh;
                    ASSERT_LT(is_mesh ? shape.mesh : 0, std::max<std::size_t>(scene.meshes.size(), 1));
                    ASSERT_TRUE(!is_mesh || !scene.meshes.empty());
                    ASSERT_TRUE(!shape.finish.colour || *shape.finish.colour < scene.textures.size());
                }
        for (const SceneMesh& mesh : scene.meshes)
            for (const auto& triangle : mesh.triangles)
                for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
    }
}

}  // namespace
}  // namespace roboss
