// Splits the solved impulses of a contact island's rows into kicks and steady loads, for the kick-drift step.
#pragma once

#include <span>
#include <vector>

#include "physics/solver/solver.h"

namespace roboss {

/// By degree of freedom of the contact island.
struct RowSplit {
    std::vector<char> locked;        // held by the rows of its joint; then these are in neither array
    std::vector<double> held;        // velocity of what is locked
    std::vector<double> kick, load;  // generalised impulses, N s
};

/// Splits the impulses that were solved for. What acts at once is a kick: rigid contacts, with their
/// friction. What acts as a force does is a load: rows at their bounds (a stalled motor, a joint that slips),
/// springs, dampers and servos that the inertia
/// outweighs, and of loop axes and bonds what balances forces. Joints that their rows hold are locked.
/// Equalities are in neither array: the drift keeps them. `v_before` and `v`: velocities before the tick and
/// solved.
void split_rows(const IslandSolver::Problem& problem, std::span<const double> v_before,
                std::span<const double> v, double dt, RowSplit& split);

}  // namespace roboss
