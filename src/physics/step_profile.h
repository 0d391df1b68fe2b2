// The profile of a run: how long each stage of its steps takes, and what the solver did. It is measured only
// on request (StepScratch::measure_stages), and no bit of a run depends on it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "physics/solver/solve_method.h"
#include "physics/stage.h"

namespace roboss {

/// What the solver did, of one tick or of many. The same for any number of lanes and threads, and for any
/// grouping of robots into calls of step_island.
struct SolverProfile {
    std::uint64_t islands = 0;          // contact islands that were solved, counted in each tick
    std::uint64_t iterations = 0;       // Newton iterations of these
    std::uint64_t iterations_most = 0;  // of one contact island in one tick
    std::uint64_t largest_island = 0;   // robots
    std::uint64_t most_contacts = 0;    // points and near misses of one island of several robots
    std::uint64_t largest_part = 0;     // robots that were solved together (contact/island_parts.h)
    double residual = 0;                // worst relative residual of the momentum balance
    std::uint64_t friction_solves = 0;  // parts with friction at contacts that push
    std::uint64_t friction_misses = 0;  // of these, whose friction is off by more than friction_tolerance
    double friction_error = 0;          // the worst of all parts (friction::BoundError)
    // Parts that were solved for velocities, and for displacements, by method
    SolveCounts velocities{}, displacements{};

    /// One contact island in one tick.
    void add_island(std::size_t robots, std::size_t in_largest_part, int its_iterations) {
        ++islands;
        const auto count = static_cast<std::uint64_t>(its_iterations);
        iterations += count;
        iterations_most = std::max(iterations_most, count);
        largest_island = std::max<std::uint64_t>(largest_island, robots);
        largest_part = std::max<std::uint64_t>(largest_part, in_largest_part);
    }
    /// One part with friction. An error that is not a number misses every tolerance.
    void add_friction(double error, double tolerance) {
        ++friction_solves;
        friction_misses += error <= tolerance ? 0 : 1;
        friction_error = std::max(friction_error, error);
    }
    SolverProfile& operator+=(const SolverProfile& other) {
        islands += other.islands, iterations += other.iterations;
        iterations_most = std::max(iterations_most, other.iterations_most);
        largest_island = std::max(largest_island, other.largest_island);
        most_contacts = std::max(most_contacts, other.most_contacts);
        largest_part = std::max(largest_part, other.largest_part);
        residual = std::max(residual, other.residual);
        friction_solves += other.friction_solves, friction_misses += other.friction_misses;
        friction_error = std::max(friction_error, other.friction_error);
        add_solves(other.velocities, velocities), add_solves(other.displacements, displacements);
        return *this;
    }
    bool operator==(const SolverProfile&) const = default;
};

struct StepProfile {
    StageTimes stages;
    SolverProfile solver;

    StepProfile& operator+=(const StepProfile& other) {
        stages += other.stages, solver += other.solver;
        return *this;
    }
    bool operator==(const StepProfile&) const = default;
};

}  // namespace roboss
