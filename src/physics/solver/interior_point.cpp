// A primal-dual interior point method (Boyd and Vandenberghe, Convex Optimization, 2004, section 11.7) for a
// contact island with fixed friction bounds: impulses stay strictly inside their bounds, multipliers stay
// positive, and their products go to zero together. It uses the same sparse system in the velocities as
// Newton's method, with other row curvatures.
#include <algorithm>
#include <cmath>

#include "physics/solver/row_math.h"
#include "physics/solver/solver.h"

namespace roboss {
namespace {

constexpr int kStepsMax = 40;
constexpr double kGapEnd = 1e-11;     // of the first gap: Newton's method does the rest
constexpr double kBalanced = 1e-8;    // relative residual of the momentum balance
constexpr double kLeastRoom = 1e-14;  // of a friction disc
constexpr double kLeastBound =
    1e-9;  // of the start's normal impulse; a smaller friction bound counts as none
constexpr double kToBoundary = 0.98;  // share of the way to the nearest bound that a step may take
constexpr double kGenerous = 1000;    // the start's normal impulse, in impulses that would stop the body

/// Half of the squared room left in the friction disc, kept above rounding.
double room(const FrictionDisc& disc) {
    const double full = disc.bound * disc.bound;
    const double left = full - disc.impulse_1 * disc.impulse_1 - disc.impulse_2 * disc.impulse_2;
    return 0.5 * std::max(left, kLeastRoom * full);
}

/// Bounds that leave no room (a motor without effort): the impulse is what it is.
bool is_fixed(const BoundedRow& row) {
    return !(row.high > row.low);
}

/// Curvature of one row, and what its impulse would change by if the velocity did not: change = offset - D *
/// (change of velocity). Bounds that are infinite have no multiplier.
double prepare(BoundedRow& row, double mu) {
    if (is_fixed(row)) return row.d = 0;
    double stiffness = row.compliance, rest = row.target - row.u - row.compliance * row.impulse;
    if (std::isfinite(row.low)) {
        stiffness += row.slack_low / (row.impulse - row.low);
        rest += mu / (row.impulse - row.low);
    }
    if (std::isfinite(row.high)) {
        stiffness += row.slack_high / (row.high - row.impulse);
        rest -= mu / (row.high - row.impulse);
    }
    row.d = 1.0 / stiffness;
    return row.d * rest;
}

Tangential prepare(FrictionDisc& disc, double mu) {
    disc.d_11 = disc.d_12 = disc.d_22 = disc.d_1n = disc.d_2n = 0;
    if (disc.bound <= 0) return {};
    const double left = room(disc), x = disc.impulse_1, y = disc.impulse_2;
    const double a = disc.compliance + disc.slack, s = disc.slack / left;
    const double a11 = a + disc.slip_11 + s * x * x, a12 = disc.slip_12 + s * x * y,
                 a22 = a + disc.slip_22 + s * y * y;
    const double inverse = 1.0 / (a11 * a22 - a12 * a12);
    disc.d_11 = a22 * inverse, disc.d_12 = -a12 * inverse, disc.d_22 = a11 * inverse;
    const double k = disc.compliance + mu / left;
    const double r1 = -disc.u_1 - k * x - disc.slip_11 * x - disc.slip_12 * y,
                 r2 = -disc.u_2 - k * y - disc.slip_12 * x - disc.slip_22 * y;
    return {disc.d_11 * r1 + disc.d_12 * r2, disc.d_12 * r1 + disc.d_22 * r2};
}

/// Largest step <= alpha that keeps x + alpha * dx above zero.
double limit(double alpha, double x, double dx) {
    return dx < 0 ? std::min(alpha, -kToBoundary * x / dx) : alpha;
}

/// Largest step <= alpha that keeps the friction impulse inside its disc.
double limit_disc(double alpha, const FrictionDisc& disc, double d1, double d2) {
    const double a = d1 * d1 + d2 * d2;
    if (a == 0) return alpha;
    const double b = disc.impulse_1 * d1 + disc.impulse_2 * d2;
    const double c = -2.0 * room(disc);  // negative inside
    const double root = (-b + std::sqrt(b * b - a * c)) / a;
    return std::min(alpha, kToBoundary * root);
}

/// Mean product of a bound's room and its multiplier: what the method drives to zero.
double mean_gap(IslandRows& rows) {
    double sum = 0;
    int count = 0;
    const auto add = [&](double product) { sum += product, ++count; };
    for_each_bounded(rows, [&](BoundedRow& row) {
        if (is_fixed(row)) return;
        if (std::isfinite(row.low)) add(row.slack_low * (row.impulse - row.low));
        if (std::isfinite(row.high)) add(row.slack_high * (row.high - row.impulse));
    });
    for_each_disc(rows, [&](FrictionDisc& disc) {
        if (disc.bound > 0) add(disc.slack * room(disc));
    });
    return count > 0 ? sum / count : 0.0;
}

/// In the middle of the bounds; `reach`: an impulse that fits the island's speed, where a bound is infinite.
void start_inside(BoundedRow& row, double speed, double reach) {
    row.slack_low = row.slack_high = row.slack_low_step = row.slack_high_step = 0;
    row.impulse = row.low;
    if (is_fixed(row)) return;
    if (std::isfinite(row.low) && std::isfinite(row.high)) {
        row.impulse = 0.5 * (row.low + row.high);
    } else {
        row.impulse = std::isfinite(row.low)    ? row.low + reach
                      : std::isfinite(row.high) ? row.high - reach
                                                : 0.0;
    }
    const double product = speed * reach;
    row.slack_low = std::isfinite(row.low) ? product / (row.impulse - row.low) : 0.0;
    row.slack_high = std::isfinite(row.high) ? product / (row.high - row.impulse) : 0.0;
}

/// `normal`: the start's normal impulse, `product`: that of bounds and multipliers.
void start_inside(FrictionDisc& disc, double normal, double product) {
    disc.impulse_1 = disc.impulse_2 = 0;
    disc.slack = disc.slack_step = 0;
    if (disc.bound < kLeastBound * normal) disc.bound = 0;
    if (disc.bound > 0) disc.slack = product / room(disc);
}

/// A start in the middle of all bounds, at a speed scale that fits the island.
void start_inside(const Accuracy& accuracy, IslandRows& rows, double speed) {
    const auto reach = [&](const BoundedRow& row, double relative) {
        return speed * relative / row.compliance;  // a row's compliance over `relative` is its mobility
    };
    for (JointRow& row : rows.joints) start_inside(row, speed, reach(row, accuracy.compliance));
    for (CouplingRow& row : rows.couplings) start_inside(row, speed, reach(row, accuracy.compliance));
    for (ContactRow& row : rows.contacts) {
        const double normal = kGenerous * speed / row.inverse_effective_mass;
        start_inside(row.normal, speed, normal);
        start_inside(row.slip, normal, speed * normal);
    }
    for (AngularRow& row : rows.angulars) {
        const double normal = rows.contacts[row.contact].normal.impulse;
        start_inside(row.spin, speed, normal);
        start_inside(row.roll, normal, speed * normal);
    }
}

}  // namespace

void IslandSolver::interior_point(const Problem& p, std::vector<double>& v, Report& report) {
    double speed = 0.1;  // m/s: generous, so that the start is more central than right
    for (const ContactRow& row : p.rows.contacts)
        speed = std::max({speed, std::fabs(row.normal.target - row.normal.u), std::fabs(row.slip.u_1),
                          std::fabs(row.slip.u_2)});
    start_inside(p.accuracy, p.rows, speed);
    const double gap_start = mean_gap(p.rows);
    double centring = 0.2;
    for (int i = 0; i < kStepsMax; ++i) {
        const double gap = mean_gap(p.rows);
        set_gradient(p);
        report.residual = imbalance(p);
        if (gap <= kGapEnd * gap_start && report.residual <= kBalanced) return;
        const double alpha = interior_step(p, centring * gap, v);
        if (alpha == 0) return;
        centring = alpha > 0.9 ? 0.02 : alpha > 0.5 ? 0.2 : 0.5;
        report.iterations += 1;
    }
}

/// Steps of all impulses and multipliers that follow from that of the velocities, and the largest share of
/// them that keeps everything inside its bounds. `changes_` starts as the offsets of prepare.
double IslandSolver::longest_step(const Problem& p, double mu) {
    double alpha = 1;
    std::size_t at = 0;
    for_each_bounded(p.rows, [&](BoundedRow& row) {
        double& change = changes_[at++];
        if (is_fixed(row)) return;
        change -= row.d * row.du;
        if (std::isfinite(row.low)) {
            const double x = row.impulse - row.low;
            row.slack_low_step = (mu - row.slack_low * (x + change)) / x;
            alpha = limit(limit(alpha, x, change), row.slack_low, row.slack_low_step);
        }
        if (std::isfinite(row.high)) {
            const double x = row.high - row.impulse;
            row.slack_high_step = (mu - row.slack_high * (x - change)) / x;
            alpha = limit(limit(alpha, x, -change), row.slack_high, row.slack_high_step);
        }
    });
    for_each_disc(p.rows, [&](FrictionDisc& disc) {
        double &t1 = changes_[at], &t2 = changes_[at + 1];
        at += 2;
        t1 -= disc.d_11 * disc.du_1 + disc.d_12 * disc.du_2;
        t2 -= disc.d_12 * disc.du_1 + disc.d_22 * disc.du_2;
        if (disc.bound <= 0) return;
        const double left = room(disc);
        disc.slack_step = (mu - disc.slack * (left - disc.impulse_1 * t1 - disc.impulse_2 * t2)) / left;
        alpha = limit_disc(limit(alpha, disc.slack, disc.slack_step), disc, t1, t2);
    });
    return alpha;
}

/// One Newton step towards complementarity `mu`; returns its length, 0 if rounding has left no step to take.
double IslandSolver::interior_step(const Problem& p, double mu, std::vector<double>& v) {
    changes_.clear();
    for_each_bounded(p.rows, [&](BoundedRow& row) {
        changes_.push_back(prepare(row, mu));
        std::swap(row.impulse, changes_.back());  // for add_impulses
    });
    for_each_disc(p.rows, [&](FrictionDisc& disc) {
        const Tangential t = prepare(disc, mu);
        changes_.push_back(disc.impulse_1), changes_.push_back(disc.impulse_2);
        disc.impulse_1 = t.t1, disc.impulse_2 = t.t2;
    });
    std::fill(step_.begin(), step_.end(), 0.0);
    add_impulses(p.rows, step_);
    for (std::size_t i = 0; i < n_; ++i) g_[i] -= step_[i];
    std::size_t at = 0;
    for_each_bounded(p.rows, [&](BoundedRow& row) { std::swap(row.impulse, changes_[at++]); });
    for_each_disc(p.rows, [&](FrictionDisc& disc) {
        std::swap(disc.impulse_1, changes_[at++]), std::swap(disc.impulse_2, changes_[at++]);
    });
    find_step(p, false);
    const double alpha = longest_step(p, mu);
    double finite = alpha - alpha;
    for (double x : step_) finite += x - x;
    if (finite != 0) return 0;
    move(p, alpha, v);
    at = 0;
    for_each_bounded(p.rows, [&](BoundedRow& row) {
        row.impulse += alpha * changes_[at++];
        row.slack_low += alpha * row.slack_low_step;
        row.slack_high += alpha * row.slack_high_step;
    });
    for_each_disc(p.rows, [&](FrictionDisc& disc) {
        disc.impulse_1 += alpha * changes_[at++], disc.impulse_2 += alpha * changes_[at++];
        disc.slack += alpha * disc.slack_step;
    });
    return alpha;
}

}  // namespace roboss
