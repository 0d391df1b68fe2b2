// Solves one contact island: velocities that balance momentum with all bounded rows and exact isotropic
// Coulomb friction.
//
// For fixed friction bounds the solution minimises a convex, piecewise quadratic potential over the
// velocities,
//     1/2 v^T M v - p^T v + sum of row potentials(J v),
// which Newton's method with an exact line search finds in a few iterations whatever the mass ratios (Todorov
// 2014; Castro, Permenter, Han 2022). The bounds mu * normal impulse start from the last tick and are updated
// until they agree with the normal impulses (Haslinger's fixed point): then Coulomb's law holds exactly, with
// no pyramid and no lifting while sliding.
#pragma once

#include <optional>
#include <vector>

#include "physics/solver/hessian.h"
#include "physics/solver/newton.h"
#include "physics/solver/row_sweeps.h"
#include "physics/solver/solve_method.h"
#include "physics/solver/solve_plan.h"

namespace roboss {

struct SolveReport {
    int iterations = 0;
    double residual = 0;  // relative, of the momentum balance
    SolveMethod method = SolveMethod::kNewton;
};

class IslandSolver : Newton<double, Hessian> {
  public:
    using Problem = SolveProblem<double>;

    /// Whose threads may share the work.
    void share_with(const Team& team) { hessian_.share_with(team); }
    /// v (size n) starts as the velocities before the tick and ends as the solution; the rows end with their
    /// impulses.
    SolveReport solve(const Problem& problem, std::vector<double>& v);
    /// A single robot that only contacts push, by Newton's method alone, with the bits of a lane. False where
    /// that misses a tolerance (meets_tolerances()): then v and the rows are as before.
    bool solve_plainly(const Problem& problem, std::vector<double>& v, SolveReport& report);

  private:
    using Report = SolveReportT<double>;
    enum class Pushing : char { kLow, kBetween, kHigh };  // where a row's impulse is in its bounds
    std::optional<SolveMethod> attempt(Attempt attempt, const newton::Plan& newton, const Problem& p,
                                       std::vector<double>& v, Report& report);
    // island_start.cpp
    void keep_beginning(const Problem& p, const std::vector<double>& v);
    void return_to_beginning(const Problem& p, std::vector<double>& v);
    bool continue_at_rest(const Problem& p, std::vector<double>& v, Report& report);
    std::optional<SolveMethod> solve_by_sweeps(const Problem& p, std::vector<double>& v, Report& report);
    void step_as_swept(const Problem& p, std::vector<double>& v, Report& report);
    void expect_swept(const Problem& p);
    bool displace(const Problem& p, std::vector<double>& v, Report& report);
    void soften(IslandRows& rows, double softer);
    bool harden(const Problem& p, std::vector<double>& v, Report& report);
    void settle_for_sweeps(Problem p, std::vector<double>& v);
    void take_swept(const Problem& p, const std::vector<double>& v);

    RowSweeps sweeps_;
    // Where the attempts begin: velocities, and of the last tick friction bounds and normal impulses
    std::vector<double> v_beginning_, start_bounds_, carried_;
    std::vector<double> compliances_;
    std::vector<double> v_before_;
    std::vector<ContactRow> contacts_before_;
    std::vector<Pushing> pushing_;  // bounded rows, while the displacement is solved
};

}  // namespace roboss
