// See solver.h.
#include "physics/solver/solver.h"

namespace roboss {

/// Newton's method, and where many contacts stand between sticking and sliding the interior point method:
/// each Newton step would turn only one of them, for the potential of hard rows is all edges. The interior
/// point method goes through the middle, in a number of steps that hardly depends on the problem: once with
/// the bounds of the last tick, once with those that follow from it.
void IslandSolver::solve_any(const Problem& p, std::vector<double>& v, Report& report) {
    Lockstep<double> alone;
    start(p, v);
    start_bounds_.clear();
    for_each_disc(p.rows, [&](FrictionDisc& disc) { start_bounds_.push_back(disc.bound); });
    for (const AngularRow& row : p.rows.angulars) start_bounds_.push_back(row.spin.high);
    if (Newton::solve(p, alone, v, report)) return;
    std::size_t at = 0;
    for_each_disc(p.rows, [&](FrictionDisc& disc) { disc.bound = start_bounds_[at++]; });
    for (AngularRow& row : p.rows.angulars)
        row.spin.high = start_bounds_[at++], row.spin.low = -row.spin.high;
    interior_point(p, v, report);
    if (p.position) return;
    for (ContactRow& row : p.rows.contacts) row.slip.bound = row.slip.coefficient * row.normal.impulse;
    for (AngularRow& row : p.rows.angulars) {
        const double normal = p.rows.contacts[row.contact].normal.impulse;
        row.roll.bound = row.roll.coefficient * normal;
        row.spin.high = row.torsional * normal, row.spin.low = -row.spin.high;
    }
    if (Newton::solve(p, alone, v, report)) return;
    interior_point(p, v, report);
}

SolveReport IslandSolver::solve(const Problem& p, std::vector<double>& v) {
    Report report;
    solve_any(p, v, report);
    return {static_cast<int>(report.iterations), report.residual};
}

}  // namespace roboss
