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

#include "physics/rows.h"

namespace roboss {

struct SolveReport {
    int iterations = 0;
    double residual = 0;  // relative, of the momentum balance
};

class IslandSolver {
  public:
    /// `robots`: the contact island, `offsets` their first dofs; v (size n) starts as the velocities before
    /// the tick and ends as the solution. `position`: solve for the way of the tick (position targets)
    /// instead of the velocity.
    SolveReport solve(const Accuracy& accuracy, std::span<const RobotWork* const> robots,
                      std::span<const int> offsets, std::span<JointRow> joints,
                      std::span<const ContactColumn> columns, std::span<ContactRow> contacts, bool position,
                      std::vector<double>& v);

  private:
    struct Problem {
        const Accuracy& accuracy;
        std::span<const RobotWork* const> robots;
        std::span<const int> offsets;
        std::span<JointRow> joints;
        std::span<const ContactColumn> columns;
        std::span<ContactRow> contacts;
        bool position = false;
        double target(const ContactRow& row) const { return position ? row.position_target : row.target; }
    };
    // solver.cpp: shared pieces, then Newton's method
    void start(const Problem& p, std::span<const double> v);
    void set_profile(const Problem& p);
    void times_mass(const Problem& p, std::span<const double> x, std::vector<double>& y) const;
    void set_contact_steps(const Problem& p, const double* x) const;
    double* row_of(std::size_t i) {
        return h_.data() + (tree_ ? i * n_ : row_at_[i]);
    }  // Hessian row, by column
    void assemble(const Problem& p);
    void add_contact(const Problem& p, const ContactRow& row);
    void factor_and_solve(const Problem& p);
    void find_step(const Problem& p);
    void move(const Problem& p, double alpha, std::vector<double>& v);
    double gradient(const Problem& p);
    double update_impulses(const Problem& p, std::span<const double> v, bool update_bounds);
    void set_curvatures(const Problem& p, std::span<const double> v);
    double line_search(const Problem& p, std::span<const double> v);
    bool newton(const Problem& p, std::vector<double>& v, SolveReport& report);
    // interior_point.cpp
    void interior_point(const Problem& p, std::vector<double>& v, SolveReport& report);
    double longest_step(const Problem& p, double mu);
    double interior_step(const Problem& p, double mu, std::vector<double>& v);

    std::size_t n_ = 0;
    bool tree_ = false;       // one robot without self contact: the mass matrix' pattern has no fill-in
    std::vector<double> mv_;  // M v
    std::vector<double> g_;   // gradient
    std::vector<double> step_, m_step_;
    std::vector<double> start_bounds_;  // friction bounds of the last tick
    std::vector<double> offsets_;       // interior point: changes of the impulses
    std::vector<double> h_;             // Hessian: tree: n x n; else skyline rows
    std::vector<std::size_t> first_;    // skyline: first column of a row
    std::vector<std::size_t>
        row_at_;  // skyline: h_ index of column 0 of a row (may wrap below zero, unsigned)
};

}  // namespace roboss
