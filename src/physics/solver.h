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

#include <span>
#include <vector>

#include "physics/hessian.h"
#include "physics/rows.h"

namespace roboss {

struct SolveReport {
    int iterations = 0;
    double residual = 0;  // relative, of the momentum balance
};

class IslandSolver {
  public:
    /// What is asked for: `robots`, the contact island, and `offsets`, their first dofs. `position`: solve
    /// for the way of the tick (position targets) instead of the velocity.
    struct Problem {
        const Accuracy& accuracy;
        std::span<const RobotWork* const> robots;
        std::span<const int> offsets;
        IslandRows& rows;
        bool position = false;
    };

    /// v (size n) starts as the velocities before the tick and ends as the solution; the rows end with their
    /// impulses.
    SolveReport solve(const Problem& problem, std::vector<double>& v);

  private:
    // solver.cpp: shared pieces, then Newton's method
    void start(const Problem& p, std::span<const double> v);
    void times_mass(const Problem& p, std::span<const double> x, std::vector<double>& y) const;
    bool find_step(const Problem& p, bool coupled);
    void move(const Problem& p, double alpha, std::vector<double>& v);
    double balance(const Problem& p);
    double gradient(const Problem& p);
    double slope() const;
    double take_step(const Problem& p, std::vector<double>& v);
    double line_search(const Problem& p, double at_start, double at_end);
    void return_to_start(const Problem& p, std::vector<double>& v);
    void start_as_expected(const Problem& p, std::vector<double>& v, SolveReport& report);
    bool newton(const Problem& p, std::vector<double>& v, SolveReport& report);
    bool coupled_newton(const Problem& p, std::vector<double>& v, SolveReport& report);
    // interior_point.cpp
    void interior_point(const Problem& p, std::vector<double>& v, SolveReport& report);
    double longest_step(const Problem& p, double mu);
    double interior_step(const Problem& p, double mu, std::vector<double>& v);

    std::size_t n_ = 0;
    Hessian hessian_;
    std::vector<double> mv_;       // M v
    std::vector<double> g_;        // gradient
    std::vector<double> applied_;  // impulses of all rows on each degree of freedom
    std::vector<double> step_, m_step_;
    std::vector<double> v_start_, mv_start_;  // where an attempt began
    std::vector<double> start_bounds_;        // friction bounds of the last tick
    std::vector<double> changes_;             // interior point: steps of the impulses
};

}  // namespace roboss
