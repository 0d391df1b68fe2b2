// A scene shows what the World says, and its frames put links where the physics has them.
#include "scene/scene.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "scene/scene_file.h"
#include "wire/view_state.h"

namespace roboss {
namespace {

using Json = nlohmann::json;

VisualSpec visual(const std::string& name, const GeometrySpec& geometry, const Vec3& rgb,
                  const Pose& X_LV = {}) {
    return {name, geometry, X_LV, rgb, 1.0};
}

/// A car with visuals in two colours, one without any, an arm, a chain of balls, a house and the ground.
World small_world() {
    World world;
    world.name = "small";
    world.prototypes.push_back(test::scenery(test::collision(GeometryKind::kPlane, test::surface(0.9))));
    world.prototypes.push_back(test::car());
    GeometrySpec box;
    box.size = {0.4, 0.2, 0.1};
    world.prototypes[1].links[0].visuals.push_back(visual("body", box, {1, 0, 0}, {{0, 0, 0.02}, {}}));
    world.prototypes.push_back(world.prototypes[1]);
    world.prototypes[2].links[0].visuals[0].rgb = {0, 0, 1};
    world.prototypes.push_back(test::car());
    world.prototypes.push_back(test::arm());
    world.prototypes.push_back(test::ball_chain());
    world.prototypes.push_back(test::mixed_tree());
    world.prototypes.push_back(test::scenery(test::box_shape({2, 3, 4}, test::surface(1))));
    world.prototypes[7].links[0].X_ML = {{0, 0, 2}, {}};
    world.prototypes[7].links[0].visuals.push_back(visual("wall", box, {0.9, 0.8, 0.7}, {{0, 0, 1}, {}}));
    const char* names[] = {"ground", "red", "blue", "plain", "arm", "chain", "tree", "house"};
    for (std::size_t i = 0; i < std::size(names); ++i)
        world.instances.push_back(
            {names[i], i, {{3.0 * static_cast<double>(i), 1, 0.4}, from_rpy(0, 0, 0.3)}, {}});
    return world;
}

Pose pose_of(const Json& j) {
    return {{j[0], j[1], j[2]}, {j[3], j[4], j[5], j[6]}};
}

TEST(Scene, RobotsOfOneTypeThatLookDifferentAreTwoTypesOfTheScene) {
    const World world = small_world();
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    ASSERT_EQ(scene.robots.size(), model->robots.size());
    const auto look = [&](const char* robot) {
        return scene.types[scene.robots[model->find_robot(robot)->index()]].links[0].visuals;
    };
    EXPECT_EQ(model->robots[model->find_robot("red")->index()].type,
              model->robots[model->find_robot("blue")->index()].type);
    ASSERT_EQ(look("red").size(), 1u);
    EXPECT_EQ(look("red")[0].rgb, (Vec3{1, 0, 0}));
    EXPECT_EQ(look("blue")[0].rgb, (Vec3{0, 0, 1}));
    EXPECT_EQ(look("red")[0].frame.p, (Vec3{0, 0, 0.02}));
    ASSERT_EQ(look("plain").size(), 1u) << "collision shapes stand in";
    EXPECT_EQ(look("plain")[0].kind, SceneShapeKind::kBox);
}

TEST(Scene, SceneryIsDrawnByItsVisualsElseByItsCollisions) {
    const World world = small_world();
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    ASSERT_EQ(scene.statics.size(), 2u);
    EXPECT_EQ(scene.statics[0].name, "house::link::wall");
    const Pose X_WV = world.instances[7].X_WM * Pose{{0, 0, 3}, {}};
    EXPECT_NEAR(norm(scene.statics[0].frame.p - X_WV.p), 0, 1e-12);
    EXPECT_EQ(scene.statics[1].kind, SceneShapeKind::kPlane);
    const Scene bare = make_scene(*model, nullptr);
    EXPECT_EQ(bare.statics.size(), 2u);
    EXPECT_EQ(bare.types.size(), model->types.size());
    EXPECT_FALSE(bare.types[0].links[0].visuals.empty());
}

TEST(Scene, MeshesAreKeptOnceAndHaveTheirTriangles) {
    auto mesh = std::make_shared<MeshSpec>();
    mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh->triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
    GeometrySpec geometry;
    geometry.kind = GeometryKind::kMesh;
    geometry.mesh = mesh;
    World world;
    world.prototypes.push_back(test::one_link(test::link("rock", 1, test::box_inertia(1, {1, 1, 1}))));
    LinkSpec& link = world.prototypes[0].links[0];
    link.visuals = {visual("a", geometry, {1, 1, 1}), visual("b", geometry, {1, 1, 1}, {{0, 0, 1}, {}})};
    link.collisions.push_back(test::collision(GeometryKind::kMesh, test::surface(1)));
    link.collisions[0].geometry = geometry;
    world.instances.push_back({"rock", 0, {}, {}});
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    ASSERT_EQ(scene.meshes.size(), 2u) << "the visual's, and the hull that collides";
    EXPECT_EQ(scene.meshes[1].vertices.size(), 4u);
    EXPECT_EQ(scene.meshes[1].triangles.size(), 4u);
    const SceneFile file = scene_file(scene, *model, 1);
    std::uint32_t counts[2] = {};
    std::memcpy(counts, file.meshes[0].data(), sizeof(counts));
    EXPECT_EQ(counts[0], 4u);
    EXPECT_EQ(counts[1], 4u);
    EXPECT_EQ(file.meshes[0].size(), 8u + 4 * 12 + 4 * 12);
}

std::shared_ptr<const PictureSpec> picture(std::vector<std::uint8_t> bytes) {
    return std::make_shared<const PictureSpec>(PictureSpec{"a", PictureKind::kPng, 4, 4, std::move(bytes)});
}

TEST(Scene, PicturesAreListedOnceByTheirContentAndMeshesKeepTheirPlacesInThem) {
    World world = small_world();
    VisualSpec& red = world.prototypes[1].links[0].visuals[0];
    VisualSpec& blue = world.prototypes[2].links[0].visuals[0];
    red.finish = {picture({1, 2, 3}), picture({4}), nullptr, nullptr, 0.25, std::nullopt};
    blue.finish.colour = picture({1, 2, 3});  // another file with the same content
    MeshSpec sheet{"s", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{0, 0}, {1, 0}, {0, 1}}};
    red.geometry.kind = GeometryKind::kMesh;
    red.geometry.mesh = std::make_shared<const MeshSpec>(std::move(sheet));
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    ASSERT_EQ(scene.textures.size(), 2u);
    const SceneFile file = scene_file(scene, *model, 1);
    const Json json = Json::parse(numbered(file, 1));
    const auto finish = [&](const char* robot) {
        const std::size_t type = json["robots"][model->find_robot(robot)->index()]["type"];
        return json["types"][type]["links"][0]["visuals"][0].value("finish", Json());
    };
    EXPECT_EQ(finish("red")["colour"], finish("blue")["colour"]);
    EXPECT_EQ(finish("red")["roughness"], 0.25);
    EXPECT_FALSE(finish("red").contains("metalness"));
    EXPECT_TRUE(finish("plain").is_null());
    EXPECT_EQ(finish("red")["colour"], to_hex(file.textures[0].hash));
    EXPECT_EQ(file.textures[0].bytes, (std::vector<std::uint8_t>{1, 2, 3}));
    EXPECT_EQ(file.meshes[0].size(), 8u + 3 * 12 + 12 + 3 * 8);
    const Result<SceneFile> back = decode_scene_file(encode(file));
    ASSERT_TRUE(back.ok()) << back.error().text();
    ASSERT_EQ(back.value().textures.size(), 2u);
    EXPECT_EQ(back.value().textures[1].bytes, file.textures[1].bytes);
    std::vector<std::uint8_t> odd = encode(file);
    odd[odd.size() - 4 - 1 - 1] = 9;  // the kind of the last picture
    EXPECT_FALSE(decode_scene_file(odd).ok());
    for (std::size_t n = 0; n < odd.size(); n += 5)
        EXPECT_FALSE(decode_scene_file(std::span(odd).first(n)).ok());
}

TEST(Scene, OnlyAWhiteHighlightShinesForRoughnessHasNoColour) {
    World world = small_world();
    VisualSpec& red = world.prototypes[1].links[0].visuals[0];
    const auto roughness = [&](const Vec3& specular) {
        red.specular = specular;
        const auto model = test::compiled(world);
        const Scene scene = make_scene(*model, &world);
        const std::size_t type = scene.robots[model->find_robot("red")->index()];
        return scene.types[type].links[0].visuals[0].finish.roughness;
    };
    ASSERT_TRUE(roughness({0.8, 0.8, 0.8}).has_value());
    EXPECT_NEAR(*roughness({0.8, 0.8, 0.8}), 0.5, 1e-12);
    EXPECT_FALSE(roughness({0.8, 0, 0}).has_value());
    EXPECT_FALSE(roughness({0.1, 0.1, 0.1}).has_value());
}

/// The rotation or way of a body's joint, from the values of the State message.
Pose motion_of(const Json& body, const std::vector<double>& q) {
    const Vec3 axis{body["axis"][0], body["axis"][1], body["axis"][2]};
    const std::size_t at = body["q"];
    if (body["course"] == "none") return {};
    if (body["course"] == "quaternion") return {{}, normalized(Quat{q[at], q[at + 1], q[at + 2], q[at + 3]})};
    return {axis * (q[at] * body["slide"].get<double>()),
            axis_angle(axis, q[at] * body["turn"].get<double>())};
}

struct ShownRobot {
    Pose base;
    std::vector<double> q;
};

/// As the page decodes an entry.
ShownRobot decoded(const std::vector<std::uint8_t>& entry, const Json& ranges) {
    ShownRobot shown;
    float p[3];
    std::int16_t w[4];
    std::memcpy(p, entry.data() + 4, sizeof(p));
    std::memcpy(w, entry.data() + 16, sizeof(w));
    shown.base.p = {p[0], p[1], p[2]};
    shown.base.q = normalized(Quat{w[0] / 32767.0, w[1] / 32767.0, w[2] / 32767.0, w[3] / 32767.0});
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        std::int16_t value = 0;
        std::memcpy(&value, entry.data() + 24 + 2 * i, sizeof(value));
        shown.q.push_back(value * ranges[i].get<double>() / 32767);
    }
    return shown;
}

TEST(Scene, WindCommandsAndSceneryThatMovesAreToldOnlyWhereThereAreSome) {
    const World world = small_world();
    Model model = *test::compiled(world);
    Scene scene = make_scene(model, &world);
    Json plain = Json::parse(scene_file(scene, model, 0).json);
    EXPECT_FALSE(plain.contains("flows"));
    EXPECT_FALSE(plain.contains("wind"));
    for (const Json& type : plain["types"]) EXPECT_FALSE(type.contains("channels"));

    const std::size_t red = model.find_robot("red")->index();
    ChannelInfo drive;
    drive.channel = {"cmd_vel", "", {{"linear_x", "m/s"}}, false};
    model.types[model.robots[red].type.index()].channels = {drive};
    SceneFlow belt, table;
    belt.shape = scene.statics[0], table.shape = scene.statics[1];
    belt.motion.linear = {0.5, 0, 0};
    table.robot = RobotId(red), table.link = LinkId(0u);
    scene.flows = {belt, table};
    model.wind = {3, 0, -1};
    scene.types[scene.robots[red]].links[0].collisions[0].still = true;
    const Json told = Json::parse(scene_file(scene, model, 0).json);
    EXPECT_EQ(
        told["types"][scene.robots[red]]["channels"],
        Json::parse(
            R"([{"name": "cmd_vel", "list": false, "values": [{"name": "linear_x", "unit": "m/s"}]}])"));
    EXPECT_EQ(told["types"][scene.robots[red]]["links"][0]["collisions"][0]["still"], true);
    EXPECT_EQ(told["wind"], Json({3, 0, -1}));
    EXPECT_EQ(told["flows"][0]["linear"], Json({0.5, 0, 0}));
    EXPECT_EQ(told["flows"][0]["shape"], told["statics"][0]);
    EXPECT_FALSE(told["flows"][0].contains("robot"));
    EXPECT_EQ(told["flows"][1]["robot"], red);
    EXPECT_FALSE(told["flows"][1].contains("linear")) << "its state says how";
}

TEST(Scene, FramesAndViewStatesPutLinksWhereTheyAre) {
    const World world = small_world();
    const auto model = test::compiled(world);
    const Scene scene = make_scene(*model, &world);
    const Json json = Json::parse(numbered(scene_file(scene, *model, 7), 3));
    EXPECT_EQ(json["scene"], 3);
    EXPECT_EQ(json["seed"], 7);
    const ViewLayout layout(*model);
    test::Random random(11);
    double worst = 0;
    for (std::size_t r = 0; r < model->robots.size(); ++r) {
        const RobotId robot(r);
        const RobotType& type = model->type_of(robot);
        RobotState state = initial_state(*model, robot);
        for (const Dof& dof : type.dofs) {
            const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
            const auto q = static_cast<std::size_t>(body.q_index);
            if (body.joint != JointKind::kBall) state.q[q] += random.uniform(-1, 1);
            if (body.joint != JointKind::kBall) continue;
            const Quat turned = from_rpy(random.uniform(-1, 1), 0.3, random.uniform(-3, 3));
            state.q[q] = turned.w, state.q[q + 1] = turned.x, state.q[q + 2] = turned.y,
            state.q[q + 3] = turned.z;
        }
        std::vector<std::uint8_t> entry;
        layout.append(*model, robot, state, entry);
        ASSERT_EQ(layout.entry_at(entry, 0), robot);
        const Json& shown_type = json["types"][json["robots"][r]["type"].get<std::size_t>()];
        const ShownRobot shown = decoded(entry, shown_type["ranges"]);
        std::vector<Pose> X_WB;
        for (const Json& body : shown_type["bodies"]) {
            const int parent = body["parent"];
            const Pose X_WP = parent < 0 ? shown.base : X_WB[static_cast<std::size_t>(parent)];
            X_WB.push_back(X_WP * pose_of(body["frame"]) * motion_of(body, shown.q));
        }
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            const Json& link = shown_type["links"][l];
            const int body = link["body"];
            const Pose X_WL =
                (body < 0 ? shown.base : X_WB[static_cast<std::size_t>(body)]) * pose_of(link["frame"]);
            const Transform truth = link_pose(type, state, LinkId(l));
            worst = std::max(worst, norm(X_WL.p - truth.p));
            EXPECT_NEAR(norm(X_WL.p - truth.p), 0, 3e-3) << model->robots[r].name << " " << link["name"];
            EXPECT_NEAR(norm(to_matrix(X_WL.q).col(0) - truth.R.col(0)), 0, 2e-3) << link["name"];
        }
        // the frame that pose orders move
        if (type.free_base) {
            const Transform X_WR = to_transform(shown.base * pose_of(shown_type["origin"]));
            const Transform X_WB0 = X_WR * type.X_RB;
            EXPECT_NEAR(norm(X_WB0.p - to_transform(base_pose(state)).p), 0, 1e-4);
        }
    }
    test::tell("farthest link from where it is, m", worst);
}

TEST(SceneFile, SurvivesItsBytesAndNoBytesBreakIt) {
    const World world = small_world();
    const auto model = test::compiled(world);
    const SceneFile file = scene_file(make_scene(*model, &world), *model, 7);
    const std::vector<std::uint8_t> bytes = encode(file);
    const Result<SceneFile> back = decode_scene_file(bytes);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value().json, file.json);
    EXPECT_EQ(back.value().model_hash, model->hash);
    EXPECT_EQ(back.value().meshes, file.meshes);
    for (std::size_t n = 0; n < bytes.size(); n += 7)
        EXPECT_FALSE(decode_scene_file(std::span(bytes).first(n)).ok());
}

}  // namespace
}  // namespace roboss
