// Newton's method for a contact island. Every sum runs in a fixed order, so the bits depend on the island
// alone. Robots in lanes take the same course, each at its own pace: lanes/lane_newton.h.
#pragma once

#include "physics/solver/newton_base.h"

namespace roboss {

template <class Matrix>
class Newton : public NewtonBase<double, Matrix> {
  public:
    using Problem = SolveProblem<double>;
    using Report = SolveReportT<double>;

    /// Until momentum balances and friction bounds agree. False where it does not come near a balance.
    bool solve(const Problem& p, std::vector<double>& v, Report& report);

  protected:
    using Base = NewtonBase<double, Matrix>;
    using Base::balance, Base::breakpoints_, Base::find_step, Base::hessian_, Base::move, Base::mv_;
    using Base::plan_, Base::set_gradient, Base::slope, Base::slope_beyond, Base::take_velocities;

    /// The same from a balance that is known; with friction bounds as they are, if they are `settled`.
    bool iterate(const Problem& p, std::vector<double>& v, Report& report, bool settled);
    double take_step(const Problem& p, std::vector<double>& v);
    double line_search(const Problem& p, double at_start, double at_end);
    void keep_start(const std::vector<double>& v);
    void return_to_start(const Problem& p, std::vector<double>& v);
    void start_as_expected(const Problem& p, std::vector<double>& v, Report& report);
    bool solve_coupled(const Problem& p, std::vector<double>& v, Report& report);
    void return_to_checked(const Problem& p, std::vector<double>& v, Report& report);

    std::vector<double> v_start_, mv_start_;  // where an attempt began
    std::vector<double> v_checked_, bounds_checked_;
};

/// Goes along the step to the minimum; the whole step is nearly always good enough. Returns the balance
/// there.
template <class Matrix>
double Newton<Matrix>::take_step(const Problem& p, std::vector<double>& v) {
    const double at_start = slope();
    move(p, 1.0, v);
    const double residual = balance(p);
    const double at_end = slope();
    if (newton::is_good_enough(at_start, at_end)) return residual;
    move(p, line_search(p, at_start, at_end), v);
    return balance(p);
}

/// Minimum along the step, as its distance from the step's end, where we are: the root of the
/// derivative, which is monotone.
template <class Matrix>
double Newton<Matrix>::line_search(const Problem& p, double at_start, double at_end) {
    double low = -1, high = 0, s_low = at_start, s_high = at_end;
    for (int i = 0; i < newton::kExtensions && s_high < 0; ++i) {
        low = high, s_low = s_high, high = 2 * high + 1;
        s_high = slope_beyond(p, high);
    }
    breakpoints_.find(p.rows, low, high, s_low, s_high);
    int side = 0;  // of the last point: -1 below the root
    for (int i = 0; i < newton::kSearches; ++i) {
        const double fraction = low + (high - low) * newton::share_to_try(i, s_low, s_high);
        const double s = breakpoints_.slope(fraction);
        if (std::fabs(s) <= newton::kRootShare * at_start) return fraction;
        if (s < 0) {
            low = fraction, s_low = s;
            if (side < 0) s_high *= 0.5;
            side = -1;
        } else {
            high = fraction, s_high = s;
            if (side > 0) s_low *= 0.5;
            side = 1;
        }
    }
    return low > -1 ? low : high;
}

/// Near the solution: Newton's method on the balance itself, friction bounds moving with the normal impulses,
/// which finds both at once and quadratically. There is no potential to descend on, so it gives up, at the
/// velocities where it began, as soon as the balance does not get better.
template <class Matrix>
bool Newton<Matrix>::solve_coupled(const Problem& p, std::vector<double>& v, Report& report) {
    keep_start(v);
    const auto tied_balance = [&] {
        friction::tie_bounds(p.rows);
        return balance(p);
    };
    report.residual = tied_balance();
    for (int i = 0; !(report.residual <= newton::tolerance(p)); ++i) {
        const double before = report.residual;
        bool improves = false;
        if (i < plan_.coupled_steps) {
            newton::set_curvatures(p.rows);
            const bool slides = friction::couple_bounds(p.rows);
            improves = find_step(p, slides, newton::may_lack(before));
        }
        if (improves) {
            move(p, 1.0, v);
            report.iterations += 1;
            report.residual = tied_balance();
            double alpha = 1;
            const auto is_better = [&] {
                return report.residual <= newton::tolerance(p) ||
                       report.residual <= (1 - plan_.progress * alpha) * before;
            };
            for (int h = 0; h < plan_.halvings && !is_better(); ++h) {
                alpha *= 0.5;
                move(p, -alpha, v);
                report.residual = tied_balance();
            }
            improves = is_better();
        }
        if (improves) continue;
        return_to_start(p, v);
        return false;
    }
    return true;
}

template <class Matrix>
void Newton<Matrix>::keep_start(const std::vector<double>& v) {
    v_start_ = v, mv_start_ = mv_;
}

template <class Matrix>
void Newton<Matrix>::return_to_start(const Problem& p, std::vector<double>& v) {
    v = v_start_, mv_ = mv_start_;
    set_steps(p.rows, v);
    newton::take_velocities(p.rows);
}

/// A first step to where the island would be if every contact did what it did in the last tick: mostly the
/// solution. Leaves the balance there.
template <class Matrix>
void Newton<Matrix>::start_as_expected(const Problem& p, std::vector<double>& v, Report& report) {
    report.residual = balance(p);
    if (p.rows.contacts.empty() || report.residual <= newton::kRoughly) return;
    newton::set_curvatures(p.rows);
    if (!newton::expect_sticking(p.rows)) return;
    keep_start(v);
    set_gradient(p);
    find_step(p, false);
    move(p, 1.0, v);
    report.iterations += 1;
    const double before = report.residual;
    report.residual = balance(p);
    if (report.residual <= before) return;
    return_to_start(p, v);
    report.residual = balance(p);
}

template <class Matrix>
bool Newton<Matrix>::solve(const Problem& p, std::vector<double>& v, Report& report) {
    start_as_expected(p, v, report);
    return iterate(p, v, report, p.position);
}

template <class Matrix>
bool Newton<Matrix>::iterate(const Problem& p, std::vector<double>& v, Report& report, bool settled) {
    using newton::kCoupledTries;
    const int far_max = newton::far_max(p, plan_);
    int bound_updates = 0, stalls = 0, coupled_tries = 0, checks = 0, far = 0;
    if (p.rows.contacts.empty()) settled = true;
    const bool stays_settled = settled;
    double best = 1, checked_error = 0;
    for (int i = 0;; ++i) {
        if (p.rows.contacts.empty() || report.residual <= plan_.couple_from) {
            if (!settled && hessian_.couples() && coupled_tries < kCoupledTries) {
                ++coupled_tries;
                if (solve_coupled(p, v, report)) return true;
                newton::update_impulses(p.rows);
            }
            if (!settled) {
                const double change = friction::update_bounds(p.rows);
                settled =
                    change <= newton::friction_tolerance(p) || ++bound_updates >= p.accuracy.friction_max;
                report.residual = balance(p);
            }
            const bool stalls_now = settled && report.residual <= newton::kRounding<double> &&
                                    report.residual > newton::kStalled * best;
            stalls = stalls_now ? stalls + 1 : 0;
            best = settled ? smaller(best, report.residual) : 1;
            if (settled && (report.residual <= newton::tolerance(p) || stalls >= newton::kStallsMax)) {
                if (stays_settled) return true;
                const double error = friction::bound_error(p.rows).relative();
                if (error <= newton::friction_tolerance(p)) return true;
                if (checks == 0 || error < checked_error) {
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
        far += report.residual > newton::kFar ? 1 : 0;
        if (far > far_max || i >= p.accuracy.newton_max) {
            if (checks == 0) return report.residual <= newton::kRoughly;
            break;
        }
        newton::set_curvatures(p.rows);
        find_step(p, false, newton::may_lack(report.residual));
        report.residual = take_step(p, v);
        report.iterations += 1;
    }
    return_to_checked(p, v, report);
    return true;
}

/// Momentum balanced there, and friction missed its tolerance by the least.
template <class Matrix>
void Newton<Matrix>::return_to_checked(const Problem& p, std::vector<double>& v, Report& report) {
    v = v_checked_;
    friction::set_bounds(p.rows, bounds_checked_);
    take_velocities(p, v);
    report.residual = balance(p);
}

}  // namespace roboss
