// Wind and drag against closed forms.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kDensity = 1.2;

ModelSpec ball(double mass, double radius, const DragSpec& drag) {
    ModelSpec m = solid_sphere(mass, radius, surface(0.5));
    m.links[0].drag = drag;
    return m;
}

DragSpec air(bool wind = false) {
    DragSpec d;
    d.acts = true;
    d.wind = wind;
    return d;
}

World windy(double dt_s, const Vec3& wind, const Vec3& gravity = {0, 0, -kG}) {
    World world = empty_world(dt_s, gravity);
    world.wind = wind;
    world.air_density = kDensity;
    return world;
}

TEST(Drag, AFallingBallComesToItsTerminalVelocity) {
    World world = windy(1e-3, {});
    place(world, ball(0.1, 0.1, air()), "ball");
    Simulation sim(world);
    const double terminal = std::sqrt(2 * 0.1 * kG / (kDensity * 0.47 * kPi * 0.01));
    for (const double t : {0.5, 1.0, 3.0, 20.0}) {
        sim.run(t - sim.time());
        const double expected = terminal * std::tanh(kG * t / terminal);
        EXPECT_NEAR(-sim.states[0].v[5] / expected, 1, 1e-9) << "at " << t << " s";
    }
}

TEST(Drag, LinearDragDecaysExponentially) {
    World world = windy(1e-3, {}, {});
    DragSpec d = air();
    d.area = 0;
    d.linear = 0.5;
    place(world, ball(2, 0.1, d), "ball");
    Simulation sim(world);
    sim.states[0].v[3] = 3;
    sim.run(4);
    EXPECT_NEAR(sim.states[0].v[3], 3 * std::exp(-1.0), 1e-9);
}

TEST(Drag, AnyStrengthIsStableAndEndsInTheWind) {
    for (const double linear : {1.0, 1e3, 1e6, 1e9}) {
        World world = windy(2e-3, {4, -3, 0}, {});
        DragSpec d = air(true);
        d.linear = linear;
        d.area = 50;
        place(world, ball(0.5, 0.1, d), "ball");
        place(world, ball_chain(), "chain", {{5, 0, 0}, {}});
        Simulation sim(world);
        sim.states[0].v[3] = -40;
        double before = norm(Vec3{-44, 3, 0});
        for (int i = 0; i < 5000; ++i) {
            sim.step();
            const Vec3 v{sim.states[0].v[3] - 4, sim.states[0].v[4] + 3, sim.states[0].v[5]};
            ASSERT_LE(norm(v), before * (1 + 1e-12)) << "linear " << linear << ", tick " << i;
            before = norm(v);
        }
        EXPECT_LT(before, 0.05);
    }
}

TEST(Drag, WindActsOnlyWhereItIsEnabled) {
    World world = windy(1e-3, {10, 0, 0}, {});
    place(world, ball(0.1, 0.1, air(true)), "carried");
    place(world, ball(0.1, 0.1, air(false)), "in still air", {{0, 2, 0}, {}});
    place(world, ball(0.1, 0.1, {}), "in no air", {{0, 4, 0}, {}});
    Simulation sim(world);
    sim.run(1);
    const double k = 0.5 * kDensity * 0.47 * kPi * 0.01 / 0.1;  // u' = -k u^2
    EXPECT_NEAR(sim.states[0].v[3], 10 - 10 / (1 + 10 * k), 1e-9);
    EXPECT_EQ(sim.states[1].v[3], 0);
    EXPECT_EQ(sim.states[2].v[3], 0);
}

TEST(Drag, ABoxMeetsTheAirWithItsProjectedAreas) {
    for (const bool turned : {false, true}) {
        World world = windy(1e-3, {}, {});
        ModelSpec plate = solid_box(1.0, {0.02, 0.5, 0.4}, surface(0.5));
        plate.links[0].drag = air();
        place(world, plate, "plate", {{}, turned ? from_rpy(0, 0, kPi / 2) : Quat{}});
        Simulation sim(world);
        sim.states[0].v[3] = 10;
        sim.run(1);
        const double area = turned ? 0.02 * 0.4 : 0.5 * 0.4;
        const double k = 0.5 * kDensity * 1.05 * area;
        EXPECT_NEAR(sim.states[0].v[3], 10 / (1 + 10 * k), 1e-8);
    }
}

TEST(Drag, AnArmInTheWindTurnsUntilItHangsWithIt) {
    // A rod on a hinge about z, blown along y: it settles along +y. The torque at the start is force times
    // arm.
    World world = windy(1e-3, {0, 6, 0}, {});
    ModelSpec arm = one_link(link("rod", 1.0, box_inertia(1.0, {1, 0.1, 0.1}), {{0.5, 0, 0}, {}}));
    DragSpec d = air(true);
    d.coefficient = 1;
    d.area = 0.2;
    arm.links[0].drag = d;
    arm.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "rod", {}, {0, 0, 1}));
    arm.joints[0].axes[0].damping = 0.05;
    place(world, arm, "arm");
    Simulation sim(world);
    sim.step();
    const double torque = 0.5 * kDensity * 0.2 * 36 * 0.5, inertia = (1.0 + 0.01) / 12 + 0.25;
    EXPECT_NEAR(sim.states[0].v[0] / (torque / inertia * 1e-3), 1, 2e-3);
    sim.run(60);
    EXPECT_NEAR(sim.states[0].q[7], kPi / 2, 1e-3);
}

}  // namespace
}  // namespace roboss::test
