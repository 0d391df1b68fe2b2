// Closed loops, gearboxes and mimic joints that move by themselves: loops stay closed, energy and momentum
// stay, accelerations are those of a dense solve written here from the poses of the links alone.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

#include "physics/equality.h"

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
    place_bodies(*work.type, sim.states[robot].q, work);
    move_bodies(*work.type, sim.states[robot].v, work);
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
    m.joints[1].axes[0].mimic = MimicSpec{"small", 0, -0.5, 0.1, 0.2};
    Simulation sim(with(m, 1e-3, {}));
    const auto expected = [&] { return -0.5 * (sim.states[0].q[7] - 0.2) + 0.1; };
    EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-12) << "from the start";
    sim.states[0].v = {4, -2};
    sim.run(2);
    EXPECT_NEAR(sim.states[0].q[8], expected(), 1e-12);
    EXPECT_NEAR(sim.states[0].v[0], 4, 1e-12);
}

}  // namespace
}  // namespace roboss::test
