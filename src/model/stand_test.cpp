// Static models with sensors or controllers: robots without degrees of freedom, whose shapes are scenery.
#include <gtest/gtest.h>

#include <support/compiling.h>

#include "model/edit.h"
#include "model/robot_state.h"

namespace roboss::test {
namespace {

ModelSpec conveyor(GeometryKind kind = GeometryKind::kBox) {
    ModelSpec m = scenery(collision(kind, surface(0.5)));
    m.name = "conveyor";
    m.links[0].collisions[0].geometry.size = {4, 1, 0.2};
    m.links[0].X_ML = {{0, 0, 1}, {}};
    TrackControllerSpec track;
    track.link = LinkNames{"link"};
    m.onboard.push_back({"track", track, {}});
    return m;
}

ModelSpec fixed_belt() {
    ModelSpec m = scenery(box_shape({4, 1, 0.2}, surface(0.5)));
    SurfaceVelocitySpec motion;
    motion.link = LinkNames{"link"}, motion.linear = {1, 0, 0}, motion.fixed = true;
    m.onboard.push_back({"belt", motion, {}});
    return m;
}

TEST(Stand, AStaticModelWithATrackControllerIsARobotWhoseSceneryItMoves) {
    const Compiled c = compile_one(conveyor(), at_x(3));
    ASSERT_TRUE(c.model);
    ASSERT_EQ(c.model->robots.size(), 1u);
    const RobotType& type = c.type();
    EXPECT_TRUE(type.is_static);
    EXPECT_EQ(type.nv, 0);
    EXPECT_TRUE(type.shapes.empty());
    EXPECT_TRUE(type.find_channel("link/link/track_cmd_vel"));
    EXPECT_EQ(type.scenery.min, (Vec3{-2, -0.5, 0.9}));
    EXPECT_EQ(type.scenery.max, (Vec3{2, 0.5, 1.1}));
    ASSERT_EQ(c.model->statics.size(), 1u);
    EXPECT_TRUE(c.model->statics[0].driven);
    EXPECT_EQ(c.model->statics[0].robot, RobotId(std::size_t{0}));
    const Order push{0, ClientId(0u), 1, RobotId(std::size_t{0}), SetPose{}};
    EXPECT_FALSE(check_order(*c.model, push)) << "no order moves it";
    const Order go{0, ClientId(0u), 1, RobotId(std::size_t{0}), Command{0, {0.5}}};
    EXPECT_TRUE(check_order(*c.model, go));
}

TEST(Stand, WithSurfaceMotionsThatTakeNoCommandIsOnlyScenery) {
    World world = empty_world(1e-3);
    place(world, fixed_belt(), "belt", {{1, 2, 3}, from_rpy(0, 0, kPi / 2)});
    place(world, solid_sphere(1, 0.1, surface(0.5)), "ball");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->robots.size(), 1u);
    const SurfaceFlow& flow = model->statics.at(0).flow;
    EXPECT_NEAR(norm(flow.linear - Vec3{0, 1, 0}), 0, 1e-12);
    EXPECT_EQ(flow.at, (Vec3{1, 2, 3}));
    EXPECT_FALSE(model->statics[0].driven);
}

TEST(Stand, ACommandedPlaneIsReportedAndStandsStill) {
    const Compiled c = compile_one(conveyor(GeometryKind::kPlane));
    ASSERT_TRUE(c.model);
    EXPECT_TRUE(has(c.diagnostics, "plane-that-moves"));
    EXPECT_FALSE(c.model->statics.at(0).driven);
    EXPECT_TRUE(c.type().scenery.empty());
}

TEST(Stand, KeepsItsSceneryWhenItIsAddedElsewhereAndLosesItsMotionWhenItIsRemoved) {
    World world = empty_world(1e-3);
    place(world, solid_sphere(1, 0.1, surface(0.5)), "ball");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    World more = empty_world(1e-3);
    place(more, conveyor(), "conveyor");
    place(more, fixed_belt(), "belt");
    const auto addition = compile(more, {}, diagnostics);
    ASSERT_TRUE(model && addition);
    const auto edit = with_models(*model, *addition, {{0, 5, 0}, from_rpy(0, 0, kPi)}, "");
    ASSERT_TRUE(edit);
    const Model& both = *edit.value().model;
    ASSERT_EQ(both.robots.size(), 2u);
    EXPECT_EQ(both.statics.at(0).robot, RobotId(std::size_t{1}));
    EXPECT_NEAR(norm(both.statics.at(1).flow.linear - Vec3{-1, 0, 0}), 0, 1e-12);
    const auto without = without_robots(both, {"conveyor"});
    ASSERT_TRUE(without);
    EXPECT_FALSE(without.value().model->statics.at(0).driven);
    EXPECT_TRUE(without.value().model->statics.at(1).flow.moves());
}

}  // namespace
}  // namespace roboss::test
