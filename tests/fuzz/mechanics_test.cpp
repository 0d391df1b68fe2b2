// Mechanics that random worlds cannot judge by a bound on each alone: what holds against centrifugal force
// holds, motion runs backwards, and dissipation does not depend on the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <support/bodies.h>
#include <support/mechanical_sums.h>
#include <support/simulation.h>

#include "fuzz/scene.h"

namespace roboss::fuzz {
namespace {

/// Two masses on a slide along x, free in space. The slide's upper limit is where it starts.
ModelSpec rotor() {
    ModelSpec m;
    m.name = "rotor";
    m.canonical_link = "hub";
    m.links = {test::link("hub", 2, test::box_inertia(2, {0.2, 0.1, 0.1})),
               test::link("weight", 1, test::box_inertia(1, {0.1, 0.1, 0.1}), {{0.5, 0, 0}, {}})};
    m.joints = {
        test::joint(JointSpecKind::kPrismatic, "slide", "hub", "weight", {{0.5, 0, 0}, {}}, {1, 0, 0})};
    return m;
}

/// Spun about z with the common centre at rest.
void spin(test::Simulation& sim, double rate) {
    sim.states[0].v[2] = rate;
    sim.states[0].v[4] = -rate * 0.5 / 3;
}

struct Held {
    double energy = 0, way = 0, speed = 0;  // largest: relative change; m; m/s
};

Held hold(test::Simulation& sim, double seconds) {
    test::MechanicalSummer summer(*sim.model);
    const double start = summer(sim.states).energy();
    Held held;
    while (sim.time() < seconds) {
        sim.step();
        held.energy = std::fmax(held.energy, std::fabs(summer(sim.states).energy() / start - 1));
        held.way = std::fmax(held.way, std::fabs(sim.states[0].q[7]));
        held.speed = std::fmax(held.speed, std::fabs(sim.states[0].v[6]));
    }
    return held;
}

TEST(HeldRotor, KeepsItsEnergyAtItsLimit) {
    for (const double dt : {1e-3, 2e-3, 4e-3}) {
        for (const double rate : {10.0, 100.0}) {
            ModelSpec m = rotor();
            m.joints[0].axes[0].lower = -0.2, m.joints[0].axes[0].upper = 0;
            World world = test::empty_world(dt, {});
            test::place(world, m, "rotor");
            test::Simulation sim(world);
            spin(sim, rate);
            const Held held = hold(sim, 10);
            EXPECT_LT(held.energy, 1e-6) << "dt " << dt << ", rate " << rate;
            EXPECT_LT(held.way, 1.1e-6) << "a micrometre is left alone; dt " << dt << ", rate " << rate;
        }
    }
}

TEST(HeldRotor, KeepsItsEnergyHeldByFriction) {
    for (const double dt : {1e-3, 4e-3}) {
        ModelSpec m = rotor();
        m.joints[0].axes[0].friction = 1e3;  // N; the centrifugal force is 330 N at most
        World world = test::empty_world(dt, {});
        test::place(world, m, "rotor");
        test::Simulation sim(world);
        spin(sim, 30);
        const Held held = hold(sim, 10);
        EXPECT_LT(held.energy, 1e-6) << "dt " << dt;
        EXPECT_LT(held.speed, 1e-9) << "dt " << dt;
    }
}

TEST(HeldRotor, KeepsItsEnergyHeldByAMotor) {
    for (const double dt : {1e-3, 4e-3}) {
        World world = test::empty_world(dt, {});
        test::place(world, rotor(), "rotor");
        test::Simulation sim(world);
        spin(sim, 30);
        sim.set_motor(0, 0, MotorMode::kVelocity, 0);
        const Held held = hold(sim, 10);
        EXPECT_LT(held.energy, 1e-6) << "dt " << dt;
        EXPECT_LT(held.speed, 1e-9) << "dt " << dt;
    }
}

/// A tree without limits, friction and damping comes back from where its velocities are turned around.
TEST(TimeReversal, BringsABareTreeBack) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        Random random(seed);
        MechanismOptions options;
        options.bare = true;
        options.fixed_base = seed % 2 == 1;
        World world = test::empty_world(1e-3, {});
        test::place(world, random_tree(random, options), "tree");
        test::Simulation sim(world);
        RobotState& state = sim.states[0];
        for (double& v : state.v) v = random.uniform(-3, 3);
        const std::vector<double> start = state.q;
        sim.run(1);
        for (double& v : state.v) v = -v;
        sim.run(1);
        for (std::size_t i = 0; i < start.size(); ++i)
            EXPECT_NEAR(state.q[i], start[i], 1e-8) << "seed " << seed << ", coordinate " << i;
    }
}

/// Share of its energy that a tree has left after 5 s, in the mean over trees.
double energy_kept(double dt_s, double spin) {
    constexpr std::uint64_t kTrees = 60;
    double kept = 0;
    for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
        Motion motion({seed, "tree", dt_s, spin});
        test::MechanicalSummer summer(motion.model());
        const double start = summer(motion.states()).energy();
        while (motion.time_s() < 5) motion.step();
        kept += summer(motion.states()).energy() / start / static_cast<double>(kTrees);
    }
    return kept;
}

TEST(Dissipation, OfRandomTreesDoesNotDependOnTheStep) {
    for (const double spin : {3.0, 10.0}) {
        const double fine = energy_kept(1e-3, spin), coarse = energy_kept(4e-3, spin);
        test::tell("energy kept after 5 s at 1 ms", fine);
        test::tell("energy kept after 5 s at 4 ms", coarse);
        EXPECT_NEAR(coarse, fine, 0.01) << "spin " << spin;
        EXPECT_LT(fine, 0.99) << "there is some";
    }
}

}  // namespace
}  // namespace roboss::fuzz
