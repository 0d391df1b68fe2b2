// Warnings about robots that start in each other or in the scenery.
#include <gtest/gtest.h>

#include <support/compiling.h>

#include "physics/start_overlaps.h"

namespace roboss::test {
namespace {

struct Start {
    World world = empty_world(1e-3);
    std::shared_ptr<const Model> model;
    Diagnostics diagnostics;

    Start() { place(world, scenery(collision(GeometryKind::kPlane, surface(1))), "ground"); }
    std::vector<StartOverlap> find() {
        model = compile(world, {}, diagnostics);
        std::vector<RobotState> states;
        for (std::size_t i = 0; i < model->robots.size(); ++i)
            states.push_back(initial_state(*model, RobotId(i)));
        report_overlaps(*model, &world, diagnostics);
        return find_overlaps(*model, states);
    }
};

const ModelSpec kBox = solid_box(1, {0.5, 0.5, 0.5}, surface(1));

TEST(StartOverlaps, ARobotInTheGroundIsToldWithLinkAndDepth) {
    Start start;
    place(start.world, kBox, "box", {{0, 0, -0.05}, {}});
    start.world.instances.back().where = {"box.sdf", 12};
    const auto found = start.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].depth, 0.3, 1e-9);
    EXPECT_EQ(found[0].in, "ground");
    EXPECT_TRUE(found[0].is_scenery);
    EXPECT_EQ(start.model->type_of(found[0].robot).links[found[0].link.index()].name, "box");
    ASSERT_EQ(start.diagnostics.count(Severity::kWarning), 1u);
    const Diagnostic& told = start.diagnostics.items().back();
    EXPECT_EQ(told.code, "start-overlap");
    EXPECT_EQ(told.where.line, 12);
    EXPECT_NE(told.message.find("'box' lies 0.3 m deep"), std::string::npos) << told.message;
    EXPECT_NE(told.remedy.find("--on-ground"), std::string::npos);
}

TEST(StartOverlaps, OnlyDeepOnesAreTold) {
    for (const auto& [depth, told] : {std::pair{0.0, false}, {0.009, false}, {0.011, true}}) {
        Start start;
        place(start.world, kBox, "box", {{0, 0, 0.25 - depth}, {}});
        EXPECT_EQ(start.find().size(), told ? 1u : 0u) << depth;
    }
    for (const auto& [depth, told] : {std::pair{0.003, false}, {0.005, true}}) {
        Start start;  // a tenth of a ball of 4 cm
        place(start.world, solid_sphere(1, 0.02, surface(1)), "ball", {{0, 0, 0.02 - depth}, {}});
        EXPECT_EQ(start.find().size(), told ? 1u : 0u) << depth;
    }
}

TEST(StartOverlaps, RobotsInEachOtherAreTold) {
    Start start;
    place(start.world, kBox, "a", {{0, 0, 0.25}, {}});
    place(start.world, kBox, "b", {{0.4, 0, 0.25}, {}});
    place(start.world, kBox, "c", {{5, 0, 0.25}, {}});
    const auto found = start.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].depth, 0.1, 1e-9);
    EXPECT_EQ(start.model->robots[found[0].robot.index()].name, "a");
    EXPECT_EQ(found[0].in, "b");
    EXPECT_FALSE(found[0].is_scenery);
}

TEST(StartOverlaps, ManyAlikeAreOneLine) {
    Start start;
    for (int i = 0; i < 50; ++i)
        place(start.world, kBox, "box_" + std::to_string(i), {{1.0 * i, 0, i == 7 ? 0.1 : 0.2}, {}});
    const auto found = start.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].robots, 50u);
    EXPECT_EQ(start.model->robots[found[0].robot.index()].name, "box_7") << "the deepest is named";
    EXPECT_NE(start.diagnostics.items().back().message.find("49 more robots"), std::string::npos);
}

TEST(StartOverlaps, LinksOfOneRobotCountWhereTheyTouchEachOther) {
    ModelSpec chain = row_of_three();  // boxes of 0.2 m
    chain.links[1].X_ML.p.x = 0.5, chain.links[2].X_ML.p.x = 0.15;
    chain.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", at_x(0.2), {0, 0, 1}));
    chain.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(0.3), {0, 0, 1}));
    for (const bool self_collide : {false, true}) {
        Start start;
        chain.self_collide = self_collide;
        place(start.world, chain, "chain", {{0, 0, 3}, {}});
        const auto found = start.find();
        ASSERT_EQ(found.size(), self_collide ? 1u : 0u);
        if (!self_collide) continue;
        EXPECT_EQ(found[0].in, "chain");
        EXPECT_NEAR(found[0].depth, 0.05, 1e-9);
    }
}

TEST(StartOverlaps, OnlyThoseThatCameAreLookedAt) {
    Start start;
    place(start.world, kBox, "old", {{0, 0, 0}, {}});
    place(start.world, kBox, "new", {{0.3, 0, 0.25}, {}});
    start.find();
    std::vector<RobotState> states;
    for (const std::size_t i : {0u, 1u}) states.push_back(initial_state(*start.model, RobotId(i)));
    const auto found = find_overlaps(*start.model, states, 1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].in, "new");
    EXPECT_TRUE(find_overlaps(*start.model, states, 2).empty());
}

TEST(StartOverlaps, WhatIsFixedToTheWorldMayLieInIt) {
    Start start;
    ModelSpec post = kBox;
    post.joints.push_back(joint(JointSpecKind::kFixed, "weld", "world", "box", {}));
    place(start.world, post, "post", {{0, 0, 0}, {}});
    EXPECT_TRUE(start.find().empty());
}

}  // namespace
}  // namespace roboss::test
