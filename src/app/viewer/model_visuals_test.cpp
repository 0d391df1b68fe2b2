// Robots that were added look as in their own world, under the name and at the place where they were put;
// earlier Models look as they did.
#include "app/viewer/model_visuals.h"

#include <gtest/gtest.h>

#include "app/run/removed_robots.h"
#include "model/edit.h"
#include "scene/scene.h"

namespace roboss {
namespace {

VisualSpec ball(const Vec3& rgb) {
    VisualSpec visual;
    visual.name = "skin";
    visual.geometry.kind = GeometryKind::kSphere;
    visual.rgb = rgb;
    return visual;
}

/// A box that looks like a ball of this colour, and a post beside it.
World world_of(const std::string& robot, const Vec3& rgb) {
    World world;
    world.name = "w";
    for (const bool is_static : {false, true}) {
        ModelSpec spec;
        spec.is_static = is_static;
        LinkSpec link;
        link.name = "body";
        link.collisions.push_back(CollisionSpec{});
        link.collisions.back().name = "c";
        link.visuals.push_back(ball(rgb));
        spec.links.push_back(link);
        world.prototypes.push_back(spec);
    }
    world.instances.push_back({robot, 0, {{0, 0, 1}, {}}, {}});
    world.instances.push_back({"post", 1, {{2, 0, 0}, {}}, {}});
    return world;
}

std::shared_ptr<const Model> compiled(const World& world) {
    Diagnostics found;
    const auto model = compile(world, {}, found);
    EXPECT_FALSE(found.has_errors());
    return model;
}

const SceneShape& shown(const Scene& scene, const Model& model, const char* robot) {
    return scene.types[scene.robots[model.find_robot(robot)->index()]].links[0].visuals[0];
}

TEST(ModelVisuals, WhatIsAddedLooksAsItsOwnWorldSaysAndWhatWasBeforeStays) {
    const World blue = world_of("box", {0, 0, 1}), red = world_of("box", {1, 0, 0});
    const auto before = compiled(blue), addition = compiled(red);
    const Pose X_WA{{10, 0, 0}, from_rpy(0, 0, 1.5707963267948966)};
    const auto after = with_models(*before, *addition, X_WA, "new").value().model;
    ModelVisuals visuals;
    visuals.begin(*before, blue);
    visuals.add({*before, *after, *addition}, red, std::vector<CopyPlace>{{"new", X_WA}});
    const Scene scene = make_scene(*after, visuals.of(*after));
    EXPECT_EQ(shown(scene, *after, "box").rgb.z, 1);
    EXPECT_EQ(shown(scene, *after, "new").kind, SceneShapeKind::kSphere);
    EXPECT_EQ(shown(scene, *after, "new").rgb.x, 1);
    ASSERT_EQ(scene.statics.size(), 2u) << "each post is drawn once, as a ball";
    EXPECT_EQ(scene.statics[1].kind, SceneShapeKind::kSphere);
    EXPECT_NEAR(scene.statics[1].frame.p.x, 10, 1e-12);
    EXPECT_NEAR(scene.statics[1].frame.p.y, 2, 1e-12);
    const Scene then = make_scene(*before, visuals.of(*before));
    EXPECT_EQ(then.statics.size(), 1u) << "of a rewind to before it came";
    EXPECT_EQ(shown(then, *before, "box").rgb.z, 1);
}

TEST(ModelVisuals, ChangesThatAddNothingKeepTheLooksAndANameGivenAgainLooksNew) {
    const World blue = world_of("box", {0, 0, 1}), red = world_of("box", {1, 0, 0});
    const auto first = compiled(blue), addition = compiled(red);
    const auto without = without_robots(*first, {"box"}).value().model;
    const auto again = with_models(*without, *addition, {}, "").value().model;
    ModelVisuals visuals;
    visuals.begin(*first, blue);
    visuals.change(*first, *without);
    visuals.add({*without, *again, *addition}, red, std::vector<CopyPlace>{{}});
    const auto finer = with_accuracy(*again, {"high", {}, {}}).value().model;
    visuals.change(*again, *finer);
    EXPECT_EQ(shown(make_scene(*finer, visuals.of(*finer)), *finer, "box").rgb.x, 1);
    EXPECT_EQ(visuals.of(*without).size(), 1u);
}

TEST(ModelVisuals, OfAReplayOnlyWhatWasAddedIsKnown) {
    const World red = world_of("box", {1, 0, 0});
    const auto before = compiled(world_of("old", {0, 0, 1})), addition = compiled(red);
    const auto after = with_models(*before, *addition, {}, "new").value().model;
    ModelVisuals visuals;
    EXPECT_TRUE(visuals.of(*before).empty());
    visuals.add({*before, *after, *addition}, red, std::vector<CopyPlace>{{"new", {}}});
    const Scene scene = make_scene(*after, visuals.of(*after));
    EXPECT_EQ(shown(scene, *after, "old").kind, SceneShapeKind::kBox);
    EXPECT_EQ(shown(scene, *after, "new").kind, SceneShapeKind::kSphere);
}

TEST(ModelVisuals, CopiesLookLikeTheirOriginalsAndRobotsThatReturnAsTheyDid) {
    const World blue = world_of("old", {0, 0, 1}), red = world_of("box", {1, 0, 0});
    const auto first = compiled(blue), addition = compiled(red);
    const std::vector<CopyPlace> place{{"new", {}}};
    const auto with = with_models(*first, *addition, place).value().model;
    ModelVisuals visuals;
    visuals.begin(*first, blue);
    visuals.add({*first, *with, *addition}, red, place);
    const std::vector<CopyRobots::Copy> copies{{"new", "new_2", {}}, {"old", "old_2", {}}};
    const std::vector<RobotFrom> robots{{with, *with->find_robot("new"), "new_2", {}},
                                        {with, *with->find_robot("old"), "old_2", {}}};
    const auto more = with_robots(*with, robots).value().model;
    visuals.copy(*with, *more, copies);
    const Scene scene = make_scene(*more, visuals.of(*more));
    EXPECT_EQ(shown(scene, *more, "new_2").rgb.x, 1);
    EXPECT_EQ(shown(scene, *more, "old_2").rgb.z, 1);

    RemovedRobots removed;
    const ModelEdit less = without_robots(*more, {"new", "new_2"}).value();
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < more->robots.size(); ++i) states.push_back(initial_state(*more, RobotId(i)));
    removed.keep({more, less.now, states, visuals.worlds_of(*more)});
    visuals.change(*more, *less.model);
    const RemovedRobot kept = removed.find({"new"}).value().front();
    const std::vector<RobotFrom> back{{kept.model, kept.robot, "new", {}, {}, true}};
    const auto again = with_robots(*less.model, back).value().model;
    visuals.bring_back(*less.model, *again, kept.worlds);
    EXPECT_EQ(shown(make_scene(*again, visuals.of(*again)), *again, "new").rgb.x, 1);
}

TEST(RemovedRobots, TheLastOneOfANameReturnsAndOldOnesAreForgotten) {
    const auto model = compiled(world_of("box", {1, 0, 0}));
    RemovedRobots removed;
    EXPECT_EQ(removed.find({"box"}).error().code, "no-robot");
    RobotState state = initial_state(*model, RobotId(0u));
    state.contacts.resize(2);
    for (std::size_t k = 0; k < RemovedRobots::kRemovalsMost + 20; ++k) {
        state.q[0] = static_cast<double>(k);
        removed.keep({std::make_shared<const Model>(*model), {RobotId()}, {state}, {}});
    }
    EXPECT_EQ(removed.size(), RemovedRobots::kRemovalsMost);
    const RemovedRobot last = removed.find({"box"}).value().front();
    EXPECT_EQ(last.state.q[0], static_cast<double>(RemovedRobots::kRemovalsMost + 19));
    EXPECT_TRUE(last.state.contacts.empty());
    removed.forget({"box"});
    EXPECT_EQ(removed.find({"box"}).value().front().state.q[0], last.state.q[0] - 1);
}

TEST(ModelVisuals, ManyAdditionsAndRemovalsLeaveNothingBehind) {
    World red = world_of("box", {1, 0, 0});
    red.instances.pop_back();  // the post would stay
    const auto first = compiled(world_of("old", {0, 0, 1})), addition = compiled(red);
    ModelVisuals visuals;
    visuals.begin(*first, world_of("old", {0, 0, 1}));
    for (int round = 0; round < 300; ++round) {
        const std::vector<CopyPlace> places{{"a" + std::to_string(round), {}}, {"b", {}}};
        const auto with = with_models(*first, *addition, places).value().model;
        visuals.add({*first, *with, *addition}, red, places);
        EXPECT_EQ(shown(make_scene(*with, visuals.of(*with)), *with, "b").rgb.x, 1);
        const auto less = without_robots(*with, {"b"}).value().model;
        visuals.change(*with, *less);
        EXPECT_EQ(visuals.of(*less).size(), 2u) << "a is still there";
        const auto without = without_robots(*less, {places[0].name}).value().model;
        visuals.change(*less, *without);
        EXPECT_EQ(visuals.of(*without).size(), 1u);
        EXPECT_LE(visuals.models(), 100u);
    }
    visuals.keep_only(*first);
    EXPECT_EQ(visuals.models(), 0u);
    EXPECT_EQ(shown(make_scene(*first, visuals.of(*first)), *first, "old").rgb.z, 1);
}

}  // namespace
}  // namespace roboss
