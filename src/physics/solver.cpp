// Newton's method for a contact island. Every sum runs in a fixed order, so the bits depend on the island
// alone.
#include "physics/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/tree_factor.h"

namespace roboss {

namespace {

double clamped_impulse(const JointRow& row, double v) {
    return std::clamp((row.target - v) / row.compliance, row.low, row.high);
}

struct Tangential {
    double t1, t2;
};

Tangential friction(const ContactRow& row, double u_t1, double u_t2, double bound) {
    const double t1 = -u_t1 / row.compliance_t, t2 = -u_t2 / row.compliance_t;
    const double size2 = t1 * t1 + t2 * t2;
    if (size2 <= bound * bound) return {t1, t2};
    const double cut = bound / std::sqrt(size2);
    return {t1 * cut, t2 * cut};
}

/// Moves the friction bound towards mu times the normal impulse. Where more friction means less pressure the
/// plain update swings for ever between two values, so a swing that hardly shrinks halves the step.
void update_bound(ContactRow& row) {
    constexpr double kSlowest = 0.05, kRecovery = 1.2;
    const double error = row.mu * row.impulse_n - row.bound;
    const bool swings = error * row.bound_error < 0 && std::fabs(error) > 0.8 * std::fabs(row.bound_error);
    row.relaxation =
        swings ? std::max(0.5 * row.relaxation, kSlowest) : std::min(kRecovery * row.relaxation, 1.0);
    row.bound_error = error;
    row.bound += row.relaxation * error;
}

}  // namespace

void IslandSolver::times_mass(const Problem& p, std::span<const double> x, std::vector<double>& y) const {
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto offset = static_cast<std::size_t>(p.offsets[r]);
        tree_times(p.robots[r]->type->dof_parent, p.robots[r]->mass_matrix, x.data() + offset,
                   y.data() + offset);
    }
}

/// du = J x for all contacts.
void IslandSolver::set_contact_steps(const Problem& p, const double* x) const {
    for (ContactRow& row : p.contacts) {
        row.du_n = row.du_t1 = row.du_t2 = 0;
        for (std::size_t c = row.first; c < row.last; ++c) {
            const ContactColumn& k = p.columns[c];
            const double xi = x[k.dof];
            row.du_n += k.n * xi, row.du_t1 += k.t1 * xi, row.du_t2 += k.t2 * xi;
        }
    }
}

void IslandSolver::start(const Problem& p, std::span<const double> v) {
    n_ = v.size();
    tree_ = p.robots.size() == 1 && !p.robots[0]->touches_robot;
    for (auto* buffer : {&mv_, &g_, &step_, &m_step_}) buffer->resize(n_);
    times_mass(p, v, mv_);
    set_contact_steps(p, v.data());
    for (ContactRow& row : p.contacts) row.u_n = row.du_n, row.u_t1 = row.du_t1, row.u_t2 = row.du_t2;
    if (!tree_) set_profile(p);
}

/// Impulses of all contact rows at the present velocities. With `update_bounds` the friction bounds follow
/// the normal impulses; returns how much friction that would change at full step, relative to the largest
/// normal impulse.
double IslandSolver::update_impulses(const Problem& p, std::span<const double> v, bool update_bounds) {
    for (JointRow& row : p.joints) row.impulse = clamped_impulse(row, v[static_cast<std::size_t>(row.dof)]);
    double largest = 0, change = 0;
    for (ContactRow& row : p.contacts) {
        row.impulse_n = std::max(0.0, (p.target(row) - row.u_n) / row.compliance_n);
        largest = std::max(largest, row.impulse_n);
        if (row.mu == 0) continue;
        if (update_bounds) {
            const Tangential before = friction(row, row.u_t1, row.u_t2, row.bound);
            const Tangential after = friction(row, row.u_t1, row.u_t2, row.mu * row.impulse_n);
            change = std::max(change, std::fabs(after.t1 - before.t1) + std::fabs(after.t2 - before.t2));
            update_bound(row);
        }
        const Tangential t = friction(row, row.u_t1, row.u_t2, row.bound);
        row.impulse_t1 = t.t1, row.impulse_t2 = t.t2;
    }
    return largest > 0 ? change / largest : 0.0;
}

/// g = M v - p - J^T impulses; returns its size relative to the momenta in play, both measured in the metric
/// of M's diagonal.
double IslandSolver::gradient(const Problem& p) {
    for (std::size_t i = 0; i < n_; ++i) step_[i] = 0;  // applied impulses, for now
    for (const JointRow& row : p.joints) {
        const auto i = static_cast<std::size_t>(row.dof);
        step_[i] += row.impulse;
    }
    for (const ContactRow& row : p.contacts) {
        for (std::size_t c = row.first; c < row.last; ++c) {
            const ContactColumn& k = p.columns[c];
            step_[static_cast<std::size_t>(k.dof)] +=
                k.n * row.impulse_n + k.t1 * row.impulse_t1 + k.t2 * row.impulse_t2;
        }
    }
    double error = 0, scale = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const RobotWork& robot = *p.robots[r];
        const auto nv = static_cast<std::size_t>(robot.type->nv);
        for (std::size_t k = 0; k < nv; ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            const double free = robot.impulse[k];
            g_[i] = mv_[i] - free - step_[i];
            const double m = robot.mass_matrix[k * nv + k];
            error += g_[i] * g_[i] / m;
            scale += (mv_[i] * mv_[i] + free * free + step_[i] * step_[i]) / m;
        }
    }
    if (scale == 0) return 0.0;
    return std::isfinite(error) ? std::sqrt(error / scale)
                                : std::numeric_limits<double>::infinity();  // never taken for solved
}

/// Skyline of the Hessian: a robot's rows reach back to the first dof of the lowest robot it touches.
void IslandSolver::set_profile(const Problem& p) {
    first_.resize(n_);
    row_at_.resize(n_);
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const auto begin = static_cast<std::size_t>(p.offsets[r]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.robots[r]->type->nv); ++k)
            first_[begin + k] = begin;
    }
    for (const ContactRow& row : p.contacts) {
        std::size_t lowest = n_;
        for (std::size_t c = row.first; c < row.last; ++c)
            lowest = std::min(lowest, first_[static_cast<std::size_t>(p.columns[c].dof)]);
        for (std::size_t c = row.first; c < row.last; ++c) {
            std::size_t& first = first_[static_cast<std::size_t>(p.columns[c].dof)];
            first = std::min(first, lowest);
        }
    }
    std::size_t size = 0;
    for (std::size_t i = 0; i < n_; ++i) {
        row_at_[i] = size - first_[i];
        size += i - first_[i] + 1;
    }
    h_.resize(size);
}

void IslandSolver::assemble(const Problem& p) {
    if (tree_) {
        h_.assign(p.robots[0]->mass_matrix.begin(), p.robots[0]->mass_matrix.end());
    } else {
        std::fill(h_.begin(), h_.end(), 0.0);
        for (std::size_t r = 0; r < p.robots.size(); ++r) {
            const RobotWork& robot = *p.robots[r];
            const auto nv = static_cast<std::size_t>(robot.type->nv);
            const auto offset = static_cast<std::size_t>(p.offsets[r]);
            for (std::size_t i = 0; i < nv; ++i)
                for (int j = static_cast<int>(i); j >= 0;
                     j = robot.type->dof_parent[static_cast<std::size_t>(j)])
                    row_of(offset + i)[offset + static_cast<std::size_t>(j)] =
                        robot.mass_matrix[i * nv + static_cast<std::size_t>(j)];
        }
    }
    for (const JointRow& row : p.joints) row_of(static_cast<std::size_t>(row.dof))[row.dof] += row.d;
    for (const ContactRow& row : p.contacts) add_contact(p, row);
}

/// The rows' share of the Hessian at the present velocities.
void IslandSolver::set_curvatures(const Problem& p, std::span<const double> v) {
    for (JointRow& row : p.joints) {
        const double raw = (row.target - v[static_cast<std::size_t>(row.dof)]) / row.compliance;
        row.d = raw >= row.low && raw <= row.high ? 1.0 / row.compliance : 0.0;
    }
    for (ContactRow& row : p.contacts) {
        row.d_n = row.impulse_n > 0 ? 1.0 / row.compliance_n : 0.0;
        row.d_11 = row.d_12 = row.d_22 = 0;
        if (row.bound <= 0) continue;
        const double speed = std::sqrt(row.u_t1 * row.u_t1 + row.u_t2 * row.u_t2);
        if (speed <= row.bound * row.compliance_t) {
            row.d_11 = row.d_22 = 1.0 / row.compliance_t;
        } else {  // sliding: only turning the direction changes the impulse
            const double s = row.bound / speed, e1 = row.u_t1 / speed, e2 = row.u_t2 / speed;
            row.d_11 = s * (1.0 - e1 * e1), row.d_12 = -s * e1 * e2, row.d_22 = s * (1.0 - e2 * e2);
        }
    }
}

/// J^T D J of one contact.
void IslandSolver::add_contact(const Problem& p, const ContactRow& row) {
    if (row.d_n == 0 && row.d_11 == 0 && row.d_22 == 0) return;
    const ContactColumn* columns = p.columns.data();
    for (std::size_t a = row.first; a < row.last; ++a) {
        const ContactColumn& x = columns[a];
        const double n = row.d_n * x.n, t1 = row.d_11 * x.t1 + row.d_12 * x.t2,
                     t2 = row.d_12 * x.t1 + row.d_22 * x.t2;
        double* h = row_of(static_cast<std::size_t>(x.dof));
        // Columns of one path descend, so in a tree the lower triangle is all that follows.
        for (std::size_t b = tree_ ? a : row.first; b < row.last; ++b) {
            const ContactColumn& y = columns[b];
            if (y.dof <= x.dof) h[y.dof] += n * y.n + t1 * y.t1 + t2 * y.t2;
        }
    }
}

/// step = -H^-1 g
void IslandSolver::factor_and_solve(const Problem& p) {
    for (std::size_t i = 0; i < n_; ++i) step_[i] = -g_[i];
    if (tree_) {
        tree_factor(p.robots[0]->type->dof_parent, h_);
        tree_solve(p.robots[0]->type->dof_parent, h_, step_.data());
    } else {
        skyline_factor(h_, first_, row_at_);
        skyline_solve(h_, first_, row_at_, step_);
    }
}

/// Exact minimum along the step: the root of the derivative, which is monotone; nearly always 1 is good
/// enough.
double IslandSolver::line_search(const Problem& p, std::span<const double> v) {
    double slope0 = 0, quadratic = 0;  // of the smooth part
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.robots[r]->type->nv); ++k) {
            const std::size_t i = static_cast<std::size_t>(p.offsets[r]) + k;
            slope0 += step_[i] * (mv_[i] - p.robots[r]->impulse[k]);
            quadratic += step_[i] * m_step_[i];
        }
    }
    const auto slope = [&](double alpha) {
        double s = slope0 + alpha * quadratic;
        for (const JointRow& row : p.joints) {
            const auto i = static_cast<std::size_t>(row.dof);
            s -= clamped_impulse(row, v[i] + alpha * step_[i]) * step_[i];
        }
        for (const ContactRow& row : p.contacts) {
            const double u_n = row.u_n + alpha * row.du_n;
            const Tangential t =
                friction(row, row.u_t1 + alpha * row.du_t1, row.u_t2 + alpha * row.du_t2, row.bound);
            s -= std::max(0.0, (p.target(row) - u_n) / row.compliance_n) * row.du_n;
            s -= t.t1 * row.du_t1 + t.t2 * row.du_t2;
        }
        return s;
    };
    const double at_zero = slope(0.0);
    double low = 0, high = 1, s_low = at_zero, s_high = slope(1.0);
    if (!(at_zero < 0) || std::fabs(s_high) <= -0.05 * at_zero) return 1.0;
    for (int i = 0; i < 20 && s_high < 0; ++i) low = high, s_low = s_high, high *= 2, s_high = slope(high);
    int side = 0;  // of the last point: -1 below the root
    for (int i = 0; i < 60;
         ++i) {  // regula falsi with the Illinois rule; each third time a bisection, for the kinks are sharp
        const double share = i % 3 == 2 ? 0.5 : s_low / (s_low - s_high);
        const double alpha = low + (high - low) * share;
        const double s = slope(alpha);
        if (std::fabs(s) <= -0.01 * at_zero) return alpha;
        if (s < 0) {
            low = alpha, s_low = s;
            if (side < 0) s_high *= 0.5;
            side = -1;
        } else {
            high = alpha, s_high = s;
            if (side > 0) s_low *= 0.5;
            side = 1;
        }
    }
    return low > 0 ? low : high;
}

/// v += alpha * step, with all that depends on it linearly.
void IslandSolver::move(const Problem& p, double alpha, std::vector<double>& v) {
    for (std::size_t i = 0; i < n_; ++i) {
        v[i] += alpha * step_[i];
        mv_[i] += alpha * m_step_[i];
    }
    for (ContactRow& row : p.contacts)
        row.u_n += alpha * row.du_n, row.u_t1 += alpha * row.du_t1, row.u_t2 += alpha * row.du_t2;
}

/// step = -H^-1 g with the rows' present curvatures, and what follows from it.
void IslandSolver::find_step(const Problem& p) {
    assemble(p);
    factor_and_solve(p);
    times_mass(p, step_, m_step_);
    set_contact_steps(p, step_.data());
}

/// Newton's method until momentum balances and friction bounds agree. False if it does not come near a
/// balance.
bool IslandSolver::newton(const Problem& p, std::vector<double>& v, SolveReport& report) {
    constexpr double kRoughly = 1e-4;  // bounds are updated once the momentum balance is this good
    constexpr double kFar =
        1e-2;  // a residual that shows that the set of sliding and open contacts is not found yet
    constexpr int kFarMax = 8;
    constexpr double kRounding = 1e-8;  // below, a residual that no longer falls is taken for rounding
    int far = 0, bound_updates = 0, stalls = 0;
    double best = 1;
    for (int i = 0;; ++i) {
        update_impulses(p, v, false);
        report.residual = gradient(p);
        if (report.residual <= kRoughly) {
            const bool last = p.position || bound_updates >= p.accuracy.friction_max;
            const double change = last ? 0.0 : update_impulses(p, v, true);
            ++bound_updates;
            report.residual = gradient(p);
            const bool settled = change <= p.accuracy.friction_tolerance;
            stalls = settled && report.residual <= kRounding && report.residual > 0.9 * best ? stalls + 1 : 0;
            best = settled ? std::min(best, report.residual) : 1.0;
            if (settled && (report.residual <= p.accuracy.tolerance || stalls >= 3)) return true;
        }
        if (report.residual > kFar) ++far;
        if (far > kFarMax || i == p.accuracy.newton_max) return report.residual <= kRoughly;
        set_curvatures(p, v);
        find_step(p);
        move(p, line_search(p, v), v);
        ++report.iterations;
    }
}

SolveReport IslandSolver::solve(const Accuracy& accuracy, std::span<const RobotWork* const> robots,
                                std::span<const int> offsets, std::span<JointRow> joints,
                                std::span<const ContactColumn> columns, std::span<ContactRow> contacts,
                                bool position, std::vector<double>& v) {
    const Problem p{accuracy, robots, offsets, joints, columns, contacts, position};
    start(p, v);
    SolveReport report;
    start_bounds_.clear();
    for (const ContactRow& row : contacts) start_bounds_.push_back(row.bound);
    if (newton(p, v, report)) return report;
    // Where many contacts stand between sticking and sliding, each Newton step turns only one of them: the
    // potential of hard rows is all edges. The interior point method goes through the middle, in a number of
    // steps that hardly depends on the problem: once with the bounds of the last tick, once with those that
    // follow from it.
    for (std::size_t c = 0; c < contacts.size(); ++c) contacts[c].bound = start_bounds_[c];
    interior_point(p, v, report);
    if (position) return report;
    for (ContactRow& row : contacts) row.bound = row.mu * row.impulse_n;
    interior_point(p, v, report);
    return report;
}

}  // namespace roboss
