// Mechanisms in, and near, configurations in which the conditions of their loops depend on each other: they
// stay closed and never gain energy.
#include <gtest/gtest.h>

#include <support/joint_net.h>
#include <support/mechanisms.h>
#include <support/simulation.h>

#include "physics/dynamics/equality.h"

namespace roboss::test {
namespace {

/// Two cranks of .2 m and a coupler that stays parallel to the ground: at 90 degrees all lie in a line.
ModelSpec parallelogram(bool free_base) {
    constexpr double kCrank = 0.2, kGround = 0.5;
    ModelSpec m;
    m.name = m.canonical_link = "base";
    m.links = {link("base", 2, box_inertia(2, {0.6, 0.1, 0.1})), rod_between("left", {}, {0, 0, kCrank}),
               rod_between("right", {kGround, 0, 0}, {kGround, 0, kCrank}),
               rod_between("coupler", {0, 0, kCrank}, {kGround, 0, kCrank})};
    const auto hinge = [&](const char* name, const char* parent, const char* child, const Vec3& at) {
        m.joints.push_back(joint(JointSpecKind::kRevolute, name, parent, child, {at, {}}, {0, 1, 0}));
    };
    if (!free_base) m.joints.push_back(joint(JointSpecKind::kFixed, "stand", "world", "base", {}));
    hinge("left", "base", "left", {});
    hinge("right", "base", "right", {kGround, 0, 0});
    hinge("upper_left", "left", "coupler", {0, 0, kCrank});
    hinge("upper_right", "right", "coupler", {kGround, 0, kCrank});
    return m;
}

struct Course {
    double gain = 0, gap = 0, moved = 0;  // J, m, rad: largest
};

Course watch(Simulation& sim, int ticks) {
    const double energy = sim.energy();
    Course course;
    RobotWork work;
    work.type = &sim.type(0);
    Equalities equalities;
    for (int i = 0; i < ticks; ++i) {
        sim.step();
        course.gain = std::fmax(course.gain, sim.energy() - energy);
        forward_kinematics<double>(*work.type, sim.states[0].q, work);
        forward_velocities<double>(*work.type, sim.states[0].v, work);
        gather_equalities(work, sim.states[0].q, equalities);
        for (const EqualityRow& row : equalities.rows)
            course.gap = std::fmax(course.gap, std::fabs(row.error));
        for (const double v : sim.states[0].v) course.moved = std::fmax(course.moved, std::fabs(v));
    }
    return course;
}

class FlatNet : public testing::TestWithParam<std::size_t> {};

TEST_P(FlatNet, FallsClosedAndGainsNoEnergy) {
    World world = empty_world(2e-3);
    place(world, joint_net(GetParam(), 0), "net");
    Simulation sim(world);
    const Course course = watch(sim, 1000);
    tell("largest gain, J", course.gain);
    tell("largest gap, m", course.gap);
    EXPECT_LT(course.gain, 1e-6);
    EXPECT_LT(course.gap, 1e-4);
    EXPECT_GT(course.moved, 1) << "it does fall";
}

INSTANTIATE_TEST_SUITE_P(Sides, FlatNet, testing::Values(2U, 3U, 4U));

class Parallelogram : public testing::TestWithParam<bool> {};

TEST_P(Parallelogram, PassesItsDeadPointsWithItsEnergy) {
    World world = empty_world(1e-3, {});
    place(world, parallelogram(GetParam()), "robot");
    Simulation sim(world);
    for (double& v : sim.states[0].v) v = 0;
    for (const char* name : {"left", "right"})
        sim.states[0].v[sim.states[0].v.size() - sim.type(0).dofs.size() +
                        static_cast<std::size_t>(name == std::string("left") ? 0 : 1)] = 8;
    sim.step();
    const double energy = sim.energy();
    const Course course = watch(sim, 3000);
    tell("energy at the end over that at the start", sim.energy() / energy);
    tell("largest gap, m", course.gap);
    EXPECT_LT(course.gain, 1e-6 * energy);
    EXPECT_GT(sim.energy(), 0.5 * energy);
    EXPECT_LT(course.gap, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Bases, Parallelogram, testing::Bool());

}  // namespace
}  // namespace roboss::test
