// Soft limits: springs with dissipation that never pull, beside the hard ones of joint_test.cpp.
#include <gtest/gtest.h>

#include <support/bodies.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kMass = 2.0;

/// A block on a slide along x without gravity, limited at 0.1 m.
World slider(double stiffness, double dissipation, double dt_s = 1e-3) {
    World world = empty_world(dt_s, {});
    ModelSpec model = solid_box(kMass, {0.1, 0.1, 0.1}, surface(0.5));
    model.joints.push_back(joint(JointSpecKind::kPrismatic, "slide", "world", "box", {}, {1, 0, 0}));
    AxisSpec& axis = model.joints[0].axes[0];
    axis.lower = -0.1, axis.upper = 0.1;
    axis.limit_stiffness = stiffness, axis.limit_dissipation = dissipation;
    place(world, model, "slider");
    return world;
}

TEST(SoftLimit, GivesWayByForceOverStiffness) {
    for (const double direction : {1.0, -1.0}) {
        Simulation sim(slider(500, 40));
        sim.states[0].motors[0] = {MotorMode::kEffort, 5 * direction, 10};
        sim.run(8);
        EXPECT_NEAR(sim.states[0].q[7], direction * (0.1 + 5.0 / 500), 1e-8);
        EXPECT_NEAR(sim.states[0].v[0], 0, 1e-8);
    }
}

TEST(SoftLimit, WithoutDissipationGivesTheSpeedBack) {
    Simulation sim(slider(500, 0, 1e-4));
    sim.states[0].v[0] = 1;
    double deepest = 0;
    while (sim.time() < 0.5) {
        sim.step();
        deepest = std::fmax(deepest, sim.states[0].q[7] - 0.1);
        if (sim.states[0].v[0] < 0 && sim.states[0].q[7] < 0) break;
    }
    const double frequency = std::sqrt(500 / kMass);
    EXPECT_NEAR(deepest * frequency, 1, 2e-3);
    tell("speed given back", -sim.states[0].v[0]);
    EXPECT_NEAR(sim.states[0].v[0], -1, 5e-3) << "implicit Euler damps by frequency * dt / 2";
}

TEST(SoftLimit, WithDissipationReturnsAsTheDampedSpringAndNeverPulls) {
    const double stiffness = 800, dissipation = 60;
    Simulation sim(slider(stiffness, dissipation, 1e-5));
    sim.states[0].v[0] = 1;
    bool touched = false;
    double leaving = 0;
    while (sim.time() < 0.6) {
        sim.step();
        touched |= sim.states[0].q[7] > 0.1;
        if (touched && sim.states[0].q[7] < 0.09) {
            if (leaving == 0) leaving = sim.states[0].v[0];
            ASSERT_NEAR(sim.states[0].v[0], leaving, 1e-12) << "free again";
            if (sim.states[0].q[7] < 0) break;
        }
    }
    // m x'' + c x' + k x = 0 from x' = 1 until the force c x' + k x is zero.
    const double a = dissipation / (2 * kMass), w = std::sqrt(stiffness / kMass - a * a);
    const auto x = [&](double t) { return std::exp(-a * t) * std::sin(w * t) / w; };
    const auto v = [&](double t) { return std::exp(-a * t) * (std::cos(w * t) - a / w * std::sin(w * t)); };
    double t = 1e-6;
    while (dissipation * v(t) + stiffness * x(t) > 0) t += 1e-6;
    tell("speed of return, and of the damped spring", leaving);
    EXPECT_NEAR(leaving, v(t), 1e-4);
}

TEST(SoftLimit, DefaultStiffnessIsHard) {
    Simulation sim(slider(1e8, 1));
    EXPECT_TRUE(std::isinf(sim.type(0).dofs[0].limit_stiffness));
    sim.states[0].v[0] = 5;
    sim.run(0.5);
    EXPECT_NEAR(sim.states[0].q[7], 0.1, 1e-5);
    EXPECT_NEAR(sim.states[0].v[0], 0, 1e-3);
}

TEST(SoftLimit, StifferThanTheSolverIsAsHardAsItsRows) {
    Simulation sim(slider(9e7, 0));
    sim.states[0].v[0] = 5;
    sim.run(0.5);
    EXPECT_LT(sim.states[0].q[7], 0.1 + 1e-3);
    EXPECT_LE(std::fabs(sim.states[0].v[0]), 5.0);
}

}  // namespace
}  // namespace roboss::test
