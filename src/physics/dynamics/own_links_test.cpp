// Own numbers of links: a robot that has them moves as one whose file has them, bit for bit; and as closed
// forms say.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <support/mechanisms.h>
#include <support/own_numbers.h>
#include <support/robots.h>

#include "model/order.h"

namespace roboss::test {
namespace {

using LinkValues = std::vector<LinkParameterValue>;
using enum LinkParameter;

/// Gives a link of a robot these numbers, at once.
void set_link(Simulation& sim, std::size_t robot, LinkId link, LinkValues values) {
    give(sim, robot, SetLinkParameters{link, false, std::move(values)});
}

/// Another link like this one.
LinkSpec other_link(LinkSpec link, std::size_t which) {
    const double x = 1 + 0.2 * static_cast<double>(which % 4);
    link.mass *= x;
    link.p_LC += Vec3{0.01 * x, -0.005, 0.004};
    Mat3& I = link.inertia_C;
    I = I * (1.1 * x);
    I.r1.x = I.r0.y, I.r2.x = I.r0.z, I.r2.y = I.r1.z;  // to the last digit, as in files
    for (CollisionSpec& collision : link.collisions) {
        collision.surface.mu = 0.3 * x, collision.surface.restitution = which % 2 == 0 ? 0.2 : 0;
        collision.surface.torsional_mu = 0.5, collision.surface.rolling_mu = 0.001 * x;
    }
    return link;
}

LinkValues numbers_of(const LinkSpec& link) {
    const Mat3& I = link.inertia_C;
    LinkValues values{{kMass, link.mass},      {kCentreX, link.p_LC.x}, {kCentreY, link.p_LC.y},
                      {kCentreZ, link.p_LC.z}, {kInertiaXx, I(0, 0)},   {kInertiaYy, I(1, 1)},
                      {kInertiaZz, I(2, 2)},   {kInertiaXy, I(0, 1)},   {kInertiaXz, I(0, 2)},
                      {kInertiaYz, I(1, 2)}};
    if (link.collisions.empty()) return values;
    const SurfaceSpec& surface = link.collisions[0].surface;
    const LinkValues more{{kFriction, surface.mu},
                          {kRestitution, surface.restitution},
                          {kTorsionalFriction, surface.torsional_mu},
                          {kRollingFriction, surface.rolling_mu}};
    values.insert(values.end(), more.begin(), more.end());
    return values;
}

struct Scene {
    std::string name;
    ModelSpec model;
    double height = 0;
    bool sleeps = false;
};

std::vector<Scene> scenes() {
    return {{"spiders", with_balls(spider(), 0.02), 0.0},
            {"arms", arm(), 2.0},
            {"cars", car(), 0.001},
            {"boxes that sleep", solid_box(2, {0.2, 0.3, 0.1}, surface(0.5)), 0.06, true},
            {"slides", prismatic_chain(), 1.0},
            {"a tree of all joints", mixed_tree(), 0.5},
            {"four bars", four_bar(), 0.5},
            {"gears", geared_wheels(-2.5), 0.5}};
}

void drive(Simulation& sim) {
    if (sim.tick % 50 != 0) return;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t d = 0; d < sim.type(r).dofs.size(); d += 2)
            sim.states[r].motors[d] = {MotorMode::kVelocity, sim.tick % 100 == 0 ? 0.3 : -0.2, 20.0};
}

void expect_equal_types(const RobotType& a, const RobotType& b) {
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        const Body &x = a.bodies[i], &y = b.bodies[i];
        EXPECT_EQ(x.mass, y.mass) << "body " << i;
        EXPECT_EQ(x.gravity_mass, y.gravity_mass) << "body " << i;
        EXPECT_EQ(x.p_BC, y.p_BC) << "body " << i;
        EXPECT_EQ(x.p_BG, y.p_BG) << "body " << i;
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 3; ++column)
                EXPECT_EQ(x.inertia_C(row, column), y.inertia_C(row, column)) << "body " << i;
        EXPECT_EQ(x.inverse_mass_linear, y.inverse_mass_linear) << "body " << i;
        EXPECT_EQ(x.inverse_inertia_angular, y.inverse_inertia_angular) << "body " << i;
    }
    EXPECT_EQ(a.dofs, b.dofs);
    EXPECT_EQ(a.mass, b.mass);
}

/// Steps one world whose file has the numbers, and one whose robots were given them.
void expect_equal_runs(const Scene& scene, Precision precision) {
    SCOPED_TRACE(scene.name + (precision == Precision::kFloat ? ", floats" : ""));
    ModelSpec written = scene.model;
    for (std::size_t l = 0; l < written.links.size(); ++l) written.links[l] = other_link(written.links[l], l);
    World in_file = scattered(written, 5, scene.height), given = scattered(scene.model, 5, scene.height);
    in_file.precision = given.precision = precision;
    in_file.sleep = given.sleep = scene.sleeps;
    Simulation a(in_file), b(given);
    for (std::size_t r = 0; r < b.states.size(); ++r)
        for (const LinkSpec& link : written.links)
            if (link.mass > 0) set_link(b, r, *b.type(r).find_link(link.name), numbers_of(link));
    expect_equal_types(a.type(0), type_of(b.type(0), b.states[0]));
    expect_equal_steps(a, b, drive, 250);
}

TEST(OwnLinks, MoveARobotAsAFileWithTheseNumbersDoes) {
    for (const Scene& scene : scenes()) expect_equal_runs(scene, Precision::kDouble);
}

TEST(OwnLinks, MoveARobotSteppedInFloatsAsAFileWithTheseNumbersDoes) {
    for (const Scene& scene : {scenes()[0], scenes()[1], scenes()[2]})
        expect_equal_runs(scene, Precision::kFloat);
}

TEST(OwnLinks, OfSomeRobotsLeaveTheBitsOfAllToNoLane) {
    const Drive some_differ = [](Simulation& sim) {
        drive(sim);
        if (sim.tick % 60 != 7) return;
        for (std::size_t r = 0; r < sim.states.size(); ++r)  // some equal, some their own, some of the type
            for (std::size_t l = 0; r % 3 != 0 && l < sim.type(r).links.size(); ++l) {
                const double x = 1 + 0.1 * static_cast<double>(r % 3 == 1 ? l : l + r);
                const double mass = *link_number(sim.type(r), LinkId(l), kMass);
                set_link(sim, r, LinkId(l), {{kMass, mass * x}});
            }
    };
    compare(scattered(with_balls(spider(), 0.02), 13, 0.0), some_differ, 200);
}

TEST(OwnLinks, ThePendulumSwingsWithItsOwnMassAndCentre) {
    World world = empty_world(1e-3, {0, 0, -9.81});
    place(world, pendulum(2.0, 0.8), "rod");
    Simulation sim(world);
    const LinkId rod(0u);
    set_link(sim, 0, rod, {{kMass, 5}, {kCentreZ, -0.7}});
    const double moment = *link_number(type_of(sim.type(0), sim.states[0]), rod, kInertiaYy) + 5 * 0.49;
    EXPECT_NEAR(moment - 5 * 0.49, 2.5 * *link_number(sim.type(0), rod, kInertiaYy), 1e-12);
    const double small = 0.01, rate = std::sqrt(5 * 9.81 * 0.7 / moment);
    sim.states[0].q[7] = small;
    for (int i = 0; i < 3000; ++i) {
        sim.step();
        ASSERT_NEAR(sim.states[0].q[7], small * std::cos(rate * sim.time()), 2e-5) << sim.time();
    }
}

TEST(OwnLinks, FrictionStopsABoxAfterItsClosedForm) {
    for (const double mu : {0.1, 0.5}) {
        World world = empty_world(1e-3, {0, 0, -9.81});
        place(world, ground(surface(1.0)), "ground");
        place(world, solid_box(2, {0.2, 0.2, 0.1}, surface(0.8)), "box", {{0, 0, 0.05}, {}});
        Simulation sim(world);
        set_link(sim, 0, LinkId(0u), {{kFriction, mu}});
        sim.run(0.2);
        const double from = sim.states[0].q[0];
        sim.states[0].v[3] = 1;
        sim.run(2);
        EXPECT_NEAR(sim.states[0].q[0] - from, 1 / (2 * mu * 9.81), 0.01 / mu / 9.81) << mu;
    }
}

TEST(OwnLinks, ABallBouncesAsItsOwnRestitutionSays) {
    World world = empty_world(1e-3, {0, 0, -9.81});
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_sphere(1, 0.1, surface(0.5)), "ball", {{0, 0, 1.1}, {}});
    Simulation sim(world);
    set_link(sim, 0, LinkId(0u), {{kRestitution, 0.6}});
    double highest = 0;
    sim.run(std::sqrt(2 * 1.0 / 9.81) + 0.01);
    for (int i = 0; i < 500; ++i) sim.step(), highest = std::max(highest, sim.states[0].q[2]);
    EXPECT_NEAR(highest, 0.1 + 0.36, 0.01);
}

TEST(OwnLinks, APayloadSharesItsMomentum) {
    World world = empty_world(1e-3, {0, 0, 0});
    place(world, solid_sphere(1, 0.1, surface(0.5)), "a", {{0, 0, 0}, {}});
    place(world, solid_sphere(1, 0.1, surface(0.5)), "b", {{1, 0, 0}, {}});
    Simulation sim(world);
    for (std::size_t r : {0u, 1u}) set_link(sim, r, LinkId(0u), {{kRestitution, 1}});
    set_link(sim, 1, LinkId(0u), {{kMass, 3}});
    sim.states[0].v[3] = 2;
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[3], -1, 1e-5) << "(m - M) / (m + M)";
    EXPECT_NEAR(sim.states[1].v[3], 1, 1e-5) << "2 m / (m + M)";
}

}  // namespace
}  // namespace roboss::test
