// What validate() finds in a World, however it was made.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "world/joint_type.h"
#include "world/world.h"

namespace roboss {
namespace {

/// Two links and a joint, all well.
World sound_world() {
    World world;
    ModelSpec model;
    model.name = "m";
    for (const char* name : {"a", "b"}) {
        LinkSpec link;
        link.name = name;
        link.where = {"w.sdf", 7};
        link.collisions.push_back({});
        link.collisions[0].name = "c";
        model.links.push_back(link);
    }
    JointSpec joint;
    joint.name = "j";
    joint.kind = JointSpecKind::kRevolute;
    joint.parent = "a";
    joint.child = "b";
    joint.axes.push_back({});
    joint.where = {"w.sdf", 9};
    model.joints.push_back(joint);
    world.prototypes.push_back(model);
    world.instances.push_back({"m", 0, {}, {"w.sdf", 3}});
    return world;
}

Diagnostics findings(const std::function<void(World&)>& spoil) {
    World world = sound_world();
    spoil(world);
    Diagnostics diagnostics;
    validate(world, diagnostics);
    return diagnostics;
}

/// The spoilt world has exactly this finding, on this line.
void expect_one(const std::string& code, Severity severity, int line,
                const std::function<void(World&)>& spoil) {
    const Diagnostics found = findings(spoil);
    ASSERT_EQ(found.items().size(), 1u) << code;
    EXPECT_EQ(found.items()[0].code, code);
    EXPECT_EQ(found.items()[0].severity, severity);
    EXPECT_EQ(found.items()[0].where.line, line);
    EXPECT_FALSE(found.items()[0].remedy.empty());
}

LinkSpec& link_a(World& world) {
    return world.prototypes[0].links[0];
}

JointSpec& joint(World& world) {
    return world.prototypes[0].joints[0];
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Validate, ASoundWorldHasNoFindings) {
    EXPECT_TRUE(findings([](World&) {}).items().empty());
}

TEST(Validate, MassesMustBeFiniteAndNotNegative) {
    for (const double mass : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
        expect_one("bad-mass", Severity::kError, 7, [&](World& w) { link_a(w).mass = mass; });
    }
}

TEST(Validate, ALinkWithoutMassIsLeftToTheCompiler) {
    EXPECT_TRUE(findings([](World& w) {
                    link_a(w).mass = 0;
                    link_a(w).inertia_C = Mat3::diagonal(0, 0, 0);
                })
                    .items()
                    .empty());
}

TEST(Validate, AStaticModelNeedsNoMass) {
    EXPECT_TRUE(findings([](World& w) {
                    w.prototypes[0].is_static = true;
                    link_a(w).mass = 0;
                    link_a(w).inertia_C = Mat3::diagonal(0, 0, 0);
                })
                    .items()
                    .empty());
}

TEST(Validate, InertiasShouldBePositiveDefinite) {
    expect_one("bad-inertia", Severity::kWarning, 7,
               [](World& w) { link_a(w).inertia_C = Mat3::diagonal(1, 0, 1); });
    expect_one("bad-inertia", Severity::kWarning, 7, [](World& w) {
        link_a(w).inertia_C = {{1, 2, 0}, {2, 1, 0}, {0, 0, 1}};
    });
    expect_one("not-finite", Severity::kError, 7, [](World& w) { link_a(w).inertia_C(1, 1) = kNan; });
}

TEST(Validate, InertiasShouldObeyTheTriangleInequality) {
    expect_one("unreal-inertia", Severity::kWarning, 7,
               [](World& w) { link_a(w).inertia_C = Mat3::diagonal(1, 1, 2.1); });
    EXPECT_TRUE(findings([](World& w) { link_a(w).inertia_C = Mat3::diagonal(1, 1, 2); }).items().empty())
        << "a thin plate";
    // The same unreal body in turned axes: only its principal moments tell.
    expect_one("unreal-inertia", Severity::kWarning, 7, [](World& w) {
        const Mat3 R = to_matrix(from_rpy(0.3, 0.4, 0.5));
        link_a(w).inertia_C = R * Mat3::diagonal(1, 1, 2.5) * transpose(R);
    });
}

TEST(Validate, JointsMustJoinTwoLinksOfTheModel) {
    expect_one("joint-to-nowhere", Severity::kError, 9, [](World& w) { joint(w).child = "z"; });
    expect_one("joint-to-nowhere", Severity::kError, 9, [](World& w) { joint(w).parent = "z"; });
    expect_one("joint-to-nowhere", Severity::kError, 9, [](World& w) { joint(w).child = "world"; });
    expect_one("joint-to-itself", Severity::kError, 9, [](World& w) { joint(w).child = "a"; });
    EXPECT_TRUE(findings([](World& w) { joint(w).parent = "world"; }).items().empty());
}

TEST(Validate, LimitsAndDynamicsMustMakeSense) {
    expect_one("bad-limit", Severity::kError, 9,
               [](World& w) { joint(w).axes[0].lower = 2, joint(w).axes[0].upper = 1; });
    expect_one("bad-dynamics", Severity::kError, 9, [](World& w) { joint(w).axes[0].damping = -1; });
    expect_one("bad-dynamics", Severity::kError, 9, [](World& w) { joint(w).axes[0].friction = kNan; });
    expect_one("bad-gain", Severity::kError, 9, [](World& w) { joint(w).axes[0].position_gain = -1; });
    expect_one("bad-gain", Severity::kError, 9, [](World& w) { joint(w).axes[0].velocity_gain = -1; });
}

TEST(Validate, AScrewMustHaveAPitch) {
    const auto make_screw = [](World& w, double pitch) {
        w.prototypes[0].joints[0].kind = JointSpecKind::kScrew;
        w.prototypes[0].joints[0].screw_pitch = pitch;
    };
    EXPECT_TRUE(findings([&](World& w) { make_screw(w, -0.1); }).items().empty());
    expect_one("bad-pitch", Severity::kError, 9, [&](World& w) { make_screw(w, 0.0); });
}

TEST(Validate, AxesOfAPlanarJointMustBeAtRightAngles) {
    const auto make_planar = [](World& w, const Vec3& x) {
        joint(w).kind = JointSpecKind::kPlanar;
        joint(w).axes.resize(3);
        joint(w).axes[0].xyz = x, joint(w).axes[1].xyz = {0, 1, 0};
    };
    EXPECT_TRUE(findings([&](World& w) { make_planar(w, {1, 0, 0}); }).items().empty());
    expect_one("bad-axes", Severity::kError, 9, [&](World& w) { make_planar(w, {-1, 0, 0}); });
    expect_one("bad-axes", Severity::kError, 9, [&](World& w) { make_planar(w, {0.8, 0.6, 0}); });
}

TEST(Validate, ShapesMustHaveASize) {
    expect_one("bad-size", Severity::kError, 0,
               [](World& w) { link_a(w).collisions[0].geometry.size.y = 0; });
    expect_one("bad-size", Severity::kError, 0,
               [](World& w) { link_a(w).collisions[0].geometry.kind = GeometryKind::kSphere; });
    expect_one("not-finite", Severity::kError, 0, [](World& w) { link_a(w).collisions[0].X_LS.p.x = kNan; });
    expect_one("bad-surface", Severity::kError, 0,
               [](World& w) { link_a(w).collisions[0].surface.mu = -0.1; });
    expect_one("bad-surface", Severity::kWarning, 0,
               [](World& w) { link_a(w).collisions[0].surface.restitution = 1.1; });
}

TEST(Validate, NamesMustBeUnique) {
    expect_one("duplicate-name", Severity::kError, 3,
               [](World& w) { w.instances.push_back(w.instances[0]); });
    expect_one("duplicate-name", Severity::kError, 9, [](World& w) { joint(w).name = "a"; });
    EXPECT_EQ(findings([](World& w) { w.prototypes[0].links[1].name = "a"; }).items()[0].code,
              "duplicate-name");
}

TEST(Validate, PosesGravityAndStepMustBeFinite) {
    expect_one("not-finite", Severity::kError, 3, [](World& w) { w.instances[0].X_WM.p.z = kNan; });
    expect_one("not-finite", Severity::kError, 9, [](World& w) { joint(w).X_MJ.q.w = kNan; });
    expect_one("not-finite", Severity::kError, 0, [](World& w) { w.gravity.x = kNan; });
    expect_one("bad-step", Severity::kError, 0, [](World& w) { w.dt_s = 0; });
}

}  // namespace
}  // namespace roboss
