// Piles of robots with joints: friction keeps Coulomb's law, and what sweeps settle is near the solution.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include <support/legged.h>
#include <support/simulation.h>

#include "model/accuracy.h"

namespace roboss::test {
namespace {

/// Three layers of nine robots that fall onto each other. `strict`: all tolerances as close as is allowed,
/// which leaves nothing to sweeps.
World heap(bool strict) {
    World world = empty_world(2e-3);
    AccuracySpec accuracy;
    for (const AccuracyNumber& n : accuracy_numbers())
        if (strict && !std::string_view(n.name).ends_with("compliance"))
            accuracy.numbers.push_back({n.name, n.whole != nullptr ? n.high : n.low});
    world.accuracy.push_back(accuracy);
    place(world, ground(surface(0.6)), "ground");
    Random random(3);
    place_legged(world, 3, 3, 0.15, random);
    return world;
}

/// Where Newton's method ends with friction bounds that are not those of the normal impulses, they are
/// updated until they are.
TEST(PileOfLeggedRobots, FrictionKeepsCoulombsLaw) {
    Simulation sim(heap(false));
    sim.scratch.measure_stages([] { return std::uint64_t{0}; });
    constexpr int kTicks = 400;
    SolverProfile sum;
    int off = 0;  // ticks in which some friction is wrong by more than a hundredth
    for (int i = 0; i < kTicks; ++i) {
        const SolverProfile& solver = sim.step().profile.solver;
        sum += solver;
        off += solver.friction_error > 1e-2 ? 1 : 0;
    }
    const double missed = static_cast<double>(sum.friction_misses) / static_cast<double>(sum.friction_solves);
    tell("solves with friction", static_cast<double>(sum.friction_solves));
    tell("share of them that misses the tolerance", missed);
    tell("ticks with an error of more than a hundredth", off);
    tell("worst error", sum.friction_error);
    EXPECT_GT(sum.friction_solves, 1000u);
    EXPECT_GT(sum.largest_part, 12u);
    EXPECT_LT(sim.residual_max, 1e-8);
    EXPECT_LT(missed, 0.01);
    EXPECT_LT(off, kTicks / 50);
}

/// One tick from each of a series of states, which are the same for all: velocities after it.
std::vector<double> velocities_after(bool strict, int& iterations) {
    Simulation path(heap(false)), tried(heap(strict));
    std::vector<double> all;
    for (int i = 0; i < 200; ++i) {
        if (i >= 60 && i % 10 == 0) {
            tried.states = path.states;
            iterations += tried.step().iterations;
            for (const RobotState& state : tried.states)
                all.insert(all.end(), state.v.begin(), state.v.end());
        }
        path.step();
    }
    return all;
}

TEST(PileOfLeggedRobots, SweepsSettleItWithinAThousandthOfItsMotion) {
    int iterations = 0, strict_iterations = 0;
    const std::vector<double> standard = velocities_after(false, iterations),
                              strict = velocities_after(true, strict_iterations);
    double off = 0, speed = 0;
    for (std::size_t i = 0; i < strict.size(); ++i) {
        off += std::pow(standard[i] - strict[i], 2);
        speed += strict[i] * strict[i];
    }
    tell("error left by sweeps, relative to the motion", std::sqrt(off / speed));
    tell("iterations", iterations), tell("iterations, strictly", strict_iterations);
    EXPECT_GT(std::sqrt(off / speed), 1e-7) << "Newton's method finished";
    EXPECT_LT(std::sqrt(off / speed), 2e-3);
    EXPECT_LT(iterations, strict_iterations);
}

/// Robots fly at each other with nothing else around.
TEST(PileOfLeggedRobots, KeepsMomentumAndGainsNoEnergy) {
    World world = empty_world(2e-3, {});
    Random random(5);
    place_legged(world, 3, 3, 0, random);
    Simulation sim(world);
    for (RobotState& state : sim.states) {
        const Pose X = base_pose(state);
        const Vec3 v = rotate(conjugate(X.q), (X.p - Vec3{0.17, 0.17, 0.17}) * -4.0);
        state.v[3] = v.x, state.v[4] = v.y, state.v[5] = v.z;
    }
    const Momentum before = sim.momentum();
    double least = sim.energy(), gained = 0;
    int contacts = 0;
    for (int i = 0; i < 150; ++i) {
        contacts += sim.step().contacts;
        gained = std::fmax(gained, sim.energy() / least - 1);
        least = std::fmin(least, sim.energy());
    }
    const Momentum after = sim.momentum();
    tell("energy gained, relative to its least before", gained);
    tell("linear momentum off by", norm(after.linear - before.linear));
    tell("angular momentum off by", norm(after.angular - before.angular));
    EXPECT_GT(contacts, 200);
    EXPECT_LT(norm(after.linear - before.linear), 1e-10);
    EXPECT_LT(norm(after.angular - before.angular), 1e-6);
    EXPECT_LT(gained, 1e-6);
}

}  // namespace
}  // namespace roboss::test
