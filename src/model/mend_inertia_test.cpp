// Links without mass or inertia, as URDF's dummy frames and casters have them.
#include <gtest/gtest.h>

#include <support/compiling.h>

namespace roboss::test {
namespace {

/// A link `a` and what hangs on it by a joint of this kind.
ModelSpec pair_of(JointSpecKind kind, double mass, const Mat3& inertia) {
    ModelSpec model = row_of_three();
    model.links.resize(2);
    model.links[1].mass = mass;
    model.links[1].inertia_C = inertia;
    model.joints.push_back(joint(kind, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    return model;
}

TEST(MendInertia, AMasslessLinkWeldedToAnotherIsPartOfIt) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kFixed, 0, {}));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(c.diagnostics.items().empty());
    EXPECT_EQ(c.type().mass, row_of_three().links[0].mass);
}

TEST(MendInertia, AMasslessLinkThatMovesGetsAGramWithAWarning) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 0, {}));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(has(c.diagnostics, "massless"));
    EXPECT_FALSE(c.diagnostics.has_errors());
    EXPECT_NEAR(c.type().mass, row_of_three().links[0].mass + 1e-3, 1e-12);
    EXPECT_NEAR(c.type().bodies[1].inertia_C(0, 0), 4e-8, 1e-15);
}

/// A heavy link, then `links` without mass on joints of these kinds and axes, then a heavy one.
ModelSpec chain(const std::vector<std::pair<JointSpecKind, Vec3>>& joints, double last_mass) {
    ModelSpec model = row_of_three();
    LinkSpec proto = model.links[0];
    model.links.resize(1);
    for (std::size_t k = 0; k < joints.size(); ++k) {
        LinkSpec next = proto;
        next.name = "l" + std::to_string(k);
        const bool last = k + 1 == joints.size();
        next.mass = last ? last_mass : 0;
        next.inertia_C = last && last_mass > 0 ? Mat3::identity() : Mat3{};
        next.X_ML = at_x(0.5);
        next.collisions.clear();
        const std::string parent = k == 0 ? model.links[0].name : model.links.back().name;
        model.joints.push_back(
            joint(joints[k].first, "j" + std::to_string(k), parent, next.name, at_x(0.5), joints[k].second));
        model.links.push_back(next);
    }
    return model;
}

TEST(MendInertia, MasslessLinksThatMoveAsWhatTheyCarryGetNothing) {
    constexpr auto kSlide = JointSpecKind::kPrismatic, kHinge = JointSpecKind::kRevolute;
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    for (const auto& joints :
         {std::vector<std::pair<JointSpecKind, Vec3>>{{kSlide, x}, {kSlide, y}, {kHinge, z}},
          std::vector<std::pair<JointSpecKind, Vec3>>{{kHinge, z}, {kHinge, y}}}) {
        const Compiled c = compile_one(chain(joints, 5));
        ASSERT_NE(c.model, nullptr);
        EXPECT_TRUE(c.diagnostics.items().empty());
        EXPECT_EQ(c.type().mass, row_of_three().links[0].mass + 5);
        for (const Dof& dof : c.type().dofs)
            EXPECT_TRUE(dof.inverse_inertia > 0 && dof.inverse_inertia < 1e3) << dof.inverse_inertia;
    }
}

TEST(MendInertia, MasslessLinksThatCouldMoveByThemselvesGetAGram) {
    constexpr auto kSlide = JointSpecKind::kPrismatic, kHinge = JointSpecKind::kRevolute;
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    using Joints = std::vector<std::pair<JointSpecKind, Vec3>>;
    // Two slides or hinges along one line; three axes through a point, of which two fall into one line when
    // the middle one has turned by 90 degrees.
    for (const Joints& joints : {Joints{{kSlide, x}, {kSlide, x}}, Joints{{kHinge, z}, {kHinge, z}},
                                 Joints{{kHinge, z}, {kHinge, x}, {kHinge, y}}}) {
        const Compiled c = compile_one(chain(joints, 5));
        ASSERT_NE(c.model, nullptr);
        EXPECT_TRUE(has(c.diagnostics, "massless"));
    }
    const Compiled leaf = compile_one(chain({{kSlide, x}, {kSlide, y}}, 0));
    ASSERT_NE(leaf.model, nullptr);
    EXPECT_NEAR(leaf.type().mass, row_of_three().links[0].mass + 1e-3, 1e-12)
        << "the last one carries the rest";
}

TEST(MendInertia, AnInertiaOfZeroIsThatOfASmallBallAtLeast) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 2, {}));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(has(c.diagnostics, "small-inertia"));
    EXPECT_NEAR(c.type().bodies[1].inertia_C(2, 2), 0.4 * 2 * 1e-4, 1e-12);
}

TEST(MendInertia, ARodGetsAThousandthAboutItsAxis) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 0.1, Mat3::diagonal(1, 1, 0)));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(has(c.diagnostics, "small-inertia"));
    EXPECT_NEAR(c.type().bodies[1].inertia_C(2, 2), 1e-3, 1e-12);
}

TEST(MendInertia, AMomentThatIsLostInRoundingIsNone) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 1, Mat3::diagonal(1e-17, 1, 1)));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(has(c.diagnostics, "small-inertia"));
    EXPECT_NEAR(c.type().bodies[1].inertia_C(0, 0), 1e-3, 1e-12);
    const Compiled thin = compile_one(pair_of(JointSpecKind::kRevolute, 1, Mat3::diagonal(1e-10, 1, 1)));
    ASSERT_NE(thin.model, nullptr);
    EXPECT_FALSE(has(thin.diagnostics, "small-inertia"));
    EXPECT_EQ(thin.type().bodies[1].inertia_C(0, 0), 1e-10);
}

TEST(MendInertia, ASoundInertiaStaysAsItIs) {
    const Mat3 inertia = Mat3::diagonal(1e-9, 1e-9, 1e-9);
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 1e-6, inertia));
    ASSERT_NE(c.model, nullptr);
    EXPECT_TRUE(c.diagnostics.items().empty());
    EXPECT_EQ(c.type().bodies[1].inertia_C(2, 2), 1e-9);
}

TEST(MendInertia, ANegativeMomentBecomesPositive) {
    const Compiled c = compile_one(pair_of(JointSpecKind::kRevolute, 1, {{1, 2, 0}, {2, 1, 0}, {0, 0, 1}}));
    ASSERT_NE(c.model, nullptr);
    const Mat3& m = c.type().bodies[1].inertia_C;
    EXPECT_GT(m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0), 0);
}

}  // namespace
}  // namespace roboss::test
