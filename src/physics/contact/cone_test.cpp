// A cone: it stands on its base, slides as Coulomb's law says, lies on its side, falls over where its centre
// of mass is beyond its base, and never gains energy. It collides as a hull of 128 corners round its rim.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kMass = 2, kRadius = 0.1, kLength = 0.3;

/// Solid, with its tip up; the origin is at half of its height.
ModelSpec cone(double mu) {
    const double across = kMass * (3 * kRadius * kRadius / 20 + 3 * kLength * kLength / 80);
    LinkSpec l = link("cone", kMass, Mat3::diagonal(across, across, 0.3 * kMass * kRadius * kRadius));
    l.p_LC = {0, 0, -kLength / 4};
    CollisionSpec c = collision(GeometryKind::kCone, surface(mu));
    c.geometry.radius = kRadius;
    c.geometry.length = kLength;
    l.collisions.push_back(c);
    return one_link(l);
}

Simulation on_ground(double mu, const Pose& X_WM, double dt_s = 1e-3) {
    World world = empty_world(dt_s);
    place(world, ground(surface(1)), "ground");
    place(world, cone(mu), "cone", X_WM);
    return Simulation(world);
}

Quat about_y(double angle) {
    return {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
}

TEST(Cone, StandsOnItsBase) {
    Simulation sim = on_ground(0.5, {{0, 0, kLength / 2}, {}});
    sim.run(5);
    const RobotState& state = sim.states[0];
    EXPECT_NEAR(state.q[0], 0, 1e-6);
    EXPECT_NEAR(state.q[1], 0, 1e-6);
    EXPECT_NEAR(std::fabs(state.q[3]), 1, 1e-9) << "upright";
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(state.v[k], 0, 1e-6);
}

TEST(Cone, SlidesAsFarAsFrictionSays) {
    constexpr double kMu = 0.2, kSpeed = 1;
    Simulation sim = on_ground(kMu, {{0, 0, kLength / 2}, {}});
    sim.run(0.1);
    const double from = sim.states[0].q[0];
    sim.states[0].v[3] = kSpeed;
    sim.run(2);
    const double way = kSpeed * kSpeed / (2 * kMu * kG);
    tell("way against v^2 / (2 mu g)", (sim.states[0].q[0] - from) / way);
    EXPECT_NEAR((sim.states[0].q[0] - from) / way, 1, 0.01);
    EXPECT_NEAR(sim.states[0].v[3], 0, 1e-6);
}

TEST(Cone, LiesOnItsSideAndStays) {
    // The side is horizontal where the axis is turned by 90 degrees plus half the angle at the tip.
    const double half_tip = std::atan(kRadius / kLength), turned = kPi / 2 + half_tip;
    const double height = kLength / 2 * std::sin(half_tip);  // of the middle of the axis over its side
    Simulation sim = on_ground(1, {{0, 0, height + 1e-4}, about_y(turned)});
    sim.run(3);
    const Quat& q = Quat{sim.states[0].q[3], sim.states[0].q[4], sim.states[0].q[5], sim.states[0].q[6]};
    const Vec3 axis = to_matrix(q).col(2);
    EXPECT_NEAR(axis.z, -std::sin(half_tip), 2e-3) << "the tip points a little down";
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(sim.states[0].v[k], 0, 1e-3);
}

TEST(Cone, FallsOverWhereItsCentreIsBeyondItsBase) {
    // The centre of mass is a quarter of the height over the base: atan(4 r / h) from upright is the limit.
    const double limit = std::atan(4 * kRadius / kLength);
    for (const double tilt : {0.9 * limit, 1.1 * limit}) {
        const double low = -kLength / 2 * std::cos(tilt) - kRadius * std::sin(tilt);
        Simulation sim = on_ground(1, {{0, 0, -low + 1e-5}, about_y(tilt)});
        sim.run(3);
        const Quat q{sim.states[0].q[3], sim.states[0].q[4], sim.states[0].q[5], sim.states[0].q[6]};
        const double up = to_matrix(q).col(2).z;
        if (tilt < limit)
            EXPECT_GT(up, 0.999) << "rocks back onto its base";
        else
            EXPECT_LT(up, 0.5) << "falls over";
    }
}

TEST(Cone, NeverGainsEnergy) {
    for (const double angle : {0.3, 1.2, 2.0, 3.0}) {
        Simulation sim = on_ground(0.6, {{0, 0, 0.6}, about_y(angle)});
        sim.states[0].v[0] = 3, sim.states[0].v[2] = -7;
        double most = sim.energy();
        for (int k = 0; k < 300; ++k) {
            sim.run(0.01);
            EXPECT_LE(sim.energy(), most + 1e-6 * std::fabs(most) + 1e-9) << "at " << sim.time();
            most = std::min(most, sim.energy());
        }
    }
}

}  // namespace
}  // namespace roboss::test
