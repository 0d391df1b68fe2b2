// The parts of Newton's method for a contact island: the balance of momentum, a step, what lies along it.
// Over T: one island (double, newton.h), or a few robots of one type in lanes (lanes/lane_newton.h).
//
// Floats have no digits to spare: with them, solved is the change of the velocity in the tick, all targets
// come relative to the velocities before it, and rows measure their velocities from their targets, so that
// every number is as small as what it tells.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/wide.h"
#include "physics/contact/friction_bounds.h"
#include "physics/dynamics/tree_factor.h"
#include "physics/solver/breakpoints.h"
#include "physics/solver/newton_rows.h"

namespace roboss {

template <class T>
struct SolveReportT {
    T iterations{};
    T residual{};  // relative, of the momentum balance
};

/// What is asked for: `robots`, the contact island, and `offsets`, their first dofs. `position`: solve for
/// the displacement of the tick (position targets) instead of the velocity.
template <class T>
struct SolveProblem {
    const Accuracy& accuracy;
    std::span<const Mechanics<T>* const> robots;
    std::span<const int> offsets;
    IslandRowsT<T>& rows;
    bool position = false;
    bool again = false;  // rows hold the impulses of an earlier solution of the same tick
};

namespace newton {

inline constexpr double kRoughly =
    1e-4;  // friction bounds are updated once the momentum balance is this good
/// The finest tolerance that makes sense, and below what a residual that no longer falls is taken for
/// rounding. Floats: of the impulses of one tick, of which 1e-5 is 1e-7 of a robot's momentum at walking
/// speed.
template <class T>
inline constexpr double kFinest = kIsFloat<T> ? 1e-5 : 0.0;
template <class T>
inline constexpr double kRounding = kIsFloat<T> ? 1e-4 : 1e-8;

/// What the matrix may lack of a friction row's curvature, relative to it, so far from the balance: it costs
/// no steps as long as it shrinks with the residual.
template <class T>
T may_lack(const T& residual) {
    return smaller(T(0.3), T(30) * residual);
}

/// How long Newton's method goes on, and from where it couples friction bounds to the normal impulses.
struct Plan {
    double couple_from = kRoughly;  // residual
    int far_max = 16;               // steps far from the balance
    int coupled_steps = 8, halvings = 0;
    double progress = 0.5;  // of the residual in a coupled step, at least
    int checks = 4;         // of the friction bounds, once momentum balances
};

inline constexpr int kCoupledTries = 3;
inline constexpr double kStalled = 0.9;  // of the best residual: more is no progress
inline constexpr int kStallsMax = 3;
/// A residual that shows that the set of sliding and open contacts is not found yet.
inline constexpr double kFar = 1e-2;
/// Each step there turns an edge or two of the potential. A few robots with motors and limits get there in
/// the end; in a heap of bodies there is always another edge (decision 0003).
template <class T>
int far_max(const SolveProblem<T>& p, const Plan& plan) {
    constexpr std::size_t kFew = 8;
    return p.robots.size() <= kFew && !p.rows.joints.empty() ? 60 : plan.far_max;
}

/// Whether the whole step is near enough to the minimum along it, by the slopes at its ends.
template <class T>
MaskOf<T> is_good_enough(const T& at_start, const T& at_end) {
    constexpr double kLeft = 0.3;  // of the slope at the start
    return (!(at_start < T(0))) | (magnitude(at_end) <= -kLeft * at_start);
}

inline constexpr int kExtensions = 20, kSearches = 60;
inline constexpr double kRootShare = -0.05;  // of the slope at the start: as good as none
/// Of an interval of the line search: regula falsi with the Illinois rule; each third time a bisection, for
/// the kinks are sharp.
template <class T>
T share_to_try(int i, const T& s_low, const T& s_high) {
    return i % 3 == 2 ? T(0.5) : s_low / (s_low - s_high);
}

template <class T>
T tolerance(const SolveProblem<T>& p) {
    return larger(T(p.accuracy.tolerance), T(kFinest<T>));
}
template <class T>
T friction_tolerance(const SolveProblem<T>& p) {
    return larger(T(p.accuracy.friction_tolerance), T(kFinest<T>));
}

/// Of the balance of momentum (`residual`); of friction, too, unless its bounds are given, as for the
/// displacement.
template <class T>
MaskOf<T> meets_tolerances(const SolveProblem<T>& p, const T& residual) {
    const MaskOf<T> balances = residual <= tolerance(p);
    if (p.position) return balances;
    return balances & (friction::bound_error(p.rows).relative() <= friction_tolerance(p));
}

/// Whether all contacts of a free body push along one normal. Where they do not, Newton's method with
/// friction bounds in between often ends without a solution.
template <class T>
MaskOf<T> have_one_normal(const IslandRowsT<T>& rows) {
    MaskOf<T> differ = false;
    for (const ContactRowT<T>& row : rows.contacts)
        for (std::size_t i = 3; i < 6; ++i)
            differ =
                differ | !equal(rows.columns.n[row.first + i], rows.columns.n[rows.contacts[0].first + i]);
    return !differ;
}

}  // namespace newton

/// What every way of going through Newton's method is made of. `Matrix`: of the method, as TreeHessian.
template <class T, class Matrix>
class NewtonBase {
  public:
    using Mask = MaskOf<T>;

    void start(const SolveProblem<T>& p, const std::vector<T>& v);

  protected:
    void times_mass(const SolveProblem<T>& p, const std::vector<T>& x, std::vector<T>& y) const;
    void take_velocities(const SolveProblem<T>& p, const std::vector<T>& v);
    Mask find_step(const SolveProblem<T>& p, const Mask& coupled, const T& lack = 0);
    void move(const SolveProblem<T>& p, const T& alpha, std::vector<T>& v);
    T balance(const SolveProblem<T>& p);
    void set_gradient(const SolveProblem<T>& p);
    T imbalance(const SolveProblem<T>& p) const;
    T slope() const;
    T slope_beyond(const SolveProblem<T>& p, const T& fraction);
    void measure_from_targets(const SolveProblem<T>& p);

    newton::Plan plan_;
    std::size_t n_ = 0;
    Matrix hessian_;
    std::vector<T> mv_;       // M v
    std::vector<T> g_;        // gradient
    std::vector<T> applied_;  // impulses of all rows on each degree of freedom
    std::vector<T> step_, m_step_;
    std::vector<T> lightness_;  // 1 / M's diagonal
    LineSearchBreakpoints<T> breakpoints_;
};

template <class T, class Matrix>
void NewtonBase<T, Matrix>::times_mass(const SolveProblem<T>& p, const std::vector<T>& x,
                                       std::vector<T>& y) const {
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        tree_times(p.robots[r]->type->paths, p.robots[r]->mass_matrix.data(), x.data() + offset,
                   y.data() + offset);
    }
}

/// M v, and the velocities along the rows.
template <class T, class Matrix>
void NewtonBase<T, Matrix>::take_velocities(const SolveProblem<T>& p, const std::vector<T>& v) {
    times_mass(p, v, mv_);
    set_steps(p.rows, v);
    newton::take_velocities(p.rows);
}

template <class T, class Matrix>
void NewtonBase<T, Matrix>::start(const SolveProblem<T>& p, const std::vector<T>& v) {
    n_ = v.size();
    for (auto* buffer : {&mv_, &g_, &applied_, &lightness_, &step_, &m_step_}) buffer->resize(n_);
    T* lightness = lightness_.data();
    for (const Mechanics<T>* robot : p.robots)
        for (std::size_t k = 0; k < robot->type->paths.size(); ++k)
            *lightness++ = T(1) / robot->mass_matrix[robot->type->paths.diagonal(k)];
    hessian_.start(p.robots, p.offsets, p.rows, n_);
    take_velocities(p, v);
    if (p.position) for_each_bounded(p.rows, [](BoundedRowT<T>& row) { aim_at_displacement(row); });
    for_each_bounded(p.rows, [](BoundedRowT<T>& row) { row.stiffness = T(1) / row.compliance; });
    for_each_disc(p.rows, [](FrictionDiscT<T>& disc) { disc.stiffness = T(1) / disc.compliance; });
    if constexpr (kIsFloat<T>) measure_from_targets(p);
}

/// Velocities along bounded rows from their targets, as those of friction are anyhow.
template <class T, class Matrix>
void NewtonBase<T, Matrix>::measure_from_targets(const SolveProblem<T>& p) {
    for_each_bounded(p.rows, [](BoundedRowT<T>& row) { row.u -= row.target, row.target = 0; });
}

/// Impulses at the present velocities and what follows from them; returns the imbalance.
template <class T, class Matrix>
T NewtonBase<T, Matrix>::balance(const SolveProblem<T>& p) {
    newton::update_impulses(p.rows);
    set_gradient(p);
    return imbalance(p);
}

/// g = M v - p - J^T impulses
template <class T, class Matrix>
void NewtonBase<T, Matrix>::set_gradient(const SolveProblem<T>& p) {
    for (T& x : applied_) x = 0;
    add_impulses(p.rows, applied_);
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        const auto nv = static_cast<std::size_t>(p.robots[r]->type->nv);
        const T *free = p.robots[r]->impulse.data(), *mv = mv_.data() + offset,
                *applied = applied_.data() + offset;
        T* __restrict g = g_.data() + offset;
        for (std::size_t k = 0; k < nv; ++k) g[k] = mv[k] - free[k] - applied[k];
    }
}

/// Size of the gradient relative to the momenta in play, both measured in the metric of M's diagonal.
template <class T, class Matrix>
T NewtonBase<T, Matrix>::imbalance(const SolveProblem<T>& p) const {
    using std::sqrt;
    constexpr double kNeverSolved = std::numeric_limits<double>::infinity();
    Two<T> errors{}, scales{};  // of even and odd unknowns, which do not wait for each other
    T error = 0, scale = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        const auto nv = static_cast<std::size_t>(p.robots[r]->type->nv);
        const T *free = p.robots[r]->impulse.data(), *g = g_.data() + offset, *mv = mv_.data() + offset,
                *applied = applied_.data() + offset, *lightness = lightness_.data() + offset;
        const auto add = [&](auto at, auto& error_of, auto& scale_of) {
            error_of += at(g) * at(g) * at(lightness);
            scale_of += (at(mv) * at(mv) + at(free) * at(free) + at(applied) * at(applied)) * at(lightness);
        };
        for (std::size_t k = 0; k + 1 < nv; k += 2)
            add([&](const T* x) { return two_at(x + k); }, errors, scales);
        if (nv % 2 != 0) add([&](const T* x) { return x[nv - 1]; }, error, scale);
    }
    error += errors[0] + errors[1], scale += scales[0] + scales[1];
    const Mask finite = error < T(kNeverSolved);
    return select(equal(scale, T(0)), T(0), select(finite, sqrt(error / scale), T(kNeverSolved)));
}

/// The potential's derivative along the step.
template <class T, class Matrix>
T NewtonBase<T, Matrix>::slope() const {
    T sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum += step_[i] * g_[i];
    return sum;
}

/// The potential's derivative along the step, `fraction` steps beyond its end.
template <class T, class Matrix>
T NewtonBase<T, Matrix>::slope_beyond(const SolveProblem<T>& p, const T& fraction) {
    T s = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.robots[r]->type->nv); ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            s += step_[i] * (mv_[i] + fraction * m_step_[i] - p.robots[r]->impulse[k]);
        }
    }
    return s - newton::row_slope(p.rows, fraction);
}

/// v += alpha * step, with all that depends on it linearly.
template <class T, class Matrix>
void NewtonBase<T, Matrix>::move(const SolveProblem<T>& p, const T& alpha, std::vector<T>& v) {
    for (std::size_t i = 0; i < n_; ++i) {
        v[i] += alpha * step_[i];
        mv_[i] += alpha * m_step_[i];
    }
    for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { row.u += alpha * row.du; });
    for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) {
        disc.u_1 += alpha * disc.du_1, disc.u_2 += alpha * disc.du_2;
    });
}

/// step = -H^-1 g with the rows' present curvatures (`lack`: may_lack), and what follows from it.
template <class T, class Matrix>
MaskOf<T> NewtonBase<T, Matrix>::find_step(const SolveProblem<T>& p, const Mask& coupled, const T& lack) {
    hessian_.assemble(p.rows, coupled, lack);
    for (std::size_t i = 0; i < n_; ++i) step_[i] = -g_[i];
    const Mask good = hessian_.solve(step_);
    if (!any(good)) return good;
    times_mass(p, step_, m_step_);
    set_steps(p.rows, step_);
    return good;
}

}  // namespace roboss
