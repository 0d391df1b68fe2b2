// Newton's method for a contact island. Every sum runs in a fixed order, so the bits depend on the island
// alone.
#include "physics/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/row_math.h"
#include "physics/tree_factor.h"

namespace roboss {

namespace {

constexpr double kRoughly = 1e-4;  // friction bounds are updated once the momentum balance is this good

/// Moves a friction bound towards what the normal impulse allows. Where more friction means less pressure the
/// plain update swings for ever between two values, so a swing that hardly shrinks halves the step.
void update_bound(double wanted, double& bound, double& last_error, double& relaxation) {
    constexpr double kSlowest = 0.05, kRecovery = 1.2;
    const double error = wanted - bound;
    const bool swings = error * last_error < 0 && std::fabs(error) > 0.8 * std::fabs(last_error);
    relaxation = swings ? std::max(0.5 * relaxation, kSlowest) : std::min(kRecovery * relaxation, 1.0);
    last_error = error;
    bound += relaxation * error;
}

/// The disc's bound follows the normal impulse; returns the change of its impulse if it did so at full step.
double update_disc(FrictionDisc& disc, double normal_impulse) {
    if (disc.coefficient == 0) return 0;
    const double wanted = disc.coefficient * normal_impulse;
    const Tangential before = impulse_at(disc, disc.u_1, disc.u_2, disc.bound);
    const Tangential after = impulse_at(disc, disc.u_1, disc.u_2, wanted);
    update_bound(wanted, disc.bound, disc.bound_error, disc.relaxation);
    return std::fabs(after.t1 - before.t1) + std::fabs(after.t2 - before.t2);
}

void update_spin(AngularRow& row, double normal_impulse) {
    update_bound(row.torsional * normal_impulse, row.spin.high, row.spin_error, row.spin_relaxation);
    row.spin.low = -row.spin.high;
}

/// All friction bounds follow the normal impulses; returns how much friction that would change at full step,
/// relative to the largest normal impulse (moments are compared by the radius that their coefficient is).
double update_bounds(IslandRows& rows) {
    double largest = 0, change = 0;
    for (ContactRow& row : rows.contacts) {
        largest = std::max(largest, row.normal.impulse);
        change = std::max(change, update_disc(row.slip, row.normal.impulse));
    }
    for (AngularRow& row : rows.angulars) {
        const double normal = rows.contacts[row.contact].normal.impulse;
        if (row.torsional > 0) {
            change = std::max(change, std::fabs(row.torsional * normal - row.spin.high) / row.torsional);
            update_spin(row, normal);
        }
        if (row.roll.coefficient > 0)
            change = std::max(change, update_disc(row.roll, normal) / row.roll.coefficient);
    }
    return largest > 0 ? change / largest : 0.0;
}

/// Every friction bound as the normal impulse at the present velocity says.
void tie_bounds(IslandRows& rows) {
    for (ContactRow& row : rows.contacts)
        row.slip.bound = row.slip.coefficient * impulse_at(row.normal, row.normal.u);
    for (AngularRow& row : rows.angulars) {
        const BoundedRow& normal = rows.contacts[row.contact].normal;
        const double impulse = impulse_at(normal, normal.u);
        row.roll.bound = row.roll.coefficient * impulse;
        row.spin.high = row.torsional * impulse, row.spin.low = -row.spin.high;
    }
}

/// Derivatives of sliding friction by the normal velocity; false if nothing slides.
bool couple_bounds(IslandRows& rows) {
    bool any = false;
    for (ContactRow& row : rows.contacts) {
        FrictionDisc& disc = row.slip;
        if (row.normal.d == 0 || disc.bound <= 0) continue;
        const double speed = std::sqrt(disc.u_1 * disc.u_1 + disc.u_2 * disc.u_2);
        if (speed <= disc.bound * disc.compliance) continue;
        const double share = -disc.coefficient * row.normal.d / speed;
        disc.d_1n = share * disc.u_1, disc.d_2n = share * disc.u_2;
        any = true;
    }
    return any;
}

/// Velocities along the rows := what set_steps has left.
void take_velocities(IslandRows& rows) {
    for_each_bounded(rows, [](BoundedRow& row) { row.u = row.du; });
    for_each_disc(rows, [](FrictionDisc& disc) {
        disc.u_1 = disc.du_1 - disc.target_1, disc.u_2 = disc.du_2 - disc.target_2;
    });
}

/// Impulses of all rows at the present velocities.
void update_impulses(IslandRows& rows) {
    for_each_bounded(rows, [](BoundedRow& row) { row.impulse = impulse_at(row, row.u); });
    for_each_disc(rows, [](FrictionDisc& disc) {
        if (disc.coefficient == 0) return;
        const Tangential t = impulse_at(disc, disc.u_1, disc.u_2, disc.bound);
        disc.impulse_1 = t.t1, disc.impulse_2 = t.t2;
    });
}

/// The rows' share of the Hessian at the present velocities.
void set_curvatures(IslandRows& rows) {
    for_each_bounded(rows, [](BoundedRow& row) {
        const double raw = (row.target - row.u) * row.stiffness;
        row.d = raw > row.low && raw < row.high ? row.stiffness : 0.0;
    });
    for_each_disc(rows, [](FrictionDisc& disc) {
        disc.d_11 = disc.d_12 = disc.d_22 = disc.d_1n = disc.d_2n = 0;
        if (disc.bound <= 0) return;
        const double speed = std::sqrt(disc.u_1 * disc.u_1 + disc.u_2 * disc.u_2);
        if (speed <= disc.bound * disc.compliance) {
            disc.d_11 = disc.d_22 = disc.stiffness;
        } else {  // sliding: only turning the direction changes the impulse
            const double s = disc.bound / speed, e1 = disc.u_1 / speed, e2 = disc.u_2 / speed;
            disc.d_11 = s * (1.0 - e1 * e1), disc.d_12 = -s * e1 * e2, disc.d_22 = s * (1.0 - e2 * e2);
        }
    });
}

/// Curvatures and impulses as if what stuck in the last tick stuck again. The velocities of the last tick are
/// a bad witness of that, for a hard row takes the least of them for sliding. False if nothing stuck.
bool expect_sticking(IslandRows& rows) {
    bool any = false;
    for (ContactRow& row : rows.contacts) {
        if (!row.sticks) continue;
        BoundedRow& normal = row.normal;
        normal.d = normal.stiffness, normal.impulse = (normal.target - normal.u) * normal.stiffness;
        FrictionDisc& slip = row.slip;
        slip.d_11 = slip.d_22 = slip.stiffness, slip.d_12 = 0;
        slip.impulse_1 = -slip.u_1 * slip.stiffness, slip.impulse_2 = -slip.u_2 * slip.stiffness;
        any = true;
    }
    return any;
}

/// Minus the derivative of the rows' potentials along the step, at `alpha` of it.
double row_slope(IslandRows& rows, double alpha) {
    double s = 0;
    for_each_bounded(rows, [&](BoundedRow& row) { s += impulse_at(row, row.u + alpha * row.du) * row.du; });
    for_each_disc(rows, [&](FrictionDisc& disc) {
        if (disc.coefficient == 0) return;
        const Tangential t =
            impulse_at(disc, disc.u_1 + alpha * disc.du_1, disc.u_2 + alpha * disc.du_2, disc.bound);
        s += t.t1 * disc.du_1 + t.t2 * disc.du_2;
    });
    return s;
}

}  // namespace

void IslandSolver::times_mass(const Problem& p, std::span<const double> x, std::vector<double>& y) const {
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        tree_times(p.robots[r]->type->paths, p.robots[r]->mass_matrix.data(), x.data() + offset,
                   y.data() + offset);
    }
}

void IslandSolver::start(const Problem& p, std::span<const double> v) {
    n_ = v.size();
    for (auto* buffer : {&mv_, &g_, &applied_, &step_, &m_step_}) buffer->resize(n_);
    hessian_.start(p.robots, p.offsets, p.rows, n_);
    times_mass(p, v, mv_);
    set_steps(p.rows, v);
    for_each_bounded(p.rows, [](BoundedRow& row) { row.stiffness = 1.0 / row.compliance; });
    for_each_disc(p.rows, [](FrictionDisc& disc) { disc.stiffness = 1.0 / disc.compliance; });
    take_velocities(p.rows);
    if (p.position) for_each_bounded(p.rows, [](BoundedRow& row) { row.target = row.position_target; });
}

/// Impulses at the present velocities and g = M v - p - J^T impulses; returns its size relative to the
/// momenta in play, both measured in the metric of M's diagonal.
double IslandSolver::balance(const Problem& p) {
    update_impulses(p.rows);
    return gradient(p);
}

double IslandSolver::gradient(const Problem& p) {
    std::fill(applied_.begin(), applied_.end(), 0.0);
    add_impulses(p.rows, applied_);
    double error = 0, scale = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const RobotWork& robot = *p.robots[r];
        const auto nv = static_cast<std::size_t>(robot.type->nv);
        for (std::size_t k = 0; k < nv; ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            const double free = robot.impulse[k];
            g_[i] = mv_[i] - free - applied_[i];
            const double m = robot.mass_matrix[robot.type->paths.diagonal(k)];
            error += g_[i] * g_[i] / m;
            scale += (mv_[i] * mv_[i] + free * free + applied_[i] * applied_[i]) / m;
        }
    }
    if (scale == 0) return 0.0;
    return std::isfinite(error) ? std::sqrt(error / scale)
                                : std::numeric_limits<double>::infinity();  // never taken for solved
}

/// The potential's derivative along the step.
double IslandSolver::slope() const {
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum += step_[i] * g_[i];
    return sum;
}

/// Goes along the step to the minimum; the whole step is nearly always good enough. Returns the balance
/// there.
double IslandSolver::take_step(const Problem& p, std::vector<double>& v) {
    constexpr double kGoodEnough = 0.1;  // of the slope at the start may be left
    const double at_start = slope();
    move(p, 1.0, v);
    const double residual = balance(p);
    const double at_end = slope();
    if (!(at_start < 0) || std::fabs(at_end) <= -kGoodEnough * at_start) return residual;
    move(p, line_search(p, at_start, at_end), v);
    return balance(p);
}

/// Exact minimum along the step, as its distance from the step's end, where we are: the root of the
/// derivative, which is monotone.
double IslandSolver::line_search(const Problem& p, double at_start, double at_end) {
    double slope0 = 0, quadratic = 0;  // of the smooth part
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.robots[r]->type->nv); ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            slope0 += step_[i] * (mv_[i] - p.robots[r]->impulse[k]);
            quadratic += step_[i] * m_step_[i];
        }
    }
    const auto slope_at = [&](double way) { return slope0 + way * quadratic - row_slope(p.rows, way); };
    double low = -1, high = 0, s_low = at_start, s_high = at_end;
    for (int i = 0; i < 20 && s_high < 0; ++i)
        low = high, s_low = s_high, high = 2 * high + 1, s_high = slope_at(high);
    int side = 0;  // of the last point: -1 below the root
    for (int i = 0; i < 60;
         ++i) {  // regula falsi with the Illinois rule; each third time a bisection, for the kinks are sharp
        const double share = i % 3 == 2 ? 0.5 : s_low / (s_low - s_high);
        const double way = low + (high - low) * share;
        const double s = slope_at(way);
        if (std::fabs(s) <= -0.05 * at_start) return way;
        if (s < 0) {
            low = way, s_low = s;
            if (side < 0) s_high *= 0.5;
            side = -1;
        } else {
            high = way, s_high = s;
            if (side > 0) s_low *= 0.5;
            side = 1;
        }
    }
    return low > -1 ? low : high;
}

/// v += alpha * step, with all that depends on it linearly.
void IslandSolver::move(const Problem& p, double alpha, std::vector<double>& v) {
    for (std::size_t i = 0; i < n_; ++i) {
        v[i] += alpha * step_[i];
        mv_[i] += alpha * m_step_[i];
    }
    for_each_bounded(p.rows, [&](BoundedRow& row) { row.u += alpha * row.du; });
    for_each_disc(p.rows,
                  [&](FrictionDisc& disc) { disc.u_1 += alpha * disc.du_1, disc.u_2 += alpha * disc.du_2; });
}

/// step = -H^-1 g with the rows' present curvatures, and what follows from it.
bool IslandSolver::find_step(const Problem& p, bool coupled) {
    hessian_.assemble(p.rows, coupled);
    for (std::size_t i = 0; i < n_; ++i) step_[i] = -g_[i];
    if (!hessian_.solve(step_)) return false;
    times_mass(p, step_, m_step_);
    set_steps(p.rows, step_);
    return true;
}

/// Near the solution: Newton's method on the balance itself, friction bounds moving with the normal impulses,
/// which finds both at once and quadratically. There is no potential to descend on, so it gives up, at the
/// velocities where it began, as soon as the balance does not get better.
bool IslandSolver::coupled_newton(const Problem& p, std::vector<double>& v, SolveReport& report) {
    constexpr int kStepsMax = 8;
    constexpr double kProgress = 0.5;  // of the residual in a step, at least
    v_start_ = v, mv_start_ = mv_;
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0;; ++i) {
        tie_bounds(p.rows);
        report.residual = balance(p);
        if (report.residual <= p.accuracy.tolerance) return true;
        if (i == kStepsMax || !(report.residual <= kProgress * best)) break;
        best = report.residual;
        set_curvatures(p.rows);
        const bool sliding = couple_bounds(p.rows);
        if (!find_step(p, sliding)) break;
        move(p, 1.0, v);
        ++report.iterations;
    }
    return_to_start(p, v);
    return false;
}

void IslandSolver::return_to_start(const Problem& p, std::vector<double>& v) {
    v = v_start_, mv_ = mv_start_;
    set_steps(p.rows, v);
    take_velocities(p.rows);
}

/// A first step to where the island would be if every contact did what it did in the last tick: mostly the
/// solution. Leaves the balance there.
void IslandSolver::start_as_expected(const Problem& p, std::vector<double>& v, SolveReport& report) {
    report.residual = balance(p);
    if (report.residual <= kRoughly) return;
    set_curvatures(p.rows);
    if (!expect_sticking(p.rows)) return;
    v_start_ = v, mv_start_ = mv_;
    gradient(p);
    find_step(p, false);
    move(p, 1.0, v);
    ++report.iterations;
    const double before = report.residual;
    report.residual = balance(p);
    if (report.residual <= before) return;
    return_to_start(p, v);
    report.residual = balance(p);
}

/// Newton's method until momentum balances and friction bounds agree. False if it does not come near a
/// balance.
bool IslandSolver::newton(const Problem& p, std::vector<double>& v, SolveReport& report) {
    constexpr double kFar =
        1e-2;  // a residual that shows that the set of sliding and open contacts is not found yet
    constexpr int kFarMax = 16;
    constexpr double kRounding = 1e-8;  // below, a residual that no longer falls is taken for rounding
    constexpr int kCoupledTries = 3;
    int far = 0, bound_updates = 0, stalls = 0, coupled_tries = 0;
    bool settled = p.position;  // the friction bounds
    double best = 1;
    start_as_expected(p, v, report);
    for (int i = 0;; ++i) {
        if (report.residual <= kRoughly) {
            if (!settled && coupled_tries < kCoupledTries) {
                ++coupled_tries;
                if (coupled_newton(p, v, report)) return true;
                update_impulses(p.rows);
            }
            if (!settled) {
                settled = update_bounds(p.rows) <= p.accuracy.friction_tolerance ||
                          ++bound_updates >= p.accuracy.friction_max;
                report.residual = balance(p);
            }
            stalls = settled && report.residual <= kRounding && report.residual > 0.9 * best ? stalls + 1 : 0;
            best = settled ? std::min(best, report.residual) : 1.0;
            if (settled && (report.residual <= p.accuracy.tolerance || stalls >= 3)) return true;
        }
        if (report.residual > kFar) ++far;
        if (far > kFarMax || i == p.accuracy.newton_max) return report.residual <= kRoughly;
        set_curvatures(p.rows);
        find_step(p, false);
        report.residual = take_step(p, v);
        ++report.iterations;
    }
}

SolveReport IslandSolver::solve(const Problem& p, std::vector<double>& v) {
    start(p, v);
    SolveReport report;
    start_bounds_.clear();
    for_each_disc(p.rows, [&](FrictionDisc& disc) { start_bounds_.push_back(disc.bound); });
    for (const AngularRow& row : p.rows.angulars) start_bounds_.push_back(row.spin.high);
    if (newton(p, v, report)) return report;
    // Where many contacts stand between sticking and sliding, each Newton step turns only one of them: the
    // potential of hard rows is all edges. The interior point method goes through the middle, in a number of
    // steps that hardly depends on the problem: once with the bounds of the last tick, once with those that
    // follow from it.
    std::size_t at = 0;
    for_each_disc(p.rows, [&](FrictionDisc& disc) { disc.bound = start_bounds_[at++]; });
    for (AngularRow& row : p.rows.angulars)
        row.spin.high = start_bounds_[at++], row.spin.low = -row.spin.high;
    interior_point(p, v, report);
    if (p.position) return report;
    for (ContactRow& row : p.rows.contacts) row.slip.bound = row.slip.coefficient * row.normal.impulse;
    for (AngularRow& row : p.rows.angulars) {
        const double normal = p.rows.contacts[row.contact].normal.impulse;
        row.roll.bound = row.roll.coefficient * normal;
        row.spin.high = row.torsional * normal, row.spin.low = -row.spin.high;
    }
    if (newton(p, v, report)) return report;
    interior_point(p, v, report);
    return report;
}

}  // namespace roboss
