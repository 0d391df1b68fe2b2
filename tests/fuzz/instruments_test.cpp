// The instruments of the property tests themselves: sums against closed forms, swept distance against known
// passes, generators that make every kind of joint. That the energy of random mechanisms stays as the step
// shrinks shows that sums and dynamics mean the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include <support/mechanical_sums.h>
#include <support/robots.h>

#include "fuzz/energy_gauge.h"
#include "fuzz/property.h"
#include "fuzz/shot.h"
#include "fuzz/swept.h"

namespace roboss::fuzz {
namespace {

struct Still {
    explicit Still(ModelSpec spec, const Vec3& gravity = {}, const Pose& X_WM = {}) {
        World world = test::empty_world(1e-3, gravity);
        test::place(world, std::move(spec), "robot", X_WM);
        model = compile_scene(world);
        states = {initial_state(*model, RobotId(std::size_t{0}))};
    }
    test::MechanicalSums sums() const { return test::MechanicalSummer(*model)(states); }
    std::vector<double>& q() { return states[0].q; }
    std::vector<double>& v() { return states[0].v; }
    std::shared_ptr<const Model> model;
    std::vector<RobotState> states;
};

TEST(MechanicalSums, OfATumblingBoxAreThoseOfTheTextbook) {
    const Vec3 size{0.2, 0.3, 0.5};
    Still still(test::solid_box(2, size, test::surface(0.5)), {0, 0, -9.81},
                {{1, 2, 3}, from_rpy(0, 0, kPi / 2)});
    still.v() = {4, 0, 0, 1, -2, 3};  // about the world's x, which is the box's -y
    const double inertia = 2.0 / 12 * (size.x * size.x + size.z * size.z);
    const test::MechanicalSums sums = still.sums();
    EXPECT_NEAR(sums.kinetic, 0.5 * inertia * 16 + 0.5 * 2 * 14, 1e-12);
    EXPECT_NEAR(sums.potential, 2 * 9.81 * 3, 1e-12);
    EXPECT_LT(norm(sums.linear - Vec3{2, -4, 6}), 1e-12);
    EXPECT_LT(norm(sums.spin() - Vec3{4 * inertia, 0, 0}), 1e-12);
    EXPECT_LT(norm(sums.angular - sums.spin() - cross(Vec3{1, 2, 3}, sums.linear)), 1e-12);
    EXPECT_NEAR(sums.linear_scale, 2 * std::sqrt(14.0), 1e-12);
    EXPECT_NEAR(sums.angular_scale, 4 * inertia, 1e-12);
}

TEST(MechanicalSums, OfAPendulumHoldItsHeightSwingSpringAndRotor) {
    ModelSpec m = test::pendulum(1.5, 0.8);
    m.joints[0].name = "swing";
    m.joints[0].axes[0].spring_stiffness = 3, m.joints[0].axes[0].spring_reference = 0.2;
    m.joints[0].axes[0].armature = 0.07;
    Still still(m, {0, 0, -9.81});
    still.q()[7] = 0.9, still.v()[0] = 5;
    const Mat3 inertia = test::box_inertia(1.5, {0.04, 0.03, 0.8});
    const double about_hinge = inertia(1, 1) + 1.5 * 0.4 * 0.4;
    const test::MechanicalSums sums = still.sums();
    EXPECT_NEAR(sums.kinetic, 0.5 * (about_hinge + 0.07) * 25, 1e-12);
    EXPECT_NEAR(sums.potential, -1.5 * 9.81 * 0.4 * std::cos(0.9), 1e-12);
    EXPECT_NEAR(sums.stored, 0.5 * 3 * 0.7 * 0.7, 1e-12);
    EXPECT_NEAR(norm(sums.angular), about_hinge * 5, 1e-12);
}

TEST(MechanicalSums, OfAScrewHoldItsWayAndItsTurn) {
    ModelSpec m = test::one_link(test::link("nut", 3, Mat3::diagonal(0.1, 0.2, 0.4)));
    m.joints.push_back(test::joint(JointSpecKind::kScrew, "thread", "world", "nut", {}, {0, 0, 1}));
    m.joints[0].screw_pitch = 0.05;
    m.joints[0].axes[0].upper = 1, m.joints[0].axes[0].limit_stiffness = 1e4;
    Still still(m);
    still.v()[0] = 6, still.q()[7] = 1.1;
    EXPECT_NEAR(still.sums().kinetic, 0.5 * (0.4 + 3 * 0.05 * 0.05) * 36, 1e-12);
    EXPECT_NEAR(still.sums().stored, 0.5 * 1e4 * 0.01, 1e-9) << "a soft limit is a spring";
    EXPECT_NEAR(still.sums().linear.z, 3 * 0.05 * 6, 1e-12);
}

TEST(MechanicalSums, OfTwoBallsThatPartAreTheirReducedMass) {
    World world = test::empty_world(1e-3, {});
    test::place(world, test::solid_sphere(1, 0.1, test::surface(0.5)), "a", {{1, 0, 0}, {}});
    test::place(world, test::solid_sphere(3, 0.1, test::surface(0.5)), "b", {{-1, 0, 0}, {}});
    const auto model = compile_scene(world);
    std::vector<RobotState> states{initial_state(*model, RobotId(std::size_t{0})),
                                   initial_state(*model, RobotId(std::size_t{1}))};
    states[0].v[4] = 3, states[1].v[4] = -1;
    const test::MechanicalSums sums = test::MechanicalSummer(*model)(states);
    EXPECT_LT(norm(sums.linear), 1e-12);
    EXPECT_LT(norm(sums.spin() - Vec3{0, 0, 6}), 1e-12) << "reduced mass .75 kg, 2 m apart, 4 m/s";
    EXPECT_LT(norm(sums.centre() - Vec3{-0.5, 0, 0}), 1e-12);
}

/// Forces of rows, loops, springs and gravity agree with the sums: what is left of a growth is the method's
/// error.
TEST(MechanicalSums, OfRandomMechanismsStayOrFallAsTheStepShrinks) {
    for (const char* kind : {"tree", "anchored", "hanging", "loop", "coupled"}) {
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            Request request{{seed, kind, 2e-5, 3}, 0.1};
            EXPECT_LT(run_energy(request).figure, 1e-4) << kind << ", seed " << seed;
        }
    }
}

/// A mass of 1 kg on a spring of 1 N/m, and what a gauge reads of its first revolutions.
struct Oscillator {
    double q = 1, v = 0;
    test::MechanicalSums sums(double at) const {
        test::MechanicalSums sums;
        sums.kinetic = 0.5 * v * v, sums.stored = 0.5 * at * at;
        return sums;
    }
    /// Most growth; `step` moves the oscillator by one tick.
    template <class Step>
    double most_growth(double dt, Step step) {
        constexpr double kTime = 20;
        EnergyGauge gauge(sums(q), false);
        double most = 0;
        for (double t = 0; t < kTime; t += dt) {
            const double before = q;
            step(*this);
            most = std::fmax(most, gauge.read(sums(before), sums(q)));
        }
        return most;
    }
};

/// Semi-implicit Euler keeps v^2 + q^2 - dt q v, so the energy at the end of a tick swings by dt; with the
/// mean of the potential energies before and after the tick it is (v^2 + q^2 - dt q v) / 2 + (dt v / 2)^2.
TEST(EnergyGauge, IsBlindToTheSwingOfSemiImplicitEuler) {
    constexpr double kDt = 0.02;
    const auto step = [](Oscillator& o) { o.v -= kDt * o.q, o.q += kDt * o.v; };
    EXPECT_LT(Oscillator{}.most_growth(kDt, step), 1.01 * kDt * kDt / 2);
    Oscillator swinging;
    EnergyReading at_end(0.5, false);
    double most = 0;
    for (int i = 0; i < 1000; ++i) {
        step(swinging);
        most = std::fmax(most, at_end.read(swinging.sums(swinging.q).energy(), 0, 0.5));
    }
    EXPECT_NEAR(most, kDt, 0.05 * kDt) << "of one reading";
}

/// Explicit Euler multiplies the energy by 1 + dt^2 in each tick.
TEST(EnergyGauge, SeesWhatExplicitEulerAdds) {
    constexpr double kDt = 0.005;
    const auto step = [](Oscillator& o) {
        const double before = o.q;
        o.q += kDt * o.v, o.v -= kDt * before;
    };
    const double gain = std::pow(1 + kDt * kDt, 20 / kDt) - 1;
    EXPECT_NEAR(Oscillator{}.most_growth(kDt, step), gain, 0.1 * gain);
}

/// A jump of the coordinates or of the velocity stays in both readings.
TEST(EnergyGauge, SeesAJump) {
    Oscillator still;
    EnergyGauge gauge(still.sums(1), false);
    EXPECT_EQ(gauge.read(still.sums(1), still.sums(1)), 0);
    EXPECT_NEAR(gauge.read(still.sums(1), still.sums(1.1)), 0.105, 1e-12) << "the mean, in its tick";
    EXPECT_NEAR(gauge.read(still.sums(1.1), still.sums(1.1)), 0.21, 1e-12);
    still.v = 0.1;
    EXPECT_NEAR(gauge.read(still.sums(1.1), still.sums(1.1)), 0.22, 1e-12);
}

double least_gap(const World& world, const Vec3& way) {
    const auto model = compile_scene(world);
    std::vector<RobotState> from{initial_state(*model, RobotId(std::size_t{0}))}, to = from;
    for (std::size_t k = 0; k < 3; ++k) to[0].q[k] += way[k];
    SweptDistance swept(*model, {});
    swept.add_between(from, to, 4);
    return swept.least_gap(-1, 1e-6);
}

TEST(SweptDistance, OfABallPastACornerIsThatOfItsLine) {
    World world = test::empty_world(1e-3, {});
    test::place(world, test::solid_sphere(1, 0.1, test::surface(0.5)), "ball",
                {{0.5 + 0.13, 0.5 + 0.14, -10}, {}});
    test::place(world, test::scenery(test::box_shape({1, 1, 1}, test::surface(0.5))), "box");
    const double corner = std::hypot(0.13, 0.14) - 0.1;
    EXPECT_NEAR(least_gap(world, {0, 0, 20}), corner, 2e-6) << "beside the edge for a metre of twenty";
    EXPECT_NEAR(least_gap(world, {0, 0, 9}), std::sqrt(0.13 * 0.13 + 0.14 * 0.14 + 0.5 * 0.5) - 0.1, 2e-6);
    EXPECT_LT(least_gap(world, {-1.26, -1.28, 20}), -0.5) << "through its middle";
}

TEST(SweptDistance, OfATurningRodIsThatOfItsTip) {
    World world = test::empty_world(1e-3, {});
    test::place(world, test::solid_box(1, {2, 0.01, 0.01}, test::surface(0.5)), "rod");
    test::place(world, test::scenery(test::sphere_shape(0.2, test::surface(0.5))), "ball", {{0, 1.3, 0}, {}});
    const auto model = compile_scene(world);
    std::vector<RobotState> from{initial_state(*model, RobotId(std::size_t{0}))}, to = from;
    const Quat turned = from_rpy(0, 0, 0.9 * kPi);
    to[0].q[3] = turned.w, to[0].q[4] = turned.x, to[0].q[5] = turned.y, to[0].q[6] = turned.z;
    SweptDistance swept(*model, {});
    swept.add_between(from, to, 64);
    const double upright = 1.3 - 0.2 - 1.0;
    EXPECT_NEAR(swept.least_gap(-1, 1e-6), upright, 1e-4) << "the rod stands upright in between only";
    EXPECT_NEAR(swept.least_width(), 0.01, 1e-12);
}

TEST(Generators, MakeEveryKindOfJointAndEveryForce) {
    std::set<JointSpecKind> kinds;
    int limits = 0, soft = 0, damping = 0, friction = 0, springs = 0, rotors = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed);
        for (const JointSpec& j : random_tree(random, {}).joints) {
            kinds.insert(j.kind);
            for (const AxisSpec& axis : j.axes) {
                limits += axis.has_limits(), soft += axis.limit_stiffness<1e8, damping += axis.damping> 0;
                friction += axis.friction > 0, springs += axis.spring_stiffness > 0,
                    rotors += axis.armature > 0;
            }
        }
    }
    EXPECT_EQ(kinds.size(), 6u);
    for (const int count : {limits, soft, damping, friction, springs, rotors}) EXPECT_GT(count, 20);
}

TEST(Generators, MakeLoopsThatMoveAndCouplingsThatHold) {
    int loops = 0, couplings = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (const char* kind : {"loop", "coupled"}) {
            const Start start = make_start({seed, kind, 1e-3, 10});
            const RobotType& type = start.model->types.at(0);
            loops += static_cast<int>(type.loops.size()),
                couplings += static_cast<int>(type.couplings.size());
            double fastest = 0;
            for (std::size_t k = 6; k < start.states[0].v.size(); ++k)
                fastest = std::fmax(fastest, std::fabs(start.states[0].v[k]));
            EXPECT_GT(fastest, 1e-3) << kind << ", seed " << seed;
        }
    }
    EXPECT_EQ(loops, 40);
    EXPECT_EQ(couplings, 40);
}

TEST(Generators, MakeTheSameWorldOfASeedEachTime) {
    for (const SceneKind& kind : scene_kinds()) {
        const Start a = make_start({5, kind.name, 2e-3, 30}), b = make_start({5, kind.name, 2e-3, 30});
        const Start c = make_start({6, kind.name, 2e-3, 30});
        EXPECT_EQ(a.model->hash, b.model->hash) << kind.name;
        EXPECT_EQ(a.states, b.states) << kind.name;
        EXPECT_NE(a.model->hash, c.model->hash) << kind.name;
    }
}

TEST(Properties, TakeEveryCombinationInTurn) {
    for (const Property& p : properties()) {
        const std::size_t all = p.kinds.size() * p.steps_s.size() * p.spins.size() * p.speeds.size();
        std::set<std::tuple<std::string, double, double, double>> seen;
        for (std::uint64_t seed = 1000; seed < 1000 + all; ++seed) {
            const Setting s = p.setting(seed);
            seen.insert({s.kind, s.dt_s, s.spin, s.speed});
        }
        EXPECT_EQ(seen.size(), all) << p.name;
    }
}

/// A shot far from anything, and one straight at it: the properties tell them apart.
TEST(Properties, CountNoPassAsAHitAndNoHitAsAPass) {
    int hits = 0, passes = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Flight flight({seed, "ball-box", 1e-3, 0, 2});
        SweptDistance swept(flight.model(), flight.shot().stand_ins);
        double least = std::numeric_limits<double>::infinity(), change = 0;
        while (!flight.over()) {
            flight.step();
            swept.clear();
            for (const std::vector<RobotState>& states : flight.fine_way()) swept.add(states);
            if (change == 0) least = std::fmin(least, swept.least_gap(-1, 1e-5));
            change = std::fmax(change, flight.change());
        }
        if (least > 5e-3) {
            ++passes;
            EXPECT_EQ(change, 0) << "seed " << seed;
        }
        if (least < -1e-4) {
            ++hits;
            EXPECT_GT(change, 0) << "seed " << seed;
        }
    }
    EXPECT_GT(hits, 10);
    EXPECT_GT(passes, 10);
}

}  // namespace
}  // namespace roboss::fuzz
