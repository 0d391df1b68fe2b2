// Own numbers of joints: a robot that has them moves as one whose file has them, bit for bit; and as closed
// forms say.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include <support/mechanisms.h>
#include <support/own_numbers.h>
#include <support/robots.h>

#include "model/order.h"
#include "physics/dynamics/motor_effort.h"

namespace roboss::test {
namespace {

using Values = std::vector<JointParameterValue>;
using enum JointParameter;

/// Gives axis `axis` of a joint of a robot these numbers, at once.
void set_numbers(Simulation& sim, std::size_t robot, JointId joint, int axis, Values values) {
    give(sim, robot, SetJointParameters{joint, axis, false, std::move(values)});
}

/// Numbers of some axis, other ones for each `which`.
Values some_numbers(std::size_t which, bool has_position) {
    const double x = 1 + 0.3 * static_cast<double>(which % 5);
    Values values{{kDamping, 0.05 * x},
                  {kFriction, which % 3 == 0 ? 0.02 * x : 0},
                  {kMaxEffort, 3 * x},
                  {kMaxVelocity, 6 * x},
                  {kVelocityGain, which % 4 == 1 ? 0.4 * x : 0}};
    if (!has_position) return values;
    const Values more{{kLower, -0.9 * x},
                      {kUpper, 0.7 * x},
                      {kSpringStiffness, 2 * x},
                      {kSpringReference, 0.1 * x},
                      {kPositionGain, which % 4 == 1 ? 30 * x : 0},
                      {kLimitStiffness, 500 * x},
                      {kLimitDissipation, 0.5 * x}};
    values.insert(values.end(), more.begin(), more.end());
    return values;
}

/// The same in a file.
void write(const Values& values, AxisSpec& axis) {
    for (const JointParameterValue& one : values) switch (one.parameter) {
            case kLower:
                axis.lower = one.value;
                break;
            case kUpper:
                axis.upper = one.value;
                break;
            case kMaxEffort:
                axis.max_effort = one.value;
                break;
            case kMaxVelocity:
                axis.max_velocity = one.value;
                break;
            case kDamping:
                axis.damping = one.value;
                break;
            case kFriction:
                axis.friction = one.value;
                break;
            case kSpringStiffness:
                axis.spring_stiffness = one.value;
                break;
            case kSpringReference:
                axis.spring_reference = one.value;
                break;
            case kArmature:
                axis.armature = one.value;
                break;
            case kPositionGain:
                axis.position_gain = one.value;
                break;
            case kVelocityGain:
                axis.velocity_gain = one.value;
                break;
            case kLimitStiffness:
                axis.limit_stiffness = one.value;
                break;
            case kLimitDissipation:
                axis.limit_dissipation = one.value;
                break;
        }
}

/// Some robots of a model in a world, and how they are driven.
struct Scene {
    std::string name;
    ModelSpec model;
    double height = 0;
    bool sleeps = false;
    bool has_loops = false;  // their joints have no rotors
};

std::vector<Scene> scenes() {
    ModelSpec closed =
        four_bar();  // which joint its loop is cut at hangs on the numbers that its joints have
    for (std::size_t j = 0; j < closed.joints.size(); ++j) {
        Values others = some_numbers(j, true);
        for (JointParameterValue& one : others) one.value *= 1.5;
        write(others, closed.joints[j].axes[0]);
    }
    return {{"spiders", with_balls(spider(), 0.02), 0.0},
            {"arms", arm(), 2.0},
            {"cars", car(), 0.001},
            {"slides", prismatic_chain(), 1.0},
            {"a tree of all joints", mixed_tree(), 0.5},
            {"four bars", closed, 0.5, false, true},
            {"gears", geared_wheels(-2.5), 0.5},
            {"arms that sleep", arm(), 2.0, true}};
}

/// Drives every second motor, of what has one, to and fro.
void drive(Simulation& sim) {
    if (sim.tick % 50 != 0) return;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t d = 0; d < sim.states[r].motors.size(); d += 2) {
            const RobotType& type = sim.type(r);
            const std::vector<Dof>& axes = type_of(type, sim.states[r]).dofs;
            const bool in_tree = d < axes.size();
            const double most =
                in_tree ? axes[d].max_effort : type_of(type, sim.states[r]).loops[0].dofs[0].max_effort;
            const bool places = in_tree && type.bodies[static_cast<std::size_t>(axes[d].body)].nv == 1;
            const MotorMode mode = places && d % 4 == 0 ? MotorMode::kPosition : MotorMode::kVelocity;
            const double target = (sim.tick / 50 + static_cast<Tick>(d)) % 2 == 0 ? 0.3 : -0.2;
            sim.states[r].motors[d] = {mode, target, std::min(most, 50.0)};
        }
}

Values numbers_with_rotor(std::size_t which, const Scene& scene) {
    Values values = some_numbers(which, true);
    if (!scene.has_loops) values.push_back({kArmature, 0.002 * static_cast<double>(1 + which % 3)});
    return values;
}

/// Steps one world whose file has the numbers, and one whose robots were given them.
void expect_equal_runs(const Scene& scene, Precision precision) {
    SCOPED_TRACE(scene.name + (precision == Precision::kFloat ? ", floats" : ""));
    ModelSpec written = scene.model;
    std::size_t which = 0;
    for (JointSpec& joint : written.joints)
        for (AxisSpec& axis : joint.axes)
            if (!joint_type(joint.kind).couples) write(numbers_with_rotor(which++, scene), axis);
    World in_file = scattered(written, 5, scene.height), given = scattered(scene.model, 5, scene.height);
    in_file.precision = given.precision = precision;
    in_file.sleep = given.sleep = scene.sleeps;
    Simulation a(in_file), b(given);
    for (std::size_t r = 0; r < b.states.size(); ++r) {
        which = 0;
        for (const JointSpec& joint : written.joints)
            for (std::size_t k = 0; k < joint.axes.size(); ++k)
                if (!joint_type(joint.kind).couples)
                    set_numbers(b, r, *b.type(r).find_joint(joint.name), static_cast<int>(k),
                                numbers_with_rotor(which++, scene));
    }
    expect_equal_steps(a, b, drive, 250);
}

TEST(OwnNumbers, MoveARobotAsAFileWithTheseNumbersDoes) {
    for (const Scene& scene : scenes()) expect_equal_runs(scene, Precision::kDouble);
}

TEST(OwnNumbers, MoveARobotSteppedInFloatsAsAFileWithTheseNumbersDoes) {
    for (const Scene& scene : {scenes()[0], scenes()[1], scenes()[2]})
        expect_equal_runs(scene, Precision::kFloat);
}

TEST(OwnNumbers, OfSomeRobotsLeaveTheBitsOfAllToNoLane) {
    const Drive some_differ = [](Simulation& sim) {
        drive(sim);
        if (sim.tick % 60 != 7) return;
        for (std::size_t r = 0; r < sim.states.size(); ++r)  // some equal, some their own, some of the type
            for (std::size_t j = 0; r % 3 != 0 && j < sim.type(r).joints.size(); ++j)
                set_numbers(sim, r, JointId(j), 0, some_numbers(r % 3 == 1 ? j : j + r, true));
    };
    compare(scattered(with_balls(spider(), 0.02), 13, 0.0), some_differ, 200);
}

TEST(OwnNumbers, ThatAreTheTypesAgainLeaveNoTrace) {
    Simulation plain(scattered(arm(), 2, 2.0)), changed(scattered(arm(), 2, 2.0));
    const JointId joint(2u);
    set_numbers(changed, 1, joint, 0, {{kDamping, 3}, {kArmature, 0.2}});
    EXPECT_NE(changed.hash(), plain.hash());
    set_numbers(changed, 1, joint, 0, {{kDamping, 0}});
    set_numbers(changed, 1, joint, 0, {{kArmature, 0}});
    EXPECT_EQ(changed.hash(), plain.hash());
    for (int i = 0; i < 50; ++i) plain.step(), changed.step();
    EXPECT_EQ(changed.hash(), plain.hash());
}

/// A rod on a hinge, without gravity.
struct Rod {
    explicit Rod(double dt = 1e-3, double gravity = 0) {
        World world = empty_world(dt, {0, 0, -gravity});
        place(world, pendulum(2.0, 0.8), "rod");
        sim = std::make_unique<Simulation>(world);
        const LinkSpec& rod = sim->world.prototypes[0].links[0];
        inertia = rod.inertia_C(1, 1) + rod.mass * norm_squared(rod.p_LC);
    }
    void set(Values values) { set_numbers(*sim, 0, JointId(0u), 0, std::move(values)); }
    void drive(MotorMode mode, double target) {
        const Order order{sim->tick, ClientId(0u), 0, sim->ids[0],
                          SetJoint{JointId(0u), 0, mode, target, -1}};
        apply_order(*sim->model, order, sim->states[0]);
    }
    double& q() { return sim->states[0].q[7]; }
    double& v() { return sim->states[0].v[0]; }

    std::unique_ptr<Simulation> sim;
    double inertia = 0;
};

TEST(OwnNumbers, ASpringSwingsTheRodWithItsFrequency) {
    for (const double stiffness : {5.0, 20.0}) {
        Rod rod;
        rod.set({{kSpringStiffness, stiffness}, {kSpringReference, 0.2}});
        rod.q() = 0.5;
        rod.sim->run(1.3);
        const double phase = std::sqrt(stiffness / rod.inertia) * 1.3;
        EXPECT_NEAR(rod.q(), 0.2 + 0.3 * std::cos(phase), 1e-6) << stiffness;
    }
}

TEST(OwnNumbers, DampingStopsTheRodExponentially) {
    Rod rod;
    rod.v() = 2;
    rod.sim->run(0.5);
    EXPECT_NEAR(rod.v(), 2, 1e-9) << "no damping in the file";
    rod.set({{kDamping, 0.3}});
    rod.sim->run(1);
    EXPECT_NEAR(rod.v(), 2 * std::exp(-0.3 / rod.inertia), 1e-8);
}

TEST(OwnNumbers, ARotorInertiaAddsToTheRods) {
    for (const double armature : {0.0, 0.4}) {
        Rod rod;
        rod.set({{kArmature, armature}, {kMaxEffort, 1.5}});
        rod.drive(MotorMode::kEffort, 9);
        rod.sim->run(0.2);
        EXPECT_NEAR(rod.v(), 1.5 * 0.2 / (rod.inertia + armature), 1e-7) << armature;
    }
}

TEST(OwnNumbers, FrictionHoldsUpToItsBound) {
    Rod rod;
    rod.set({{kFriction, 0.8}});
    rod.drive(MotorMode::kEffort, 0.79);
    rod.sim->run(1);
    EXPECT_NEAR(rod.q(), 0, 1e-5);
    rod.drive(MotorMode::kEffort, 1.0);
    rod.sim->run(0.5);
    EXPECT_NEAR(rod.v(), (1.0 - 0.8) * 0.5 / rod.inertia, 1e-4);
}

TEST(OwnNumbers, LimitsThatWereMovedStopTheRodThere) {
    Rod rod;
    rod.set({{kLower, -0.25}, {kUpper, 0.4}});
    for (const double speed : {1.0, -1.0}) {
        rod.v() = speed;
        rod.sim->run(1);
        EXPECT_NEAR(rod.q(), speed > 0 ? 0.4 : -0.25, 1e-4);
        EXPECT_NEAR(rod.v(), 0, 1e-9);
    }
}

/// kp and kd of a motor that goes to 1 rad; the closed form of m q'' = kp (1 - q) - kd q'.
double step_response(double kp, double kd, double inertia, double t) {
    const double rate = kd / (2 * inertia), square = kp / inertia - rate * rate;
    if (square > 0) {
        const double turn = std::sqrt(square);
        return 1 - std::exp(-rate * t) * (std::cos(turn * t) + rate / turn * std::sin(turn * t));
    }
    const double fall = std::sqrt(-square);
    return 1 - std::exp(-rate * t) * (std::cosh(fall * t) + rate / fall * std::sinh(fall * t));
}

TEST(OwnNumbers, GainsGiveTheStepResponseOfAPdMotor) {
    for (const auto& [kp, kd] : {std::pair{20.0, 1.0}, std::pair{20.0, 6.0}, std::pair{20.0, 20.0}}) {
        double error[2];
        for (const int fine : {0, 1}) {
            Rod rod(fine == 0 ? 1e-3 : 5e-4);
            rod.set({{kPositionGain, kp}, {kVelocityGain, kd}});
            rod.drive(MotorMode::kPosition, 1);
            error[fine] = 0;
            for (int i = 0; i < (fine == 0 ? 2000 : 4000); ++i) {
                rod.sim->step();
                const double wanted = step_response(kp, kd, rod.inertia, rod.sim->time());
                error[fine] = std::max(error[fine], std::fabs(rod.q() - wanted));
            }
        }
        EXPECT_LT(error[0], 0.02) << kp << " " << kd;
        EXPECT_NEAR(error[0] / error[1], 2, 0.2) << "of first order in the tick";
    }
}

/// Implicit Euler without damping passes the target by J / (kp dt^2) once, and then loses the square root of
/// that share in each tick; with damping it comes from one side.
TEST(OwnNumbers, AGainFarBeyondTheTickNeitherExplodesNorRings) {
    for (const double kd : {0.0, 1e3, 1e6}) {
        Rod rod(1e-2);
        rod.set({{kPositionGain, 1e6}, {kVelocityGain, kd}});
        rod.drive(MotorMode::kPosition, 1);
        const double share = rod.inertia / (1e6 * 1e-4);
        double highest = 0;
        for (int i = 0; i < 1000; ++i) {
            rod.sim->step();
            highest = std::max(highest, rod.q());
            if (kd == 0 && i >= 6) {
                ASSERT_NEAR(rod.q(), 1, 1e-6) << "tick " << i;
            }
        }
        EXPECT_LT(highest - 1, kd == 0 ? share : 0.1 * share) << kd;
        EXPECT_NEAR(rod.q(), 1, 1e-4) << kd;
    }
}

TEST(OwnNumbers, TheMotorsEffortIsReadByThem) {
    Rod rod(1e-3, 9.81);
    rod.set({{kPositionGain, 100}, {kVelocityGain, 10}});
    rod.drive(MotorMode::kPosition, -kPi / 2);
    rod.sim->run(10);
    const double sag = rod.q() + kPi / 2, torque = 2 * 9.81 * 0.4 * std::cos(sag);
    EXPECT_GT(sag, 0.01);
    EXPECT_NEAR(motor_effort(*rod.sim->model, rod.sim->type(0), rod.sim->states[0], JointId(0u)), -torque,
                1e-3);
    EXPECT_NEAR(100 * sag, torque, 1e-3);
}

TEST(OwnNumbers, ABoundOfEffortAlsoBoundsOrdersBeforeIt) {
    Rod rod;
    rod.drive(MotorMode::kVelocity, 100);
    rod.set({{kMaxEffort, 0.5}});
    EXPECT_EQ(rod.sim->states[0].motors[0].max_effort, 0.5);
    rod.sim->run(0.1);
    EXPECT_NEAR(rod.v(), 0.5 * 0.1 / rod.inertia, 1e-9);
    rod.set({{kMaxEffort, 2}});
    EXPECT_EQ(rod.sim->states[0].motors[0].max_effort, 2) << "it had all of the axis";
}

}  // namespace
}  // namespace roboss::test
