// compile(): trees however the joints point, welded links, several parts, fixed bases, scenery, reach,
// mobility.
#include <gtest/gtest.h>

#include <support/compiling.h>
#include <support/mechanisms.h>
#include <support/robots.h>

#include "model/robot_state.h"

namespace roboss::test {
namespace {

TEST(Compile, TreeOfHingesHasOneBodyALink) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    const Compiled c = compile_one(m);
    const RobotType& t = c.type();
    EXPECT_TRUE(c.diagnostics.items().empty());
    EXPECT_TRUE(t.free_base);
    ASSERT_EQ(t.bodies.size(), 3u);
    EXPECT_EQ(t.nv, 8);
    EXPECT_EQ(t.nq, 9);
    EXPECT_EQ(t.bodies[2].parent, 1);
    EXPECT_EQ(t.bodies[2].X_PJ.p, (Vec3{1, 0, 0})) << "joint to joint";
    EXPECT_EQ(t.bodies[2].p_BC, (Vec3{0.5, 0, 0}));
    EXPECT_EQ(t.dof_parent, (std::vector<int>{-1, 0, 1, 2, 3, 4, 5, 6}));
    EXPECT_DOUBLE_EQ(t.mass, 6.0);
}

/// "c" hangs on two parents; "b" is reached backwards, so its axis turns about.
TEST(Compile, JointThatPointsTowardsTheRootIsReversed) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ac", "a", "c", at_x(1.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.2), {0, 1, 0}));
    const Compiled c = compile_one(m);
    const RobotType& t = c.type();
    ASSERT_EQ(c.model->robots.size(), 1u);
    ASSERT_EQ(t.bodies.size(), 3u);
    const Link& b = t.links[t.find_link("b")->index()];
    EXPECT_EQ(b.body, 2);
    EXPECT_EQ(t.bodies[2].parent, 1);
    EXPECT_EQ(t.bodies[2].axis_J, (Vec3{0, -1, 0}));
    EXPECT_EQ(t.bodies[1].axis_J, (Vec3{0, 0, 1}));
}

TEST(Compile, LinksWeldedByFixedJointsAreOneBody) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kFixed, "ab", "a", "b", at_x(1)));
    m.joints.push_back(joint(JointSpecKind::kFixed, "bc", "b", "c", at_x(2)));
    const Compiled c = compile_one(m);
    const RobotType& t = c.type();
    ASSERT_EQ(t.bodies.size(), 1u);
    EXPECT_EQ(t.links.size(), 3u);
    EXPECT_EQ(t.shapes.size(), 3u);
    EXPECT_DOUBLE_EQ(t.bodies[0].mass, 6.0);
    const double centre = (0.0 * 1 + 1.0 * 2 + 2.0 * 3) / 6;
    EXPECT_NEAR(t.bodies[0].p_BC.x, centre, 1e-15);
    const double own = 6.0 / 12 * (0.04 + 0.04);
    const double expected =
        own + 1 * centre * centre + 2 * (1 - centre) * (1 - centre) + 3 * (2 - centre) * (2 - centre);
    EXPECT_NEAR(t.bodies[0].inertia_C(2, 2), expected, 1e-14);
    EXPECT_NEAR(t.bodies[0].inertia_C(0, 0), own, 1e-14);
    EXPECT_EQ(t.links[2].X_BL.p, (Vec3{2, 0, 0}));
}

bool same(const Mat3& a, const Mat3& b) {
    return a.r0 == b.r0 && a.r1 == b.r1 && a.r2 == b.r2;
}

TEST(Compile, FramesThatOnlyRoundingTurnsCoincide) {
    for (int i = 1; i < 20; ++i) {
        ModelSpec m = row_of_three();
        const Pose turned{{0.5, 0, 0}, from_rpy(0.3 * i, 0.7, -0.2 * i)};
        m.links[1].X_ML = turned;
        m.links[1].inertia_C = Mat3::diagonal(1, 2, 2.5);
        m.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", turned, {0, 0, 1}));
        const Compiled c = compile_one(m);
        const RobotType& t = c.type();
        EXPECT_TRUE(same(t.links[t.find_link("b")->index()].X_BL.R, Mat3::identity()));
        EXPECT_TRUE(same(t.bodies[1].inertia_C, Mat3::diagonal(1, 2, 2.5)));
        EXPECT_FALSE(same(t.bodies[1].X_PJ.R, Mat3::identity())) << "this one is turned";
    }
}

TEST(Compile, JointToTheWorldFixesTheBase) {
    const Compiled c = compile_one(arm(), {{1, 2, 3}, from_rpy(0, 0, 1)});
    const RobotType& t = c.type();
    EXPECT_FALSE(t.free_base);
    EXPECT_EQ(t.nv, 4);
    EXPECT_EQ(t.nq, 11);
    EXPECT_EQ(t.bodies[0].parent, -1);
    const RobotState state = initial_state(*c.model, RobotId(std::size_t{0}));
    EXPECT_EQ(base_pose(state).p, (Vec3{1, 2, 3}));
}

TEST(Compile, LinkWeldedToTheWorldBelongsToTheBase) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kFixed, "wa", "world", "a", {}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kPrismatic, "bc", "b", "c", at_x(1.5), {1, 0, 0}));
    const Compiled c = compile_one(m);
    const RobotType& t = c.type();
    ASSERT_EQ(t.bodies.size(), 2u);
    EXPECT_EQ(t.links[t.find_link("a")->index()].body, -1);
    EXPECT_DOUBLE_EQ(t.mass, 5.0) << "what is welded to the world does not move";
    EXPECT_EQ(t.joints[t.find_joint("wa")->index()].nv, 0);
    EXPECT_EQ(t.joints[t.find_joint("bc")->index()].v_index, 1);
}

TEST(Compile, UnconnectedPartsAreRobotsOfOneFamily) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    const Compiled c = compile_one(m, {{0, 0, 5}, {}});
    ASSERT_EQ(c.model->robots.size(), 2u);
    EXPECT_TRUE(has(c.diagnostics, "unconnected-parts"));
    EXPECT_EQ(c.model->robots[0].name, "row");
    EXPECT_EQ(c.model->robots[1].name, "row::b");
    EXPECT_EQ(c.model->robots[0].family, c.model->robots[1].family);
    const RobotState b = initial_state(*c.model, RobotId(std::size_t{1}));
    EXPECT_EQ(base_pose(b).p, (Vec3{1, 0, 5})) << "the part starts where its root link was";
}

TEST(Compile, UniversalJointIsTwoHinges) {
    ModelSpec m = row_of_three();
    m.links.pop_back();
    m.joints.push_back(joint(JointSpecKind::kUniversal, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    m.joints[0].axes.push_back({});
    m.joints[0].axes[1].xyz = {0, 1, 0};
    m.joints[0].axes[1].upper = 0.5;
    const Compiled c = compile_one(m);
    const RobotType& t = c.type();
    ASSERT_EQ(t.bodies.size(), 3u);
    EXPECT_EQ(t.bodies[1].axis_J, (Vec3{0, 0, 1}));
    EXPECT_EQ(t.bodies[2].axis_J, (Vec3{0, 1, 0}));
    EXPECT_EQ(t.bodies[2].X_PJ.p, (Vec3{0, 0, 0}));
    EXPECT_DOUBLE_EQ(t.bodies[1].mass, 0.0);
    EXPECT_EQ(t.joints[0].nv, 2);
    EXPECT_DOUBLE_EQ(t.dofs[1].upper, 0.5);
    EXPECT_GT(t.dofs[0].inverse_inertia, 0);
}

TEST(Compile, StaticModelsBecomeScenery) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, scenery(box_shape({1, 2, 3}, surface(0.3), {{0, 0, 1}, {}})), "wall", {{5, 0, 0}, {}});
    place(world, solid_sphere(1, 0.1, surface(0.2)), "ball");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    ASSERT_EQ(model->robots.size(), 1u);
    ASSERT_EQ(model->statics.size(), 2u);
    EXPECT_EQ(model->statics[1].X_WS.p, (Vec3{5, 0, 1}));
    EXPECT_EQ(model->statics[1].shape.half, (Vec3{0.5, 1, 1.5}));
    EXPECT_EQ(model->statics[1].name, "wall::link::collision");
    EXPECT_EQ(model->statics[1].material.mu, 0.3);
}

TEST(Compile, EqualRobotsShareOneType) {
    World world = empty_world(1e-3);
    place(world, car(), "car_0");
    world.instances.push_back({"car_1", 0, {{3, 0, 0}, {}}, {}});
    place(world, car(), "car_2");  // another prototype with the same numbers
    CarOptions slippery;
    slippery.mu = 0.1;
    place(world, car(slippery), "car_3");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    EXPECT_EQ(model->types.size(), 2u);
    EXPECT_EQ(model->robots[2].type, model->robots[0].type);
    EXPECT_NE(model->robots[3].type, model->robots[0].type);
}

TEST(Compile, ReachHoldsEveryShapeInEveryPose) {
    const Compiled c = compile_one(car());
    const double wheel = std::hypot(0.15, 0.13) + std::hypot(0.05, 0.02);
    const double chassis = 0.02 + 0.5 * std::sqrt(0.4 * 0.4 + 0.2 * 0.2 + 0.1 * 0.1);
    EXPECT_NEAR(c.type().reach, std::fmax(wheel, chassis), 1e-12);

    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kPrismatic, "ab", "a", "b", at_x(1), {1, 0, 0}));
    m.joints.back().axes[0].lower = -2, m.joints.back().axes[0].upper = 0.5;
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    EXPECT_NEAR(compile_one(m).type().reach, 1 + 2 + 0.5 + 0.5 + 0.1 * std::sqrt(3), 1e-12);
}

TEST(Compile, MobilityIsTheInverseMassWhereNothingElseMoves) {
    const Compiled box = compile_one(solid_box(2.0, {0.1, 0.2, 0.3}, surface(0.5)));
    EXPECT_NEAR(box.type().bodies[0].inverse_mass_linear, 0.5, 1e-12);
    const Mat3 I = box_inertia(2.0, {0.1, 0.2, 0.3});
    EXPECT_NEAR(box.type().bodies[0].inverse_inertia_angular, (1 / I(0, 0) + 1 / I(1, 1) + 1 / I(2, 2)) / 3,
                1e-9);

    ModelSpec m = pendulum(2.0, 0.8);
    m.joints[0].axes[0].armature = 0.3;
    const Compiled hinge = compile_one(m);
    const double inertia = m.links[0].inertia_C(1, 1) + 2.0 * 0.4 * 0.4 + 0.3;
    EXPECT_NEAR(hinge.type().dofs[0].inverse_inertia, 1 / inertia, 1e-12);
}

TEST(Compile, ABodyOnAHubAtItsCentreIsMobileWhereItsSurfaceIs) {
    ModelSpec m = solid_box(1.0, {1, 0.05, 0.01}, surface(0.5));
    m.joints.push_back(joint(JointSpecKind::kContinuous, "hub", "world", "box", {}, {0, 0, 1}));
    const Mat3 I = box_inertia(1.0, {1, 0.05, 0.01});
    const double gyration2 = 0.5 * (I(0, 0) + I(1, 1) + I(2, 2));
    EXPECT_NEAR(compile_one(m).type().bodies[0].inverse_mass_linear, gyration2 / I(2, 2) / 3, 1e-12);
}

/// Spheres a meter apart, each joined to the one before.
ModelSpec chain(int links, JointSpecKind kind) {
    ModelSpec m;
    m.name = "chain";
    m.canonical_link = "0";
    for (int i = 0; i < links; ++i) {
        m.links.push_back(link(std::to_string(i), 1.0, box_inertia(1.0, {0.2, 0.2, 0.2}), at_x(i)));
        if (i > 0)
            m.joints.push_back(joint(kind, "j" + std::to_string(i), std::to_string(i - 1), std::to_string(i),
                                     at_x(i - 0.5), {0, 1, 0}));
    }
    return m;
}

TEST(Compile, AChainOfManyWeldsIsOneBody) {
    const Compiled c = compile_one(chain(50'000, JointSpecKind::kFixed));
    ASSERT_EQ(c.model->robots.size(), 1u);
    EXPECT_EQ(c.type().bodies.size(), 1u);
    EXPECT_DOUBLE_EQ(c.type().mass, 50'000.0);
}

TEST(Compile, AChainThatIsTooLongToBeSteppedIsLeftOut) {
    const Compiled c = compile_one(chain(9000, JointSpecKind::kRevolute));
    EXPECT_TRUE(has(c.diagnostics, "chain-too-long"));
    EXPECT_TRUE(c.model == nullptr || c.model->robots.empty());
}

/// Only the joints near a link let it give way; what a chain of any length moves as one body hardly counts.
TEST(Compile, MobilityAtTheEndOfALongChainDoesNotDependOnItsLength) {
    const Compiled shorter = compile_one(chain(200, JointSpecKind::kRevolute)),
                   longer = compile_one(chain(600, JointSpecKind::kRevolute));
    const double a = shorter.type().bodies[190].inverse_mass_linear,
                 b = longer.type().bodies[590].inverse_mass_linear;
    EXPECT_NEAR(a, b, 0.05 * a);
    EXPECT_GT(b, 0.1);
}

TEST(Compile, LimitsOfTheAxisReachTheDof) {
    ModelSpec m = pendulum();
    AxisSpec& axis = m.joints[0].axes[0];
    axis.lower = -0.5, axis.max_effort = 7, axis.max_velocity = 3, axis.initial_position = 0.25;
    const Compiled c = compile_one(m);
    const Dof& dof = c.type().dofs[0];
    EXPECT_EQ(dof.lower, -0.5);
    EXPECT_TRUE(std::isinf(dof.upper)) << "1e16 means none";
    EXPECT_EQ(dof.max_effort, 7);
    EXPECT_EQ(dof.max_velocity, 3);
    EXPECT_EQ(initial_state(*c.model, RobotId(std::size_t{0})).q[7], 0.25);
    m.joints[0].kind = JointSpecKind::kContinuous;
    EXPECT_TRUE(std::isinf(compile_one(m).type().dofs[0].lower)) << "a continuous joint has no limits";
}

TEST(Compile, StepThatIsNoStepIsAnError) {
    World world = empty_world(0.0);
    Diagnostics diagnostics;
    EXPECT_EQ(compile(world, {}, diagnostics), nullptr);
    EXPECT_TRUE(has(diagnostics, "bad-step"));
    CompileOptions options;
    options.dt_s = 0.004;
    Diagnostics none;
    const auto model = compile(world, options, none);
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->dt_s, 0.004);
}

TEST(Compile, LinksOfOneRobotCollideOnlyIfAskedAndNotWithTheirNeighbours) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ab", "a", "b", at_x(0.5), {0, 0, 1}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    EXPECT_TRUE(compile_one(m).type().self_pairs.empty());
    m.self_collide = true;
    EXPECT_EQ(compile_one(m).type().self_pairs, (std::vector<std::pair<int, int>>{{0, 2}}));
}

/// Joints of several motions have bodies between their links that carry nothing.
TEST(Compile, LinksOnBothSidesOfAJointOfSeveralMotionsAreNeighbours) {
    const std::vector<std::pair<int, int>> ends{{0, 2}};
    for (const bool turned : {false, true}) {
        ModelSpec m = row_of_three();
        m.self_collide = true;
        m.joints.push_back(planar_joint("ab", "a", "b", at_x(0.5), {0, 0, 1}));
        m.joints.push_back(joint(JointSpecKind::kUniversal, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
        m.joints.back().axes.resize(2);
        m.joints.back().axes[1].xyz = {0, 1, 0};
        for (JointSpec& j : m.joints)
            if (turned) std::swap(j.parent, j.child);
        const Compiled c = compile_one(m);
        ASSERT_EQ(c.model->robots.size(), 1u);
        EXPECT_EQ(c.type().bodies.size(), 6u);
        EXPECT_EQ(c.type().self_pairs, ends);
        m.joints.back().kind = JointSpecKind::kRevolute2;
        EXPECT_EQ(compile_one(m).type().self_pairs, ends);
    }
}

SensorSpec wheel_counter(const std::string& joint) {
    OdometerSpec odometer;
    odometer.joints = {joint};
    SensorSpec sensor;
    sensor.name = "counter", sensor.sdf_type = "odometer", sensor.parameters = odometer;
    return sensor;
}

TEST(Compile, RefusesASensorThatReadsAJointOfAnotherPart) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kRevolute, "bc", "b", "c", at_x(1.5), {0, 0, 1}));
    m.links[1].sensors.push_back(wheel_counter("bc"));
    EXPECT_FALSE(compile_one(m).diagnostics.has_errors()) << "b and c are one robot";
    m.links[1].sensors.clear();
    m.links[0].sensors.push_back(wheel_counter("bc"));
    const Compiled apart = compile_one(m);
    EXPECT_TRUE(has(apart.diagnostics, "joint-of-another-part"));
    EXPECT_TRUE(apart.diagnostics.has_errors());
}

TEST(Compile, RefusesASensorThatReadsAJointBetweenWeldedLinks) {
    ModelSpec m = row_of_three();
    m.joints.push_back(joint(JointSpecKind::kFixed, "ab", "a", "b", at_x(0.5)));
    m.joints.push_back(joint(JointSpecKind::kFixed, "bc", "b", "c", at_x(1.5)));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ac", "a", "c", at_x(1), {0, 0, 1}));
    m.links[0].sensors.push_back(wheel_counter("ac"));
    EXPECT_TRUE(has(compile_one(m).diagnostics, "bad-sensor"));
}

}  // namespace
}  // namespace roboss::test
