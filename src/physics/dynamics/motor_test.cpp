// Motors as bounded rows: exactly the bound when they stall, exactly the target when they do not.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "physics/dynamics/motor_effort.h"

namespace roboss::test {
namespace {

constexpr double kMass = 2.0, kLength = 0.8;

/// A rod on one driven hinge. With gravity along y the hinge carries no load; with gravity along -z it must
/// lift the rod.
struct Hinge {
    explicit Hinge(double max_effort, bool loaded = false) : Hinge(max_effort, loaded, [](AxisSpec&) {}) {}
    template <class Change>
    Hinge(double max_effort, bool loaded, Change change) {
        World world = empty_world(1e-3, loaded ? Vec3{0, 0, -9.81} : Vec3{});
        ModelSpec model = pendulum(kMass, kLength);
        model.joints[0].axes[0].max_effort = max_effort;
        change(model.joints[0].axes[0]);
        place(world, model, "hinge");
        sim = std::make_unique<Simulation>(world);
    }
    void set(MotorMode mode, double target) { sim->set_motor(0, 0, mode, target); }
    double q() const { return sim->states[0].q[7]; }
    double& q() { return sim->states[0].q[7]; }
    double v() const { return sim->states[0].v[0]; }
    double inertia() const {
        const LinkSpec& rod = sim->world.prototypes[0].links[0];
        return rod.inertia_C(1, 1) + rod.mass * norm_squared(rod.p_LC);
    }
    double weight_torque() const { return kMass * 9.81 * 0.5 * kLength; }  // of the rod held level
    std::unique_ptr<Simulation> sim;
};

TEST(Motor, StalledMotorGivesExactlyItsBound) {
    Hinge hinge(1.5);
    hinge.set(MotorMode::kVelocity, 1e3);
    hinge.sim->run(0.1);
    EXPECT_NEAR(hinge.v() / (1.5 * 0.1 / hinge.inertia()), 1, 1e-9);
}

TEST(Motor, MotorTooWeakForItsLoadSinksWithItsBoundOpposed) {
    Hinge hinge(3.0, true);
    hinge.q() = -kPi / 2;  // level, along +x; gravity turns it to positive angles
    hinge.set(MotorMode::kVelocity, -2);
    hinge.sim->step();
    const double torque = (hinge.weight_torque() - 3.0) / hinge.inertia();
    EXPECT_NEAR(hinge.v() / (torque * 1e-3), 1, 1e-9);
}

TEST(Motor, VelocityMotorReachesItsTargetExactly) {
    Hinge hinge(1.5);
    hinge.set(MotorMode::kVelocity, 0.7);
    hinge.sim->run(1);
    EXPECT_NEAR(hinge.v(), 0.7, 1e-14);
    Hinge loaded(50, true);
    loaded.set(MotorMode::kVelocity, 0.7);
    for (int i = 0; i < 1000; ++i) {
        loaded.sim->step();
        if (i > 20) {
            ASSERT_NEAR(loaded.v(), 0.7, 1e-9) << "tick " << i;
        }
    }
}

/// The row gives way by its compliance times what the load has changed: a level rod that its servo lifts
/// hangs on a load that does not change at all where it stands.
TEST(Motor, ServoHoldsItsTargetUnderALoadAsIfItHadNone) {
    for (const MotorMode mode : {MotorMode::kVelocity, MotorMode::kPosition}) {
        Hinge hinge(50, true);
        hinge.q() = -kPi / 2;
        hinge.set(mode, mode == MotorMode::kVelocity ? 0 : -kPi / 2);
        hinge.sim->run(2);
        EXPECT_NEAR(hinge.v(), 0, 1e-14);
        EXPECT_NEAR(hinge.q(), -kPi / 2, 1e-10) << "the first two ticks find the load";
        const MotorSetpoint& motor = hinge.sim->states[0].motors[0];
        EXPECT_NEAR(motor.impulse, -hinge.weight_torque() * 1e-3, 1e-10);
        EXPECT_NEAR(motor.load, motor.impulse, 1e-12);
    }
}

TEST(Motor, ABlowIsNoLoad) {
    Hinge hinge(50, true);
    hinge.q() = -kPi / 2;
    hinge.set(MotorMode::kVelocity, -1);
    hinge.sim->step();
    const MotorSetpoint& motor = hinge.sim->states[0].motors[0];
    EXPECT_EQ(motor.impulse, -50 * 1e-3) << "its bound, to take up speed";
    EXPECT_EQ(motor.load, 0);
    hinge.sim->run(0.1);
    EXPECT_GT(std::fabs(motor.load), 0.9 * std::fabs(motor.impulse));
}

TEST(Motor, VelocityMotorKeepsTheAxisMaximum) {
    Hinge hinge(1.5, false, [](AxisSpec& axis) { axis.max_velocity = 0.4; });
    hinge.set(MotorMode::kVelocity, -3);
    hinge.sim->run(1);
    EXPECT_NEAR(hinge.v(), -0.4, 1e-12);
}

TEST(Motor, VelocityGainGivesAProportionalForce) {
    Hinge hinge(100, false, [](AxisSpec& axis) { axis.velocity_gain = 0.5, axis.damping = 0.25; });
    hinge.set(MotorMode::kVelocity, 3);
    hinge.sim->run(60);
    // gain (target - v) = damping v; forces below the solver's tolerance times the momentum over dt are not
    // resolved
    EXPECT_NEAR(hinge.v(), 3 * 0.5 / 0.75, 5e-6);
}

TEST(Motor, PositionMotorReachesItsTargetAndHoldsItAgainstGravity) {
    for (const double target : {1.0, -1.5}) {
        Hinge hinge(20, true);
        hinge.set(MotorMode::kPosition, target);
        double overshoot = 0;
        for (int i = 0; i < 3000; ++i) {
            hinge.sim->step();
            overshoot = std::fmax(overshoot, (hinge.q() - target) * (target > 0 ? 1 : -1));
        }
        tell("position error under load, rad", hinge.q() - target);
        EXPECT_NEAR(hinge.q(), target, 1e-7);
        EXPECT_NEAR(hinge.v(), 0, 1e-9);
        EXPECT_LT(overshoot, 1e-3);
    }
}

TEST(Motor, PositionMotorTooWeakForTheLoadHangsWhereItsBoundHolds) {
    Hinge hinge(3.0, true, [](AxisSpec& axis) { axis.damping = 1.0; });
    hinge.set(MotorMode::kPosition, kPi / 2);
    hinge.sim->run(30);
    EXPECT_NEAR(hinge.weight_torque() * std::sin(hinge.q()), 3.0, 1e-6);
}

TEST(Motor, PositionGainsActAsASpringWithADamper) {
    Hinge hinge(1e3, true, [](AxisSpec& axis) { axis.position_gain = 40, axis.velocity_gain = 8; });
    hinge.set(MotorMode::kPosition, 0.5);
    hinge.sim->run(10);
    EXPECT_NEAR(40 * (0.5 - hinge.q()), hinge.weight_torque() * std::sin(hinge.q()), 1e-6);
}

/// However short the tick and small the damping: the level rod droops by its weight over the gain, with the
/// axis' maximum velocity as without.
TEST(Motor, ServoGivesTheWholeForceOfItsGains) {
    for (const double max_velocity : {0.05, std::numeric_limits<double>::infinity()}) {
        Hinge hinge(1e3, true, [&](AxisSpec& axis) {
            axis.position_gain = 50, axis.velocity_gain = 0, axis.max_velocity = max_velocity;
        });
        hinge.q() = -kPi / 2;
        hinge.set(MotorMode::kPosition, -kPi / 2 - hinge.weight_torque() / 50);
        hinge.sim->run(1);
        EXPECT_NEAR(hinge.q(), -kPi / 2, 1e-9) << "at most " << max_velocity;
    }
    Hinge free(1e3, false, [](AxisSpec& axis) { axis.position_gain = 50, axis.velocity_gain = 0.5; });
    free.set(MotorMode::kPosition, 0.4);
    free.sim->step();
    const double damping = 50 * 1e-3 + 0.5;
    EXPECT_NEAR(free.v() * (free.inertia() + 1e-3 * damping) / (1e-3 * 50 * 0.4), 1, 1e-9);
}

TEST(Motor, ServoStopsPushingAtTheAxisMaximumVelocity) {
    for (const double target : {3.0, -3.0}) {
        Hinge hinge(20, false, [](AxisSpec& axis) {
            axis.position_gain = 30, axis.velocity_gain = 3, axis.max_velocity = 0.5;
        });
        hinge.set(MotorMode::kPosition, target);
        hinge.sim->step();
        EXPECT_NEAR(hinge.v() / (20e-3 / hinge.inertia()) * (target > 0 ? 1 : -1), 1, 1e-9);
        double fastest = 0;
        for (int i = 0; i < 15000; ++i) {
            hinge.sim->step();
            fastest = std::fmax(fastest, std::fabs(hinge.v()));
        }
        tell("fastest, rad/s beyond the maximum", fastest - 0.5);
        EXPECT_NEAR(fastest, 0.5, 1e-6);
        EXPECT_NEAR(hinge.q(), target, 1e-6);
    }
}

/// What turned the rod in a tick, less its weight, is what the motor says that it gave: below its bounds, at
/// its largest torque and at its maximum velocity.
TEST(Motor, TheEffortThatIsReadIsTheOneThatMovedTheRod) {
    for (const MotorMode mode : {MotorMode::kPosition, MotorMode::kVelocity, MotorMode::kEffort}) {
        Hinge hinge(12, true, [](AxisSpec& axis) {
            axis.position_gain = 60, axis.velocity_gain = 4, axis.max_velocity = 1.5;
        });
        hinge.q() = 0.3;
        hinge.set(mode, mode == MotorMode::kEffort ? 11 : 1.9);
        const auto& model = hinge.sim->model;
        double fastest = 0, strongest = 0;
        for (int i = 0; i < 2000; ++i) {
            const double weight = -hinge.weight_torque() * std::sin(hinge.q()), before = hinge.v();
            hinge.sim->step();
            const double moved = hinge.inertia() * (hinge.v() - before) / 1e-3 - weight;
            const double read = motor_effort(*model, model->types[0], hinge.sim->states[0], JointId(0u));
            ASSERT_NEAR(read, moved, 1e-4) << "mode " << static_cast<int>(mode) << ", tick " << i;
            strongest = std::max(strongest, std::fabs(read)), fastest = std::max(fastest, hinge.v());
        }
        const bool yields = mode == MotorMode::kVelocity;  // to the weight, with this gain
        EXPECT_GT(fastest, yields ? 0.5 : 1.4999);
        EXPECT_GT(strongest, yields ? 5 : 10.9);
    }
}

/// Pushed beyond its maximum velocity by something else, a servo brakes no more than its damping would.
TEST(Motor, ServoThatIsOverrunBrakesByItsDampingAlone) {
    Hinge hinge(1e3, false, [](AxisSpec& axis) {
        axis.position_gain = 10, axis.velocity_gain = 2, axis.max_velocity = 0.5;
    });
    hinge.set(MotorMode::kPosition, 3);
    hinge.sim->states[0].v[0] = 2;
    hinge.sim->step();
    const double damping = 10 * 1e-3 + 2;
    EXPECT_NEAR((2 - hinge.v()) * hinge.inertia() / (1e-3 * damping * (hinge.v() - 0.5)), 1, 1e-9);
}

TEST(Motor, ServoThatIsOverrunFarKeepsItsBound) {
    for (const double displacement : {1.0, -1.0}) {
        Hinge hinge(1.5, false, [](AxisSpec& axis) {
            axis.position_gain = 10, axis.velocity_gain = 2, axis.max_velocity = 0.5;
        });
        hinge.set(MotorMode::kPosition, 3 * displacement);
        hinge.sim->states[0].v[0] = 20 * displacement;
        hinge.sim->step();
        EXPECT_NEAR((20 - hinge.v() * displacement) * hinge.inertia() / 1.5e-3, 1, 1e-9);
    }
}

TEST(Motor, PositionMotorKeepsTheAxisMaximumVelocity) {
    Hinge hinge(20, false, [](AxisSpec& axis) { axis.max_velocity = 0.5; });
    hinge.set(MotorMode::kPosition, 1.2);
    double fastest = 0;
    for (int i = 0; i < 4000; ++i) {
        hinge.sim->step();
        fastest = std::fmax(fastest, std::fabs(hinge.v()));
    }
    EXPECT_LT(fastest, 0.5 + 1e-6);
    EXPECT_NEAR(hinge.q(), 1.2, 1e-7);
}

TEST(Motor, EffortMotorGivesItsForceUpToItsBound) {
    for (const double effort : {0.8, -0.8, 5.0}) {
        Hinge hinge(1.5);
        hinge.set(MotorMode::kEffort, effort);
        hinge.sim->run(0.2);
        const double expected = std::fmin(effort, 1.5) * 0.2 / hinge.inertia();
        EXPECT_NEAR(hinge.v() / expected, 1, 1e-9);
    }
}

TEST(Motor, EffortMotorsAndServosTurnTheWheelsOfARobotInTheAir) {
    for (const bool servo : {false, true}) {
        World world = empty_world(2e-3, {0, 0, -9.81});
        ModelSpec model = car();
        AxisSpec& axis = model.joints[0].axes[0];
        if (servo) axis.position_gain = 0.02, axis.velocity_gain = 1e-6;
        place(world, model, "car", {{0, 0, 100}, {}});
        Simulation sim(world);
        const Dof& wheel = sim.type(0).dofs[0];
        sim.set_motor(0, 0, servo ? MotorMode::kPosition : MotorMode::kEffort,
                      servo ? 5 : 0.1);  // rad or N m
        sim.run(0.05);
        EXPECT_NEAR(sim.states[0].v[6] / (0.1 * wheel.inverse_inertia * 0.05), 1, servo ? 0.3 : 0.02)
            << servo;
    }
}

TEST(Motor, EffortMotorStopsPushingAtTheAxisMaximumVelocity) {
    Hinge hinge(1.5, false, [](AxisSpec& axis) { axis.max_velocity = 0.6; });
    hinge.set(MotorMode::kEffort, 1.0);
    hinge.sim->run(2);
    EXPECT_NEAR(hinge.v(), 0.6, 1e-9);
}

TEST(Motor, UnlimitedMotorReachesItsTargetInOneTick) {
    Hinge hinge(-1);
    hinge.set(MotorMode::kVelocity, 2);
    hinge.sim->step();
    EXPECT_NEAR(hinge.v(), 2, 1e-5);
    hinge.sim->step();
    EXPECT_NEAR(hinge.v(), 2, 1e-11);
}

TEST(Motor, DrivenArmDoesNoWorkOnItsOtherJoints) {
    World world = empty_world(1e-3, {});
    place(world, arm(), "arm");
    Simulation sim(world);
    for (std::size_t d : {1u, 2u}) sim.set_motor(0, d, MotorMode::kVelocity, 0);
    sim.set_motor(0, 0, MotorMode::kVelocity, 1.0);
    sim.states[0].q[8] = 1.0;
    sim.run(3);
    EXPECT_NEAR(sim.states[0].v[0], 1.0, 1e-6);
    EXPECT_NEAR(sim.states[0].q[8], 1.0, 1e-6) << "held by its motor";
}

}  // namespace
}  // namespace roboss::test
