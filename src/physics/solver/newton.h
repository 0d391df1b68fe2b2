// Newton's method for a contact island. Every sum runs in a fixed order, so the bits depend on the island
// alone. Over T: one island (double), or a few robots of one type in lanes, which take their decisions
// together (Lockstep) and leave where that does not fit.
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
    double couple_from = 1e-2;  // residual
    int far_max = 16;           // steps far from the balance
    int coupled_steps = 8, halvings = 0;
    double progress = 0.5;  // of the residual in a coupled step, at least
    int checks = 4;         // of the friction bounds, once momentum balances
};

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

/// `Matrix`: of Newton's method, as TreeHessian.
template <class T, class Matrix>
class Newton {
  public:
    using Mask = MaskOf<T>;

    void start(const SolveProblem<T>& p, const std::vector<T>& v);
    /// Until momentum balances and friction bounds agree. False where it does not come near a balance. Lanes
    /// that leave `together` have no result.
    Mask solve(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v, SolveReportT<T>& report);

  protected:
    /// The same from a balance that is known; with friction bounds as they are, if they are `settled`.
    Mask iterate(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v, SolveReportT<T>& report,
                 bool settled);
    void times_mass(const SolveProblem<T>& p, const std::vector<T>& x, std::vector<T>& y) const;
    void take_velocities(const SolveProblem<T>& p, const std::vector<T>& v);
    Mask find_step(const SolveProblem<T>& p, bool coupled, const T& lack = 0);
    void move(const SolveProblem<T>& p, const T& alpha, std::vector<T>& v);
    void move_some(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v);
    T balance(const SolveProblem<T>& p);
    void set_gradient(const SolveProblem<T>& p);
    T imbalance(const SolveProblem<T>& p) const;
    T slope() const;
    T take_step(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v);
    T slope_beyond(const SolveProblem<T>& p, const T& fraction);
    T line_search(const SolveProblem<T>& p, Lockstep<T>& together, const T& at_start, const T& at_end);
    void measure_from_targets(const SolveProblem<T>& p);
    void keep_start(const SolveProblem<T>& p, const std::vector<T>& v);
    void return_to_start(const SolveProblem<T>& p, std::vector<T>& v);
    void start_as_expected(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                           SolveReportT<T>& report);
    bool solve_coupled(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                       SolveReportT<T>& report);
    void return_to_checked(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report);

    newton::Plan plan_;
    std::size_t n_ = 0;
    Matrix hessian_;
    std::vector<T> mv_;       // M v
    std::vector<T> g_;        // gradient
    std::vector<T> applied_;  // impulses of all rows on each degree of freedom
    std::vector<T> step_, m_step_;
    std::vector<T> lightness_;           // 1 / M's diagonal
    std::vector<T> v_start_, mv_start_;  // where an attempt began
    std::vector<T> v_checked_, bounds_checked_;
    LineSearchBreakpoints<T> breakpoints_;
    std::vector<T> u_start_;  // floats: velocities along all rows there
};

template <class T, class Matrix>
void Newton<T, Matrix>::times_mass(const SolveProblem<T>& p, const std::vector<T>& x,
                                   std::vector<T>& y) const {
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        tree_times(p.robots[r]->type->paths, p.robots[r]->mass_matrix.data(), x.data() + offset,
                   y.data() + offset);
    }
}

/// M v, and the velocities along the rows.
template <class T, class Matrix>
void Newton<T, Matrix>::take_velocities(const SolveProblem<T>& p, const std::vector<T>& v) {
    times_mass(p, v, mv_);
    set_steps(p.rows, v);
    newton::take_velocities(p.rows);
}

template <class T, class Matrix>
void Newton<T, Matrix>::start(const SolveProblem<T>& p, const std::vector<T>& v) {
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
void Newton<T, Matrix>::measure_from_targets(const SolveProblem<T>& p) {
    for_each_bounded(p.rows, [](BoundedRowT<T>& row) { row.u -= row.target, row.target = 0; });
}

/// Impulses at the present velocities and what follows from them; returns the imbalance.
template <class T, class Matrix>
T Newton<T, Matrix>::balance(const SolveProblem<T>& p) {
    newton::update_impulses(p.rows);
    set_gradient(p);
    return imbalance(p);
}

/// g = M v - p - J^T impulses
template <class T, class Matrix>
void Newton<T, Matrix>::set_gradient(const SolveProblem<T>& p) {
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
T Newton<T, Matrix>::imbalance(const SolveProblem<T>& p) const {
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
T Newton<T, Matrix>::slope() const {
    T sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum += step_[i] * g_[i];
    return sum;
}

/// Goes along the step to the minimum; the whole step is nearly always good enough. Returns the balance
/// there.
template <class T, class Matrix>
T Newton<T, Matrix>::take_step(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v) {
    constexpr double kGoodEnough = 0.3;  // of the slope at the start may be left
    const T at_start = slope();
    move(p, 1.0, v);
    const T residual = balance(p);
    const T at_end = slope();
    if (together((!(at_start < T(0))) | (magnitude(at_end) <= -kGoodEnough * at_start))) return residual;
    move(p, line_search(p, together, at_start, at_end), v);
    return balance(p);
}

/// The potential's derivative along the step, `fraction` steps beyond its end.
template <class T, class Matrix>
T Newton<T, Matrix>::slope_beyond(const SolveProblem<T>& p, const T& fraction) {
    T s = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.robots[r]->type->nv); ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            s += step_[i] * (mv_[i] + fraction * m_step_[i] - p.robots[r]->impulse[k]);
        }
    }
    return s - newton::row_slope(p.rows, fraction);
}

/// Minimum along the step, as its distance from the step's end, where we are: the root of the
/// derivative, which is monotone.
template <class T, class Matrix>
T Newton<T, Matrix>::line_search(const SolveProblem<T>& p, Lockstep<T>& together, const T& at_start,
                                 const T& at_end) {
    T low = -1, high = 0, s_low = at_start, s_high = at_end;
    for (int i = 0; i < 20 && together(s_high < T(0)); ++i) {
        low = high, s_low = s_high, high = T(2) * high + T(1);
        s_high = slope_beyond(p, high);
    }
    breakpoints_.find(p.rows, low, high, s_low, s_high);
    int side = 0;  // of the last point: -1 below the root
    for (int i = 0; i < 60;
         ++i) {  // regula falsi with the Illinois rule; each third time a bisection, for the kinks are sharp
        const T share = i % 3 == 2 ? T(0.5) : s_low / (s_low - s_high);
        const T fraction = low + (high - low) * share;
        const T s = breakpoints_.slope(fraction);
        if (together(magnitude(s) <= -0.05 * at_start)) return fraction;
        if (together(s < T(0))) {
            low = fraction, s_low = s;
            if (side < 0) s_high *= 0.5;
            side = -1;
        } else {
            high = fraction, s_high = s;
            if (side > 0) s_low *= 0.5;
            side = 1;
        }
    }
    return select(low > T(-1), low, high);
}

/// v += alpha * step, with all that depends on it linearly.
template <class T, class Matrix>
void Newton<T, Matrix>::move(const SolveProblem<T>& p, const T& alpha, std::vector<T>& v) {
    for (std::size_t i = 0; i < n_; ++i) {
        v[i] += alpha * step_[i];
        mv_[i] += alpha * m_step_[i];
    }
    for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { row.u += alpha * row.du; });
    for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) {
        disc.u_1 += alpha * disc.du_1, disc.u_2 += alpha * disc.du_2;
    });
}

/// The whole step, only where `some`.
template <class T, class Matrix>
void Newton<T, Matrix>::move_some(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v) {
    const auto go = [&](T& x, const T& dx) { x = select(some, x + dx, x); };
    for (std::size_t i = 0; i < n_; ++i) go(v[i], step_[i]), go(mv_[i], m_step_[i]);
    for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { go(row.u, row.du); });
    for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) { go(disc.u_1, disc.du_1), go(disc.u_2, disc.du_2); });
}

/// step = -H^-1 g with the rows' present curvatures (`lack`: may_lack), and what follows from it.
template <class T, class Matrix>
MaskOf<T> Newton<T, Matrix>::find_step(const SolveProblem<T>& p, bool coupled, const T& lack) {
    hessian_.assemble(p.rows, coupled, lack);
    for (std::size_t i = 0; i < n_; ++i) step_[i] = -g_[i];
    const Mask good = hessian_.solve(step_);
    if (!any(good)) return good;
    times_mass(p, step_, m_step_);
    set_steps(p.rows, step_);
    return good;
}

/// Near the solution: Newton's method on the balance itself, friction bounds moving with the normal impulses,
/// which finds both at once and quadratically. There is no potential to descend on, so it gives up, at the
/// velocities where it began, as soon as the balance does not get better. Lanes go on until the last is
/// there; those that are there stay where they are.
template <class T, class Matrix>
bool Newton<T, Matrix>::solve_coupled(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                                      SolveReportT<T>& report) {
    keep_start(p, v);
    const auto tied_balance = [&] {
        friction::tie_bounds(p.rows);
        return balance(p);
    };
    report.residual = tied_balance();
    for (int i = 0;; ++i) {
        const Mask there = report.residual <= newton::tolerance(p);
        if (together.all(there)) return true;
        if (i == plan_.coupled_steps) {
            if (together(there)) return true;
            break;
        }
        const T before = report.residual;
        newton::set_curvatures(p.rows);
        const Mask slides = friction::couple_bounds(p.rows);
        const bool coupled = together.without(there, slides);
        if (!together(there | find_step(p, coupled, newton::may_lack(before)))) break;
        move_some(p, !there, v);
        report.iterations += select(there, T(0), T(1));
        report.residual = tied_balance();
        double alpha = 1;
        const auto improves = [&] {
            return (report.residual <= newton::tolerance(p)) |
                   (report.residual <= T(1 - plan_.progress * alpha) * before);
        };
        for (int h = 0; h < plan_.halvings && !together(improves()); ++h) {
            alpha *= 0.5;
            move(p, -alpha, v);
            report.residual = tied_balance();
        }
        if (!together(improves())) break;
    }
    return_to_start(p, v);
    return false;
}

template <class T, class Matrix>
void Newton<T, Matrix>::keep_start(const SolveProblem<T>& p, const std::vector<T>& v) {
    v_start_ = v, mv_start_ = mv_;
    if constexpr (kIsFloat<T>) {
        u_start_.clear();
        for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { u_start_.push_back(row.u); });
        for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) {
            u_start_.push_back(disc.u_1), u_start_.push_back(disc.u_2);
        });
    }
}

template <class T, class Matrix>
void Newton<T, Matrix>::return_to_start(const SolveProblem<T>& p, std::vector<T>& v) {
    v = v_start_, mv_ = mv_start_;
    if constexpr (kIsFloat<T>) {
        const T* u = u_start_.data();
        for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { row.u = *u++; });
        for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) { disc.u_1 = *u++, disc.u_2 = *u++; });
    } else {
        set_steps(p.rows, v);
        newton::take_velocities(p.rows);
    }
}

/// A first step to where the island would be if every contact did what it did in the last tick: mostly the
/// solution, or near it. Friction bounds follow the normal impulses there. Leaves the balance.
template <class T, class Matrix>
void Newton<T, Matrix>::start_as_expected(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                                          SolveReportT<T>& report) {
    report.residual = balance(p);
    if (p.rows.contacts.empty()) return;  // and lanes need not agree on how far they are
    if (together(report.residual <= T(newton::kRoughly))) return;
    const bool tied = !p.position && hessian_.couples();
    newton::set_curvatures(p.rows);
    const newton::Expected<T> expected = newton::expect_loads(p.rows, tied);
    if (!together(expected.some)) {
        newton::update_impulses(p.rows);
        return;
    }
    keep_start(p, v);
    friction::keep_bounds(p.rows, bounds_checked_);
    set_gradient(p);
    const T before = report.residual;
    if (together(find_step(p, tied && together(expected.slides)))) {
        move(p, 1.0, v);
        report.iterations += T(1);
        if (tied) friction::tie_bounds(p.rows);
        report.residual = balance(p);
        if (together(report.residual <= before)) return;
        friction::set_bounds(p.rows, bounds_checked_);
        return_to_start(p, v);
    }
    report.residual = balance(p);
}

template <class T, class Matrix>
MaskOf<T> Newton<T, Matrix>::solve(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                                   SolveReportT<T>& report) {
    start_as_expected(p, together, v, report);
    return iterate(p, together, v, report, p.position);
}

template <class T, class Matrix>
MaskOf<T> Newton<T, Matrix>::iterate(const SolveProblem<T>& p, Lockstep<T>& together, std::vector<T>& v,
                                     SolveReportT<T>& report, bool settled) {
    constexpr double kFar =
        1e-2;  // a residual that shows that the set of sliding and open contacts is not found yet
    // Each such step turns an edge or two of the potential. A few robots with motors and limits get there in
    // the end; in a heap of bodies there is always another edge (decision 0003).
    constexpr std::size_t kFew = 8;
    const int far_max = p.robots.size() <= kFew && !p.rows.joints.empty() ? 60 : plan_.far_max;
    constexpr int kCoupledTries = 3;
    int bound_updates = 0, stalls = 0, coupled_tries = 0, checks = 0;
    const bool has_friction = !p.rows.contacts.empty();
    if (!has_friction) settled = true;
    const bool stays_settled = settled;
    T far = 0, best = 1, checked_error = 0;
    for (int i = 0; together.any(); ++i) {
        // Without friction there is nothing to begin near the balance: lanes need not agree that they are.
        if (!has_friction || together(report.residual <= T(plan_.couple_from))) {
            if (!settled && hessian_.couples() && coupled_tries < kCoupledTries) {
                ++coupled_tries;
                if (solve_coupled(p, together, v, report)) return true;
                newton::update_impulses(p.rows);
            }
            if (!settled) {
                const T change = friction::update_bounds(p.rows);
                settled = together(change <= newton::friction_tolerance(p)) ||
                          ++bound_updates >= p.accuracy.friction_max;
                report.residual = balance(p);
            }
            const bool stalls_now = settled && together((report.residual <= T(newton::kRounding<T>)) &
                                                        (report.residual > 0.9 * best));
            stalls = stalls_now ? stalls + 1 : 0;
            best = settled ? smaller(best, report.residual) : T(1);
            if (settled && (together(report.residual <= newton::tolerance(p)) || stalls >= 3)) {
                if (stays_settled) break;
                const T error = friction::bound_error(p.rows).relative();
                if (together(error <= newton::friction_tolerance(p))) return true;
                if (checks == 0 || together(error < checked_error)) {
                    checked_error = error;
                    v_checked_ = v;
                    friction::keep_bounds(p.rows, bounds_checked_);
                }
                if (checks == plan_.checks) break;
                settled = false, stalls = 0, best = 1;
                // Every other check gets one more series of coupled steps.
                coupled_tries = ++checks % 2 == 0 ? kCoupledTries : kCoupledTries - 1;
                continue;
            }
        }
        far += select(report.residual > T(kFar), T(1), T(0));
        if (together(far > T(far_max)) || i >= p.accuracy.newton_max) {
            if (checks == 0) return report.residual <= T(newton::kRoughly);
            break;
        }
        newton::set_curvatures(p.rows);
        find_step(p, false, newton::may_lack(report.residual));
        report.residual = take_step(p, together, v);
        report.iterations += T(1);
    }
    if (checks > 0) return_to_checked(p, v, report);
    return together.any();
}

/// Momentum balanced there, and friction missed its tolerance by the least.
template <class T, class Matrix>
void Newton<T, Matrix>::return_to_checked(const SolveProblem<T>& p, std::vector<T>& v,
                                          SolveReportT<T>& report) {
    v = v_checked_;
    friction::set_bounds(p.rows, bounds_checked_);
    take_velocities(p, v);
    report.residual = balance(p);
}

}  // namespace roboss
