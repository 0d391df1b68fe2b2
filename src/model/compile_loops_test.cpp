// compile(): which joints are cut, loops through the world, starts that close, gearboxes and mimic joints.
#include <gtest/gtest.h>

#include <support/compiling.h>
#include <support/mechanisms.h>

namespace roboss::test {
namespace {

TEST(CompileLoops, JointThatClosesALoopIsKeptBesideTheTree) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ac", "a", "c", at_x(1.0), {0, 0, 1}));
    m.joints.back().where = {"loop.sdf", 42};
    const Compiled c = compile_one(m);
    ASSERT_NE(c.model, nullptr);
    ASSERT_TRUE(has(c.diagnostics, "kinematic-loop"));
    EXPECT_EQ(c.diagnostics.items()[0].where.line, 42);
    EXPECT_EQ(c.diagnostics.items()[0].severity, Severity::kNote);
    EXPECT_NE(c.diagnostics.items()[0].message.find("'ac'"), std::string::npos);
    const RobotType& t = c.type();
    EXPECT_EQ(t.bodies.size(), 3u);
    ASSERT_EQ(t.loops.size(), 1u);
    const Joint& joint = t.joints[t.find_joint("ac")->index()];
    EXPECT_EQ(joint.loop, 0);
    EXPECT_EQ(joint.nv, 1);
    EXPECT_EQ(t.motor_count(), 3u) << "its axis has a motor too";
    EXPECT_EQ(t.motor_index(joint, 0), 2u);
    EXPECT_EQ(t.loops[0].body_a, 0);
    EXPECT_EQ(t.loops[0].body_b, 2);
    EXPECT_NEAR(t.loops[0].X_BJ.p.x, -0.5, 1e-15) << "body c stands at its own hinge";
}

/// Four links in a ring, hinges about z at the corners of a square.
ModelSpec ring() {
    ModelSpec m;
    m.name = "ring";
    m.canonical_link = "link_0";
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (int i = 0; i < 4; ++i)
        m.links.push_back(link("link_" + std::to_string(i), 1.0, box_inertia(1.0, {1, 0.1, 0.1}),
                               {(corners[i] + corners[(i + 1) % 4]) * 0.5, {}}));
    for (int i = 0; i < 4; ++i)
        m.joints.push_back(joint(JointSpecKind::kRevolute, "hinge_" + std::to_string(i),
                                 "link_" + std::to_string(i), "link_" + std::to_string((i + 1) % 4),
                                 {corners[(i + 1) % 4], {}}, {0, 0, 1}));
    return m;
}

std::string cut_joint(const Compiled& c) {
    return c.type().loops.size() == 1 ? c.type().joints[c.type().loops[0].joint.index()].name
                                      : "none or many";
}

TEST(CompileLoops, TheJointWithLeastToDoIsCut) {
    ModelSpec m = ring();
    EXPECT_EQ(cut_joint(compile_one(m)), "hinge_3") << "of equals the last";
    m.joints[3].axes[0].damping = 0.1;
    EXPECT_EQ(cut_joint(compile_one(m)), "hinge_2");
    m.joints[2].axes[0].lower = -1;
    m.joints[1].kind = JointSpecKind::kFixed;
    m.joints[0].axes[0].friction = 1;
    EXPECT_EQ(cut_joint(compile_one(m)), "hinge_3") << "damping before limits, friction or a weld";
}

TEST(CompileLoops, LoopThroughTheWorldIsOneRobot) {
    ModelSpec m = ring();
    m.joints[0].parent = "world", m.joints[3].child = "link_0";
    m.joints[0].child = "link_1", m.joints[3].parent = "world";
    m.joints[1].axes[0].damping = m.joints[0].axes[0].damping = m.joints[3].axes[0].damping = 1;
    m.joints.push_back(
        joint(JointSpecKind::kRevolute, "back", "link_3", "link_0", {{0, 1, 0}, {}}, {0, 0, 1}));
    m.joints.back().axes[0].damping = 1;
    const Compiled c = compile_one(m);
    ASSERT_EQ(c.model->robots.size(), 1u) << "although the tree joins its two arms at the world only";
    EXPECT_EQ(cut_joint(c), "hinge_2");
    EXPECT_FALSE(c.type().free_base);
}

TEST(CompileLoops, JointBetweenWeldedLinksIsReported) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kFixed, "ab", "a", "b", at_x(1)));
    m.joints.push_back(joint(JointSpecKind::kFixed, "bc", "b", "c", at_x(2)));
    m.joints.push_back(joint(JointSpecKind::kFixed, "ca", "c", "a", at_x(2)));
    EXPECT_TRUE(compile_one(m).diagnostics.items().empty()) << "one weld too many holds as well";
    m.joints.push_back(joint(JointSpecKind::kRevolute, "stuck", "a", "c", at_x(0.5), {0, 0, 1}));
    const Compiled c = compile_one(m);
    EXPECT_TRUE(has(c.diagnostics, "immobile-joint"));
    EXPECT_EQ(c.type().joints[c.type().find_joint("stuck")->index()].nv, 0);
}

TEST(CompileLoops, RingStartsClosedAtTheAngleGiven) {
    ModelSpec m = ring();
    m.joints[0].axes[0].initial_position = 0.4;
    const Compiled c = compile_one(m);
    ASSERT_NE(c.model, nullptr);
    const std::vector<double>& q = c.type().initial_q;
    ASSERT_EQ(q.size(), 3u);
    for (const double angle : q) EXPECT_NEAR(std::fabs(angle), 0.4, 1e-12) << "a square becomes a rhombus";
    EXPECT_EQ(q[0], 0.4);
    EXPECT_FALSE(has(c.diagnostics, "start-moved"));
}

TEST(CompileLoops, StartThatCannotCloseMovesOrIsAnError) {
    ModelSpec m = ring();
    for (int i = 0; i < 3; ++i) m.joints[static_cast<std::size_t>(i)].axes[0].initial_position = 0.3;
    const Compiled moved = compile_one(m);
    ASSERT_NE(moved.model, nullptr);
    EXPECT_TRUE(has(moved.diagnostics, "start-moved"));
    m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kPrismatic, "ab", "a", "b", at_x(0.5), {1, 0, 0}));
    m.joints.push_back(joint(JointSpecKind::kContinuous, "bc", "b", "c", at_x(1.5), {1, 0, 0}));
    m.joints[0].axes[0].mimic = MimicSpec{"bc", 0, 0.0, 0.2, 0, {}};
    m.joints[1].axes[0].mimic = MimicSpec{"ab", 0, 0.0, 0.1, 0, {}};
    const Compiled both = compile_one(m);
    EXPECT_NE(both.model, nullptr) << "two constants are no contradiction";
    m.joints[1].axes[0].mimic = MimicSpec{"ab", 0, 1.0, 0.1, 0, {}};
    m.joints[0].axes[0].mimic = MimicSpec{"bc", 0, 1.0, 0.2, 0, {}};
    const Compiled none = compile_one(m);
    EXPECT_EQ(none.model, nullptr);
    EXPECT_TRUE(has(none.diagnostics, "open-loop"));
}

TEST(CompileLoops, MimicOfWhatIsNotThereIsAnError) {
    ModelSpec m = ring();
    m.joints[0].axes[0].mimic = MimicSpec{"nobody", 0, 1, 0, 0, {}};
    EXPECT_TRUE(has(compile_one(m).diagnostics, "mimic-leader"));
    m.joints[0].axes[0].mimic = MimicSpec{"hinge_1", 1, 1, 0, 0, {}};
    EXPECT_TRUE(has(compile_one(m).diagnostics, "mimic-leader")) << "a hinge has no second axis";
    m.joints[0].axes[0].mimic = MimicSpec{"hinge_0", 0, 1, 0, 0, {}};
    EXPECT_TRUE(has(compile_one(m).diagnostics, "mimic-leader")) << "itself";
    ModelSpec apart = row_of_three();
    apart.joints.push_back(joint(JointSpecKind::kRevolute, "wa", "world", "a", {}, {0, 0, 1}));
    apart.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    apart.joints[1].axes[0].mimic = MimicSpec{"wa", 0, 1, 0, 0, {}};
    EXPECT_TRUE(has(compile_one(apart).diagnostics, "coupling-apart"));
}

TEST(CompileLoops, MimicMakesOneRobotOfPartsThatStandOnTheWorld) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "wa", "world", "a", {}, {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "wb", "world", "b", at_x(1), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "wc", "world", "c", at_x(2), {0, 0, 1}));
    m.joints[2].axes[0].mimic = MimicSpec{"wa", 0, 2, 0, 0, {}};
    const Compiled c = compile_one(m);
    ASSERT_NE(c.model, nullptr);
    ASSERT_EQ(c.model->robots.size(), 2u) << "b stays a robot of its own";
    const RobotType& tied = c.type();
    EXPECT_EQ(tied.links.size(), 2u);
    ASSERT_EQ(tied.couplings.size(), 1u);
    EXPECT_EQ(tied.couplings[0].multiplier, 2);
    EXPECT_FALSE(tied.free_base);
}

TEST(CompileLoops, GearboxNeedsHingesOnItsReference) {
    ModelSpec m = geared_wheels(2);
    const Compiled good = compile_one(m);
    ASSERT_EQ(good.type().couplings.size(), 1u);
    EXPECT_EQ(good.type().couplings[0].multiplier, -2);
    m.joints[0].axes[0].xyz = {0, 0, -1};
    EXPECT_EQ(compile_one(m).type().couplings[0].multiplier, 2) << "the hinge counts the other way";
    m.joints[0].axes[0].xyz = {0, 1, 0};
    EXPECT_TRUE(has(compile_one(m).diagnostics, "gearbox-axis"));
    m.joints.back().gearbox_reference = "small";
    EXPECT_TRUE(has(compile_one(m).diagnostics, "gearbox-hinge"));
}

TEST(CompileLoops, WhatAGearboxCannotUseIsReported) {
    const auto reported = [](auto change) {
        ModelSpec m = geared_wheels(2);
        change(m.joints.back().axes[1]);
        return has(compile_one(m).diagnostics, "gearbox-axis");
    };
    EXPECT_FALSE(reported([](AxisSpec&) {}));
    EXPECT_FALSE(reported([](AxisSpec& axis) { axis.max_effort = 1e16; })) << "no bound";
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.damping = 1; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.lower = -1; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.max_effort = 3; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.max_velocity = 3; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.initial_position = 0.1; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.position_gain = 5; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.velocity_gain = 5; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.armature = 0.1; }));
    EXPECT_TRUE(reported([](AxisSpec& axis) { axis.mimic = MimicSpec{}; }));
}

}  // namespace
}  // namespace roboss::test
