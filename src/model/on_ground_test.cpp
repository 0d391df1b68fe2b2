// Robots stood on the ground: on planes, slopes, height fields, meshes and boxes; trees and free bodies;
// added too.
#include <gtest/gtest.h>

#include <support/compiling.h>

#include <cmath>

#include "model/edit.h"
#include "model/on_ground.h"
#include "model/robot_state.h"

namespace roboss::test {
namespace {

CollisionSpec plane_shape(const Pose& X = {}) {
    return collision(GeometryKind::kPlane, surface(1), X);
}

Compiled compile_on_ground(const World& world) {
    Compiled c;
    c.model = stood_on_ground(*compile(world, {}, c.diagnostics), {}, c.diagnostics);
    return c;
}

double height_of(const Model& model, std::size_t robot) {
    return initial_state(model, RobotId(robot)).q[2];
}

/// A trunk of 0.4 x 0.2 x 0.1 m with a leg of 0.3 m below it on a hinge about y, bent by `angle`.
ModelSpec one_legged(double angle) {
    ModelSpec m;
    m.name = "leg";
    m.canonical_link = "trunk";
    m.links.push_back(link("trunk", 1, box_inertia(1, {0.4, 0.2, 0.1})));
    m.links[0].collisions.push_back(box_shape({0.4, 0.2, 0.1}, surface(1)));
    m.links.push_back(link("leg", 1, box_inertia(1, {0.02, 0.02, 0.3})));
    m.links[1].collisions.push_back(sphere_shape(0.02, surface(1), {{0, 0, -0.3}, {}}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "knee", "trunk", "leg", {}, {0, 1, 0}));
    m.joints[0].axes[0].initial_position = angle;
    return m;
}

TEST(OnGround, ATreeStandsOnItsLowestShapeAsItsJointsPutIt) {
    for (const double z : {0.0, 2.0, -3.0}) {
        World world = empty_world(1e-3);
        place(world, scenery(plane_shape()), "ground");
        place(world, one_legged(0.5), "leg", {{1, 2, z}, {}});
        const Compiled c = compile_on_ground(world);
        ASSERT_TRUE(c.model);
        EXPECT_NEAR(height_of(*c.model, 0), 0.3 * std::cos(0.5) + 0.02, 1e-7);
        EXPECT_TRUE(has(c.diagnostics, "start-on-ground"));
        EXPECT_EQ(c.diagnostics.count(Severity::kWarning), 0u);
    }
}

TEST(OnGround, ABodyStandsOnASlope) {
    const double tilt = 0.25;
    World world = empty_world(1e-3);
    place(world, scenery(plane_shape({{}, from_rpy(tilt, 0, 0)})), "slope");
    place(world, solid_sphere(1, 0.2, surface(1)), "ball", {{0, 2, 0}, {}});
    place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(1)), "box", {{1, -1, 9}, {}});
    const Compiled c = compile_on_ground(world);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(height_of(*c.model, 0), 2 * std::tan(tilt) + 0.2 / std::cos(tilt), 1e-7);
    EXPECT_NEAR(height_of(*c.model, 1), -0.9 * std::tan(tilt) + 0.1, 1e-7) << "on its upper edge";
}

TEST(OnGround, ABodyStandsOnAHeightFieldABoxAndAMesh) {
    World world = empty_world(1e-3);
    auto heights = std::make_shared<HeightGridSpec>();
    heights->columns = heights->rows = 3, heights->size_x = heights->size_y = 4;
    heights->heights = {1, 1, 1, 1, 2, 1, 1, 1, 1};
    CollisionSpec field = collision(GeometryKind::kHeightmap, surface(1));
    field.geometry.heights = heights;
    place(world, scenery(field), "hill");
    place(world, scenery(box_shape({2, 2, 1}, surface(1))), "block", {{10, 0, 0}, {}});
    auto sheet = std::make_shared<MeshSpec>();
    sheet->vertices = {{-1, -1, 0.3}, {1, -1, 0.3}, {1, 1, 0.3}, {-1, 1, 0.3}};
    sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
    CollisionSpec mesh = collision(GeometryKind::kMesh, surface(1));
    mesh.geometry.mesh = sheet;
    place(world, scenery(mesh), "sheet", {{20, 0, 0}, {}});
    const ModelSpec box = solid_box(1, {0.2, 0.2, 0.2}, surface(1));
    for (const double x : {0.0, 10.0, 20.0})
        place(world, box, "box_" + std::to_string(x), {{x, 0, 0.45}, {}});
    const Compiled c = compile_on_ground(world);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(height_of(*c.model, 0), 2.1, 1e-7) << "on the top of the hill, from below";
    EXPECT_NEAR(height_of(*c.model, 1), 0.6, 1e-7) << "lifted out of the block";
    EXPECT_NEAR(height_of(*c.model, 2), 0.4, 1e-7);
}

/// A closed box of triangles, around the origin.
CollisionSpec closed_mesh(const Vec3& half) {
    auto mesh = std::make_shared<MeshSpec>();
    for (int i = 0; i < 8; ++i)
        mesh->vertices.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                  (i & 4) != 0 ? half.z : -half.z});
    mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    CollisionSpec shape = collision(GeometryKind::kMesh, surface(1));
    shape.geometry.mesh = mesh;
    return shape;
}

TEST(OnGround, ABodyInsideASolidStandsOnTopOfIt) {
    for (const bool is_mesh : {false, true}) {
        World world = empty_world(1e-3);
        place(world, scenery(is_mesh ? closed_mesh({5, 5, 1}) : box_shape({10, 10, 2}, surface(1))), "block",
              {{0, 0, -1}, {}});
        place(world, scenery(plane_shape()), "far_below", {{0, 0, -9}, {}});
        place(world, scenery(box_shape({2, 2, 0.5}, surface(1))), "step", {{3, 0, 0.25}, {}});
        const ModelSpec ball = solid_sphere(1, 0.3, surface(1));
        for (const double z : {-0.1, -0.5, -1.5})
            place(world, ball, "ball_" + std::to_string(z), {{-1, 0, z}, {}});
        place(world, ball, "below", {{-1, 0, -5}, {}});
        place(world, ball, "under_the_step", {{3, 0, -0.5}, {}});
        place(world, one_legged(0), "leg", {{0, 3, -0.9}, {}});
        const Compiled c = compile_on_ground(world);
        ASSERT_TRUE(c.model);
        for (const std::size_t i : {0u, 1u, 2u})
            EXPECT_NEAR(height_of(*c.model, i), 0.3, 1e-7) << is_mesh << i;
        EXPECT_NEAR(height_of(*c.model, 3), -8.7, 1e-7) << "it does not lie in the block";
        EXPECT_NEAR(height_of(*c.model, 4), 0.8, 1e-7) << "on the step that stands on the block";
        EXPECT_NEAR(height_of(*c.model, 5), 0.32, 1e-7);
        EXPECT_EQ(c.diagnostics.count(Severity::kWarning), 0u);
    }
}

TEST(OnGround, AModelOfSeveralRobotsMovesAsOne) {
    World world = empty_world(1e-3);
    place(world, scenery(plane_shape()), "ground");
    ModelSpec row = row_of_three();  // no joints: three robots
    row.links[1].X_ML.p.z = 1;
    place(world, row, "row", {{0, 0, 5}, {}});
    const Compiled c = compile_on_ground(world);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(height_of(*c.model, 0), 0.1, 1e-7);
    EXPECT_NEAR(height_of(*c.model, 1), 1.1, 1e-7);
}

TEST(OnGround, ShapesThatCannotTouchCarryNothing) {
    World world = empty_world(1e-3);
    place(world, scenery(plane_shape()), "ground");
    CollisionSpec ghost = box_shape({2, 2, 2}, surface(1));
    ghost.surface.collide_bitmask = ghost.surface.category_bitmask = 0;
    place(world, scenery(ghost), "ghost");
    place(world, solid_sphere(1, 0.2, surface(1)), "ball", {{0, 0, 3}, {}});
    const Compiled c = compile_on_ground(world);
    EXPECT_NEAR(height_of(*c.model, 0), 0.2, 1e-7);
}

TEST(OnGround, WhatCannotStandIsLeftWhereItIsAndTold) {
    World world = empty_world(1e-3);
    place(world, solid_sphere(1, 0.2, surface(1)), "ball", {{0, 0, 3}, {}});
    ModelSpec bare = one_link(link("ghost", 1, sphere_inertia(1, 0.1)));
    place(world, bare, "ghost", {{0, 0, 2}, {}});
    ModelSpec arm = solid_box(1, {0.1, 0.1, 0.1}, surface(1));
    arm.joints.push_back(joint(JointSpecKind::kRevolute, "j", "world", "box", {}, {0, 0, 1}));
    place(world, arm, "arm", {{5, 0, 1}, {}});
    const Compiled c = compile_on_ground(world);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(height_of(*c.model, 0), 3);
    EXPECT_EQ(height_of(*c.model, 1), 2);
    EXPECT_EQ(c.model->robots[2].X_WR.p.z, 1);
    EXPECT_TRUE(has(c.diagnostics, "start-no-ground"));
    EXPECT_TRUE(has(c.diagnostics, "start-no-shapes"));
    EXPECT_TRUE(has(c.diagnostics, "start-fixed"));
}

TEST(OnGround, CopiesThatAreAddedStandOnTheGroundOfTheRun) {
    World world = empty_world(1e-3);
    place(world, scenery(plane_shape({{0, 0, 1}, {}})), "ground");
    place(world, solid_sphere(1, 0.2, surface(1)), "first", {{0, 0, 3}, {}});
    const Compiled c = compile_one(one_legged(0.5));
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    const std::vector<CopyPlace> places{{"a", {{1, 0, 0}, {}}}, {"b", {{2, 0, 7}, from_rpy(0, 0, 1)}}};
    const auto edit = with_models(*model, *c.model, places, Standing::kOnGround);
    ASSERT_TRUE(edit);
    const Model& both = *edit.value().model;
    EXPECT_EQ(height_of(both, 0), 3) << "those that were there stay";
    for (const std::size_t i : {1u, 2u})
        EXPECT_NEAR(height_of(both, i), 1 + 0.3 * std::cos(0.5) + 0.02, 1e-7);
    EXPECT_TRUE(has(edit.value().found, "start-on-ground"));
    const auto apart = with_models(*c.model, *c.model, places, Standing::kOnGround);
    ASSERT_TRUE(apart);
    EXPECT_TRUE(has(apart.value().found, "start-no-ground"));
    EXPECT_EQ(with_models(*model, *c.model, places).value().model->robots[1].X_WR.p.z, 0);
}

}  // namespace
}  // namespace roboss::test
