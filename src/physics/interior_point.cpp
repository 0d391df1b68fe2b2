// A primal-dual interior point method (Boyd and Vandenberghe, Convex Optimization, 2004, section 11.7) for a
// contact island with fixed friction bounds: impulses stay strictly inside their bounds, multipliers stay
// positive, and their products go to zero together. It uses the same sparse system in the velocities as
// Newton's method, with other row curvatures.
#include <algorithm>
#include <cmath>

#include "physics/solver.h"

namespace roboss {
namespace {

constexpr int kStepsMax = 40;
constexpr double kGapEnd = 1e-11;     // of the first gap: Newton's method does the rest
constexpr double kBalanced = 1e-8;    // relative residual of the momentum balance
constexpr double kNoFriction = 1e-14; // of the starting impulse: a friction bound below it is none
constexpr double kToBoundary = 0.98;  // share of the way to the nearest bound that a step may take

/// Mobility that a hard row acts on, from its compliance.
double mobility(double compliance, const Accuracy& accuracy) {
    return compliance / accuracy.compliance;
}

/// Half of the squared room left in the friction disc; never below its rounding, for it divides.
double room(const ContactRow& row) {
    const double bound2 = row.bound * row.bound;
    const double left = bound2 - row.impulse_t1 * row.impulse_t1 - row.impulse_t2 * row.impulse_t2;
    return 0.5 * std::max(left, 1e-16 * bound2);
}

/// Right-hand side and step of one row's impulses: change = offset - D * (change of velocity).
struct Offsets {
    double n = 0, t1 = 0, t2 = 0;
};

Offsets prepare(ContactRow& row, double target, double mu) {
    Offsets e;
    row.d_n = 1.0 / (row.compliance_n + row.slack_n / row.impulse_n);
    e.n = row.d_n * (target - row.u_n - row.compliance_n * row.impulse_n + mu / row.impulse_n);
    row.d_11 = row.d_12 = row.d_22 = 0;
    if (row.bound <= 0) return e;
    const double left = room(row), x = row.impulse_t1, y = row.impulse_t2;
    const double a = row.compliance_t + row.slack_t, s = row.slack_t / left;
    const double a11 = a + s * x * x, a12 = s * x * y, a22 = a + s * y * y;
    const double inverse = 1.0 / (a11 * a22 - a12 * a12);
    row.d_11 = a22 * inverse, row.d_12 = -a12 * inverse, row.d_22 = a11 * inverse;
    const double k = row.compliance_t + mu / left;
    const double r1 = -row.u_t1 - k * x, r2 = -row.u_t2 - k * y;
    e.t1 = row.d_11 * r1 + row.d_12 * r2, e.t2 = row.d_12 * r1 + row.d_22 * r2;
    return e;
}

/// The same for a joint row; bounds that are infinite have no multiplier.
double prepare(JointRow& row, double v, double mu) {
    double stiffness = row.compliance, rest = row.target - v - row.compliance * row.impulse;
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

/// Largest step <= alpha that keeps x + alpha * dx above a fifth of nothing.
double limit(double alpha, double x, double dx) {
    return dx < 0 ? std::min(alpha, -kToBoundary * x / dx) : alpha;
}

/// Largest step <= alpha that keeps the friction impulse inside its disc.
double limit_disc(double alpha, const ContactRow& row, double d1, double d2) {
    const double a = d1 * d1 + d2 * d2;
    if (a == 0) return alpha;
    const double b = row.impulse_t1 * d1 + row.impulse_t2 * d2;
    const double c = -2.0 * room(row);  // negative inside
    const double root = (-b + std::sqrt(b * b - a * c)) / a;
    return std::min(alpha, kToBoundary * root);
}

struct Gap {
    double sum = 0;
    int count = 0;
    void add(double product) { sum += product, ++count; }
    double mean() const { return count > 0 ? sum / count : 0.0; }
};

Gap measure_gap(std::span<const JointRow> joints, std::span<const ContactRow> contacts) {
    Gap gap;
    for (const JointRow& row : joints) {
        if (std::isfinite(row.low)) gap.add(row.slack_low * (row.impulse - row.low));
        if (std::isfinite(row.high)) gap.add(row.slack_high * (row.high - row.impulse));
    }
    for (const ContactRow& row : contacts) {
        gap.add(row.slack_n * row.impulse_n);
        if (row.bound > 0) gap.add(row.slack_t * room(row));
    }
    return gap;
}

/// A start in the middle of all bounds, at a speed scale that fits the island.
void start_inside(const Accuracy& accuracy, std::span<JointRow> joints, std::span<ContactRow> contacts,
                  double speed) {
    for (JointRow& row : joints) {
        const double reach = speed / mobility(row.compliance, accuracy);
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
    for (ContactRow& row : contacts) {
        row.impulse_n = speed / mobility(row.compliance_n, accuracy);
        // An open contact leaves this method with an impulse like 1e-180: its disc has no inside that numbers could tell.
        if (row.bound <= kNoFriction * row.impulse_n) row.bound = 0;
        row.slack_n = speed;
        row.impulse_t1 = row.impulse_t2 = 0;
        if (row.bound > 0) row.slack_t = row.slack_n * row.impulse_n / room(row);
    }
}

}  // namespace

void IslandSolver::interior_point(const Problem& p, std::vector<double>& v, SolveReport& report) {
    double speed = 0.1;  // m/s: generous, so that the start is more central than right
    for (const ContactRow& row : p.contacts)
        speed =
            std::max({speed, std::fabs(p.target(row) - row.u_n), std::fabs(row.u_t1), std::fabs(row.u_t2)});
    start_inside(p.accuracy, p.joints, p.contacts, speed);
    const double gap_start = measure_gap(p.joints, p.contacts).mean();
    double centring = 0.2;
    for (int i = 0; i < kStepsMax; ++i) {
        const double gap = measure_gap(p.joints, p.contacts).mean();
        report.residual = gradient(p);
        if (gap <= kGapEnd * gap_start && report.residual <= kBalanced) return;
        const double alpha = interior_step(p, centring * gap, v);
        centring = alpha > 0.9 ? 0.02 : alpha > 0.5 ? 0.2 : 0.5;
        ++report.iterations;
    }
}

double IslandSolver::interior_step(const Problem& p, double mu, std::vector<double>& v) {
    offsets_.clear();  // what the impulses would change by if the velocities did not
    for (JointRow& row : p.joints) {
        offsets_.push_back(prepare(row, v[static_cast<std::size_t>(row.dof)], mu));
        g_[static_cast<std::size_t>(row.dof)] -= offsets_.back();
    }
    for (ContactRow& row : p.contacts) {
        const Offsets e = prepare(row, p.target(row), mu);
        for (double x : {e.n, e.t1, e.t2}) offsets_.push_back(x);
        for (std::size_t c = row.first; c < row.last; ++c) {
            const ContactColumn& k = p.columns[c];
            g_[static_cast<std::size_t>(k.dof)] -= k.n * e.n + k.t1 * e.t1 + k.t2 * e.t2;
        }
    }
    find_step(p);
    double alpha = 1;
    std::size_t at = 0;
    for (JointRow& row : p.joints) {
        double& change = offsets_[at++];
        change -= row.d * step_[static_cast<std::size_t>(row.dof)];
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
    }
    for (ContactRow& row : p.contacts) {
        double *n = &offsets_[at], *t1 = n + 1, *t2 = n + 2;
        at += 3;
        *n -= row.d_n * row.du_n;
        *t1 -= row.d_11 * row.du_t1 + row.d_12 * row.du_t2;
        *t2 -= row.d_12 * row.du_t1 + row.d_22 * row.du_t2;
        row.slack_n_step = (mu - row.slack_n * (row.impulse_n + *n)) / row.impulse_n;
        alpha = limit(limit(alpha, row.impulse_n, *n), row.slack_n, row.slack_n_step);
        if (row.bound <= 0) continue;
        const double left = room(row);
        row.slack_t_step = (mu - row.slack_t * (left - row.impulse_t1 * *t1 - row.impulse_t2 * *t2)) / left;
        alpha = limit_disc(limit(alpha, row.slack_t, row.slack_t_step), row, *t1, *t2);
    }
    move(p, alpha, v);
    at = 0;
    for (JointRow& row : p.joints) {
        row.impulse += alpha * offsets_[at++];
        row.slack_low += alpha * row.slack_low_step;
        row.slack_high += alpha * row.slack_high_step;
    }
    for (ContactRow& row : p.contacts) {
        row.impulse_n += alpha * offsets_[at];
        row.impulse_t1 += alpha * offsets_[at + 1], row.impulse_t2 += alpha * offsets_[at + 2];
        row.slack_n += alpha * row.slack_n_step, row.slack_t += alpha * row.slack_t_step;
        at += 3;
    }
    return alpha;
}

}  // namespace roboss
