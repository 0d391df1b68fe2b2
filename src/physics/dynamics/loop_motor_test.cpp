// Loops, gearboxes and mimic joints that something drives, so that the contact island's solver moves them:
// loops stay closed for a minute, motors keep their words, joints that close a loop have all that others
// have.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

World with(const ModelSpec& model, double dt_s = 1e-3, const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(dt_s, gravity);
    place(world, model, "robot", {{0, 0, 1}, {}});
    return world;
}

std::size_t motor_of(const Simulation& sim, const std::string& joint) {
    const RobotType& type = sim.type(0);
    return type.motor_index(type.joints[type.find_joint(joint)->index()], 0);
}

void drive(Simulation& sim, const std::string& joint, MotorMode mode, double target,
           double max_effort = 1e3) {
    sim.states[0].motors[motor_of(sim, joint)] = {mode, target, max_effort};
}

JointState reading(const Simulation& sim, const std::string& joint, int axis = 0) {
    return joint_state(sim.type(0), sim.states[0], *sim.type(0).find_joint(joint), axis);
}

/// Distance of the rocker's end from the coupler's, from poses of links.
double gap(const Simulation& sim) {
    const RobotType& type = sim.type(0);
    const auto end = [&](const char* name) {
        const LinkSpec& spec = sim.world.prototypes[0].links[name[0] == 'c' ? 1 : 2];
        return link_pose(type, sim.states[0], *type.find_link(name)) * (spec.p_LC * 2.0);
    };
    return norm(end("coupler") - end("rocker"));
}

TEST(DrivenLoop, FourBarStaysClosedForAMinute) {
    for (const double dt : {1e-3, 2e-3}) {
        Simulation sim(with(four_bar(), dt));
        drive(sim, "crank", MotorMode::kVelocity, 10);
        double open = 0;
        while (sim.time() < 60) {
            sim.step();
            open = std::fmax(open, gap(sim));
        }
        tell("largest gap in 60 s, m, at a tick of ms " + std::to_string(dt * 1e3), open);
        EXPECT_LT(open, 1e-6);
        EXPECT_NEAR(sim.states[0].v[0], 10, 1e-3) << "as hard as the solver's rows are";
        EXPECT_NEAR(sim.states[0].q[7], 600, 1.0) << "it went around and around";
    }
}

/// Rows that hold in the middle of two ticks do no work; what is left is the first-order error that every
/// driven tree has. Rows that held at the start or the end of a tick would lose or win three times as much.
TEST(DrivenLoop, AMotorWithoutForceLeavesALoopAsFreeAsNone) {
    double worst[2];
    for (int i = 0; i < 2; ++i) {
        Simulation sim(with(four_bar(), i == 0 ? 2e-3 : 1e-3, {}));
        drive(sim, "rocker", MotorMode::kEffort, 0, 1);
        sim.states[0].v = {8, 0, 0};
        sim.step();
        const double energy = sim.energy();
        worst[i] = 0;
        while (sim.time() < 5) {
            sim.step();
            worst[i] = std::fmax(worst[i], std::fabs(sim.energy() / energy - 1));
        }
    }
    tell("worst relative energy error in 5 s at a tick of 1 ms", worst[1]);
    EXPECT_LT(worst[1], 1e-9);
    EXPECT_GT(worst[0] / worst[1], 16) << "it falls with a high power of the tick";
}

TEST(DrivenLoop, ParallelogramPassesItsFlatPoses) {
    for (const bool driven : {true, false}) {
        Simulation sim(with(parallelogram(), 1e-3, {}));
        if (driven) drive(sim, "crank", MotorMode::kVelocity, 7);
        if (!driven) sim.states[0].v = {7, -7, 7};
        double open = 0, fastest = 0;
        while (sim.time() < 10) {
            sim.step();
            open = std::fmax(open, gap(sim));
            fastest = std::fmax(fastest, std::fabs(sim.states[0].v[2]));
        }
        tell("largest gap, m", open);
        tell("fastest turn of the rocker, rad/s", fastest);
        EXPECT_LT(open, 1e-6);
        EXPECT_LT(fastest, 100);
        EXPECT_GT(std::fabs(sim.states[0].q[7]), 6.0) << "it went around";
    }
}

/// The hinge that closes the loop turns as its own motor says, and its reading tells so.
TEST(DrivenLoop, JointThatClosesTheLoopHasAMotor) {
    Simulation sim(with(four_bar(), 1e-3, {}));
    ASSERT_EQ(motor_of(sim, "closing"), 3u);
    drive(sim, "closing", MotorMode::kVelocity, 0.5);
    sim.run(1);
    tell("angle of the closing hinge after 1 s at .5 rad/s", reading(sim, "closing").position);
    EXPECT_NEAR(reading(sim, "closing").position, 0.5, 1e-3);
    EXPECT_LT(gap(sim), 1e-12);
    drive(sim, "closing", MotorMode::kPosition, 0.3, 5);
    sim.run(3);
    EXPECT_NEAR(reading(sim, "closing").position, 0.3, 1e-6);
    EXPECT_NEAR(reading(sim, "closing").velocity, 0, 1e-6);
}

/// Angles about parallel axes of a closed chain add up to nothing.
TEST(DrivenLoop, ReadingOfTheClosingHingeIsWhatTheOthersLeave) {
    Simulation sim(with(four_bar()));
    drive(sim, "crank", MotorMode::kVelocity, 3);
    for (int i = 0; i < 20; ++i) {
        sim.run(0.1);
        const double sum = reading(sim, "crank").position + reading(sim, "elbow").position -
                           reading(sim, "rocker").position - reading(sim, "closing").position;
        EXPECT_NEAR(wrap_angle(sum), 0, 1e-9);
    }
}

TEST(DrivenLoop, LimitAndFrictionOfTheClosingHingeHold) {
    ModelSpec m = four_bar();
    for (std::size_t j = 0; j < 3; ++j) m.joints[j].axes[0].friction = 1e-6;  // keeps them in the tree
    m.joints[3].axes[0].upper = 0.2, m.joints[3].axes[0].friction = 1e-7;
    for (std::size_t j = 0; j < 3; ++j) m.joints[j].axes[0].upper = 9, m.joints[j].axes[0].damping = 1e-9;
    Simulation limited(with(m, 1e-3, {}));
    ASSERT_EQ(motor_of(limited, "closing"), 3u);
    drive(limited, "closing", MotorMode::kEffort, 0.5, 0.5);
    limited.run(3);
    EXPECT_NEAR(reading(limited, "closing").position, 0.2, 1e-5);
    m.joints[3].axes[0].friction = 0.6;
    Simulation held(with(m, 1e-3, {}));
    drive(held, "closing", MotorMode::kEffort, 0.5, 0.5);
    held.run(3);
    EXPECT_NEAR(reading(held, "closing").position, 0, 1e-6);
}

/// The same linkage with another joint cut moves the same: spring and damping of the cut joint act as they do
/// in the tree.
TEST(DrivenLoop, WhichJointIsCutMakesNoDifference) {
    const auto run = [](bool swap) {
        ModelSpec m = four_bar();
        for (JointSpec& j : m.joints) {
            j.axes[0].damping = 0.05;
            j.axes[0].spring_stiffness = 2, j.axes[0].spring_reference = 0.1;
        }
        if (swap) std::swap(m.joints[0], m.joints[3]);
        Simulation sim(with(m, 2e-4));
        EXPECT_EQ(motor_of(sim, swap ? "crank" : "closing"), 3u);
        drive(sim, "elbow", MotorMode::kEffort, 0.3, 1);
        sim.run(0.5);
        return link_pose(sim.type(0), sim.states[0], *sim.type(0).find_link("coupler"));
    };
    const Transform a = run(false), b = run(true);
    tell("distance after .5 s", norm(a.p - b.p));
    EXPECT_LT(norm(a.p - b.p), 1e-6);
    EXPECT_GT(norm(a.p - Vec3{0, 0, 1.2}), 0.01) << "it does move";
}

/// A motor of the large wheel holds a torque at the small one that is its own divided by the ratio.
TEST(DrivenGearbox, StallsAtItsForceTimesTheRatio) {
    const double ratio = 2.5, force = 0.8;
    for (const double part : {0.999, 1.001}) {
        Simulation sim(with(geared_wheels(ratio), 1e-3, {}));
        sim.states[0].motors[0] = {MotorMode::kVelocity, 0, force};
        sim.states[0].motors[1] = {MotorMode::kEffort, force / ratio * part, 10};
        sim.run(2);
        if (part < 1) {
            EXPECT_NEAR(sim.states[0].v[0], 0, 1e-5);
        } else {
            const double torque = force - ratio * force / ratio * part;  // at the small wheel
            EXPECT_NEAR(sim.states[0].v[0] / (2 * torque / (0.02 + 0.05 * ratio * ratio)), 1, 1e-4);
        }
        EXPECT_NEAR(sim.states[0].q[8], -ratio * sim.states[0].q[7], 1e-12);
    }
}

TEST(DrivenMimic, FollowerGoesAlongAndLoadsTheLeader) {
    ModelSpec m = two_wheels(true);
    m.joints[1].axes[0].mimic = MimicSpec{"small", 0, 0.5, 0, 0, {}};
    Simulation sim(with(m, 1e-3, {}));
    sim.states[0].motors[0] = {MotorMode::kPosition, 1.2, 5};
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[7], 1.2, 1e-6);
    EXPECT_NEAR(sim.states[0].q[8], 0.6, 1e-6);
    EXPECT_LT(norm(sim.momentum().angular), 1e-4) << "the frame turns against both";
}

/// A platform driven by its six struts follows: each strut is as long as ordered.
TEST(DrivenLoop, StewartPlatformIsLiftedByItsStruts) {
    ModelSpec m = stewart();
    Simulation sim(with(m));
    for (int i = 0; i < 6; ++i) drive(sim, "strut_" + std::to_string(i), MotorMode::kPosition, 0.05, 500);
    sim.run(2);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(reading(sim, "strut_" + std::to_string(i)).position, 0.05, 1e-5);
    const Transform X = link_pose(sim.type(0), sim.states[0], LinkId(std::size_t{0}));
    tell("height of the platform", X.p.z - 1);
    const Vec3 foot = m.joints[0].X_MJ.p, head = m.joints[2].X_MJ.p;
    const double across = std::hypot(head.x - foot.x, head.y - foot.y), length = norm(head - foot) + 0.05;
    EXPECT_NEAR(X.p.z - 1, std::sqrt(length * length - across * across), 1e-4);
    EXPECT_NEAR(std::hypot(X.p.x, X.p.y), 0, 1e-4);
}

}  // namespace
}  // namespace roboss::test
