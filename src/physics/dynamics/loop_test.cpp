// Closed loops, gearboxes and mimic joints that move by themselves: loops stay closed, energy and momentum
// stay, accelerations are those of a dense solve written here from the poses of the links alone.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

#include "model/coordinates.h"
#include "physics/dynamics/equality.h"

namespace roboss::test {
namespace {

World with(const ModelSpec& model, double dt_s = 1e-3, const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(dt_s, gravity);
    place(world, model, "robot", {{0.1, 0.2, 1}, from_rpy(0, 0, 0.3)});
    return world;
}

/// Largest error of all loops and couplings, m or rad.
double gap(const Simulation& sim, std::size_t robot = 0) {
    RobotWork work;
    work.type = &sim.type(robot);
    forward_kinematics<double>(*work.type, sim.states[robot].q, work);
    forward_velocities<double>(*work.type, sim.states[robot].v, work);
    Equalities equalities;
    gather_equalities(work, sim.states[robot].q, equalities);
    double largest = 0;
    for (const EqualityRow& row : equalities.rows) largest = std::fmax(largest, std::fabs(row.error));
    return largest;
}

/// Distance between the places of a joint in both of its links, from poses of links alone.
double distance_at(const Simulation& sim, const std::string& joint_name) {
    const ModelSpec& spec = sim.world.prototypes[0];
    const RobotType& type = sim.type(0);
    for (const JointSpec& j : spec.joints) {
        if (j.name != joint_name) continue;
        Vec3 p[2];
        for (int end = 0; end < 2; ++end) {
            const std::string& name = end == 0 ? j.parent : j.child;
            for (const LinkSpec& l : spec.links)
                if (l.name == name)
                    p[end] = link_pose(type, sim.states[0], *type.find_link(name)) *
                             (inverse(to_transform(l.X_ML)) * j.X_MJ.p);
        }
        return norm(p[0] - p[1]);
    }
    ADD_FAILURE() << "no joint " << joint_name;
    return 0;
}

TEST(Loop, OfEqualJointsTheLastIsCut) {
    Simulation sim(with(four_bar()));
    const RobotType& type = sim.type(0);
    ASSERT_EQ(type.loops.size(), 1u);
    EXPECT_EQ(type.joints[type.loops[0].joint.index()].name, "closing");
    EXPECT_EQ(type.nv, 3);
    EXPECT_LT(gap(sim), 1e-15);
}

TEST(Loop, PassiveFourBarKeepsItsEnergyAndStaysClosed) {
    Simulation sim(with(four_bar()));
    const double energy = sim.energy();
    double open = 0;
    for (int i = 0; i < 5000; ++i) {
        sim.step();
        open = std::fmax(open, distance_at(sim, "closing"));
    }
    EXPECT_GT(std::fabs(sim.states[0].q[7]) + std::fabs(sim.states[0].v[0]), 0.5) << "it does move";
    tell("energy lost of the four-bar in 5 s, J", sim.energy() - energy);
    tell("largest gap, m", open);
    EXPECT_NEAR(sim.energy(), energy, 1e-7);
    EXPECT_LT(open, 1e-12);
}

TEST(Loop, FreeFourBarKeepsMomentum) {
    FourBarOptions options;
    options.free_base = true;
    Simulation sim(with(four_bar(options), 1e-3, {}));
    sim.states[0].v = {0.3, -0.5, 1, 0.2, 0.1, -0.3, 2, 0, 0};
    sim.step();  // brings the velocities onto the loop
    const double energy = sim.energy();
    const Momentum before = sim.momentum();
    sim.run(5);
    const Momentum after = sim.momentum();
    EXPECT_NEAR(sim.energy() / energy, 1, 1e-8);
    EXPECT_LT(norm(after.linear - before.linear), 1e-9);
    EXPECT_LT(norm(after.angular - before.angular), 1e-9);
    EXPECT_LT(gap(sim), 1e-12);
}

TEST(Loop, StewartPlatformFallsClosed) {
    Simulation sim(with(stewart()));
    ASSERT_EQ(sim.type(0).loops.size(), 5u);
    const double energy = sim.energy();
    sim.run(0.3);
    EXPECT_LT(link_pose(sim.type(0), sim.states[0], LinkId(std::size_t{0})).p.z, 1.7);
    for (int i = 0; i < 6; ++i) EXPECT_LT(distance_at(sim, "head_" + std::to_string(i)), 1e-12);
    EXPECT_NEAR(sim.energy(), energy, 1e-7);
}

TEST(Gearbox, TurnsTheOtherWayByItsRatio) {
    Simulation sim(with(geared_wheels(2.5), 1e-3, {}));
    sim.states[0].v = {3, -7.5};
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[0], 3, 1e-12);
    EXPECT_NEAR(sim.states[0].q[8], -2.5 * sim.states[0].q[7], 1e-12);
}

TEST(Gearbox, StandstillWheelIsPulledAlong) {
    Simulation sim(with(geared_wheels(2.5), 1e-3, {}));
    sim.states[0].v = {3, 0};
    sim.step();
    EXPECT_NEAR(sim.states[0].v[0], 3 * 0.02 / (0.02 + 0.05 * 2.5 * 2.5), 1e-12);
}

TEST(Mimic, FollowsWithMultiplierOffsetAndReference) {
    ModelSpec m = two_wheels();
    m.joints[1].axes[0].mimic = MimicSpec{"small", 0, -0.5, 0.1, 0.2, {}};
    Simulation sim(with(m, 1e-3, {}));
    const auto expected = [&] { return -0.5 * (sim.states[0].q[7] - 0.2) + 0.1; };
    EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-12) << "from the start";
    sim.states[0].v = {4, -2};
    sim.run(2);
    EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-12);
    EXPECT_NEAR(sim.states[0].v[0], 4, 1e-12);
}

/// y = p(x): y follows exactly, and what x loses in inertia is that of y at its slope: the energy stays.
TEST(Mimic, FollowsAPolynomialWithoutLosingEnergy) {
    ModelSpec m = two_wheels();
    MimicSpec mimic{"small", 0, 0.5, 0.1, 0.2, {}};
    mimic.higher = {0.8, -0.3, 0.05};
    m.joints[1].axes[0].mimic = mimic;
    Simulation sim(with(m, 1e-3, {}));
    const auto expected = [&] {
        const double d = sim.states[0].q[7] - 0.2;
        return 0.1 + 0.5 * d + 0.8 * d * d - 0.3 * d * d * d + 0.05 * d * d * d * d;
    };
    const auto slope = [&] {
        const double d = sim.states[0].q[7] - 0.2;
        return 0.5 + 1.6 * d - 0.9 * d * d + 0.2 * d * d * d;
    };
    const auto energy = [&] {
        const double x = sim.states[0].v[0], y = sim.states[0].v[1];
        return 0.02 * x * x / 2 + 0.05 * y * y / 2;
    };
    EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-10) << "from the start";
    sim.states[0].v = {1, slope()};
    const double before = energy();
    for (int i = 0; i < 10; ++i) {
        sim.run(0.1);
        EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-12) << i;
        EXPECT_NEAR(sim.states[0].v[1], slope() * sim.states[0].v[0], 1e-10) << i;
        EXPECT_NEAR(energy(), before, 1e-4 * before) << i;
    }
}

/// The frame of a joint as one of its links carries it.
Transform joint_frame(const Simulation& sim, const JointSpec& j, const std::string& end) {
    for (const LinkSpec& l : sim.world.prototypes[0].links)
        if (l.name == end)
            return link_pose(sim.type(0), sim.states[0], *sim.type(0).find_link(end)) *
                   to_transform(inverse(l.X_ML) * j.X_MJ);
    return {};
}

class LoopReading : public testing::TestWithParam<const char*> {};

/// Readings of a joint that closes a loop, put into its motion, give how its two links stand; and they change
/// at the velocities that are read.
TEST_P(LoopReading, PositionsAndVelocitiesAreThoseOfItsLinks) {
    Simulation sim(with(ring_of_all_kinds(*find_joint_type(GetParam()))));
    const RobotType& type = sim.type(0);
    const JointSpec& j = sim.world.prototypes[0].joints.back();
    const JointId id = *type.find_joint("closing");
    const Joint& joint = type.joints[id.index()];
    ASSERT_GE(joint.loop, 0);
    for (std::size_t i = 0; i < sim.states[0].v.size(); ++i)
        sim.states[0].v[i] = 0.3 - 0.1 * static_cast<double>(i % 5);
    for (int round = 0; round < 5; ++round) {
        sim.run(0.05);
        const auto read = [&](int axis) { return joint_state(type, sim.states[0], id, axis); };
        const Transform X = inverse(joint_frame(sim, j, j.parent)) * joint_frame(sim, j, j.child);
        Transform expected;
        if (j.kind == JointSpecKind::kBall)
            expected.R = to_matrix(exponential(Vec3{read(0).position, read(1).position, read(2).position}));
        for (std::size_t k = 0; k < j.axes.size(); ++k) {
            const JointKind motion = joint_type(j.kind).motions[k];
            const double position = read(static_cast<int>(k)).position;
            if (motion != JointKind::kPrismatic)
                expected.R = expected.R * to_matrix(axis_angle(j.axes[k].xyz, position));
            else
                expected.p += j.axes[k].xyz * position;
            if (motion == JointKind::kScrew) expected.p = j.axes[k].xyz * (j.screw_pitch * position);
        }
        EXPECT_LT(norm(X.p - expected.p), 1e-10);
        for (std::size_t r = 0; r < 3; ++r) EXPECT_LT(norm(X.R.row(r) - expected.R.row(r)), 1e-10);
        if (j.kind == JointSpecKind::kBall) continue;  // its velocity is no rate of the rotation vector
        for (int axis = 0; axis < joint.nv; ++axis) {
            RobotState before = sim.states[0], after = sim.states[0];
            advance_coordinates<double>(type, before.v, -1e-5, before.q);
            advance_coordinates<double>(type, after.v, 1e-5, after.q);
            const double rate =
                (joint_state(type, after, id, axis).position - joint_state(type, before, id, axis).position) /
                2e-5;
            EXPECT_NEAR(read(axis).velocity, rate, 1e-7);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LoopReading,
                         testing::Values("revolute", "prismatic", "screw", "universal", "ball", "planar"),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace roboss::test
