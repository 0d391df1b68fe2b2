// What collisions compile to: hulls for what moves, surfaces for scenery, pieces for concave outlines; shared
// data, and faults of compile by name.
#include <gtest/gtest.h>

#include <support/meshes.h>

#include <cmath>

#include "model/model.h"

namespace roboss::test {
namespace {

std::shared_ptr<const Model> compile_quietly(const World& world, Diagnostics& diagnostics) {
    return compile(world, {}, diagnostics);
}

const Diagnostic* find(const Diagnostics& diagnostics, const std::string& code) {
    for (const Diagnostic& d : diagnostics.items())
        if (d.code == code) return &d;
    return nullptr;
}

TEST(ShapeStore, AMeshIsAHullWhereItMovesAndASurfaceWhereItStands) {
    World world = empty_world(1e-3);
    const CollisionSpec mesh = mesh_shape(box_mesh({1, 2, 3}), surface(1));
    place(world, scenery(mesh), "a");
    place(world, scenery(mesh), "b", {{9, 0, 0}, {}});
    place(world, box_like(1, {1, 2, 3}, mesh), "c", {{0, 0, 9}, {}});
    place(world, box_like(2, {1, 2, 3}, mesh), "d", {{9, 0, 9}, {}});
    Diagnostics diagnostics;
    const auto model = compile_quietly(world, diagnostics);
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->hulls.size(), 1u) << "shared";
    EXPECT_EQ(model->surfaces.size(), 1u) << "shared";
    ASSERT_EQ(model->statics.size(), 2u);
    EXPECT_EQ(model->statics[0].shape.kind, ShapeKind::kSurface);
    EXPECT_EQ(model->statics[0].shape.surface, model->statics[1].shape.surface);
    EXPECT_EQ(model->type_of(RobotId(std::size_t{0})).shapes[0].shape.kind, ShapeKind::kHull);
    EXPECT_NEAR(model->type_of(RobotId(std::size_t{0})).reach, 0.5 * std::sqrt(14.0), 1e-12);
    EXPECT_EQ(find(diagnostics, "mesh-as-hull"), nullptr) << "it is convex";
}

TEST(ShapeStore, AHollowMeshThatMovesIsNamedOnce) {
    MeshSpec hollow = sheet_mesh(1, 1, 4, 4, [](double x, double y) { return x * x + y * y; });
    World world = empty_world(1e-3);
    const CollisionSpec mesh = mesh_shape(hollow, surface(1));
    place(world, box_like(1, {1, 1, 1}, mesh), "a");
    place(world, box_like(2, {1, 1, 1}, mesh), "b", {{9, 0, 9}, {}});
    Diagnostics diagnostics;
    ASSERT_NE(compile_quietly(world, diagnostics), nullptr);
    int count = 0;
    for (const Diagnostic& d : diagnostics.items()) count += d.code == "mesh-as-hull" ? 1 : 0;
    EXPECT_EQ(count, 1);
}

TEST(ShapeStore, AFlatMeshThatMovesIsAMillimetreThick) {
    World world = empty_world(1e-3);
    const MeshSpec flat = sheet_mesh(1, 1, 2, 2, [](double, double) { return 0.0; });
    place(world, box_like(1, {1, 1, 1}, mesh_shape(flat, surface(1))), "a");
    Diagnostics diagnostics;
    const auto model = compile_quietly(world, diagnostics);
    ASSERT_NE(model, nullptr);
    EXPECT_NE(find(diagnostics, "flat-mesh"), nullptr);
    EXPECT_NEAR(model->hulls.at(0)->volume, 1e-3, 1e-9);
}

TEST(ShapeStore, AMeshWithTooManyCornersForAHullGetsACoarserOne) {
    MeshSpec ball;  // on a spiral over the sphere, more corners than a hull may have
    constexpr int kCorners = 6000;
    for (int i = 0; i < kCorners; ++i) {
        const double z = 1 - (2.0 * i + 1) / kCorners, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
        ball.vertices.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    ball.triangles.push_back({0, 1, 2});
    World world = empty_world(1e-3);
    place(world, box_like(1, {1, 1, 1}, mesh_shape(ball, surface(1))), "a");
    Diagnostics diagnostics;
    const auto model = compile_quietly(world, diagnostics);
    ASSERT_NE(model, nullptr);
    EXPECT_NE(find(diagnostics, "coarse-hull"), nullptr);
    EXPECT_NEAR(model->hulls.at(0)->volume, 4.0 / 3.0 * kPi, 0.02 * 4.0 / 3.0 * kPi);
}

TEST(ShapeStore, AModelWithABadShapeIsLeftOutOfTheModel) {
    World world = empty_world(1e-3);
    place(world, box_like(1, {1, 1, 1}, polyline_shape({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, surface(1))),
          "bad");
    place(world, box_like(1, {1, 1, 1}, box_shape({1, 1, 1}, surface(1))), "good", {{9, 0, 0}, {}});
    Diagnostics diagnostics;
    const auto model = compile_quietly(world, diagnostics);
    ASSERT_NE(model, nullptr);
    ASSERT_EQ(model->robots.size(), 1u);
    EXPECT_EQ(model->robots[0].name, "good");
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_FALSE(diagnostics.refuses());
    ASSERT_NE(find(diagnostics, "left-out"), nullptr);
    EXPECT_NE(find(diagnostics, "left-out")->message.find("'bad'"), std::string::npos);
}

TEST(ShapeStore, AMovableHeightmapAndABadPolylineAreErrors) {
    const auto expect_error = [](const ModelSpec& model, const std::string& code) {
        World world = empty_world(1e-3);
        place(world, model, "a");
        Diagnostics diagnostics;
        EXPECT_EQ(compile_quietly(world, diagnostics), nullptr);
        const Diagnostic* found = find(diagnostics, code);
        ASSERT_NE(found, nullptr) << code;
        EXPECT_NE(found->message.find("'collision'"), std::string::npos);
        EXPECT_FALSE(found->remedy.empty());
    };
    expect_error(box_like(1, {1, 1, 1}, heightmap_shape(2, 2, {0, 0, 0, 0}, 1, 1, surface(1))),
                 "movable-heightmap");
    expect_error(
        box_like(1, {1, 1, 1}, polyline_shape({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, 1, surface(1))),
        "bad-polyline");
    expect_error(box_like(1, {1, 1, 1}, polyline_shape({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, surface(1))),
                 "bad-polyline");
}

TEST(ShapeStore, AConcaveOutlineIsSeveralShapesOfOneCollision) {
    World world = empty_world(1e-3);
    const std::vector<Vec3> outline{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
    place(world, box_like(1, {1, 1, 1}, polyline_shape(outline, 2, surface(1))), "a");
    Diagnostics diagnostics;
    const auto model = compile_quietly(world, diagnostics);
    ASSERT_NE(model, nullptr);
    const auto& shapes = model->type_of(RobotId(std::size_t{0})).shapes;
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_NEAR(shapes[0].shape.hull->volume + shapes[1].shape.hull->volume, 12, 1e-12);
    EXPECT_NEAR(shapes[0].X_BS.p.z, 1, 1e-12);
}

}  // namespace
}  // namespace roboss::test
