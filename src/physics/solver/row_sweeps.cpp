// See row_sweeps.h; sweep_rows.cpp prepares the rows.
#include "physics/solver/row_sweeps.h"

#include <algorithm>
#include <cmath>

#include "core/pair.h"
#include "physics/solver/slip_disc.h"

namespace roboss {
namespace {

double squared(const RowSweeps::ContactImpulse& x, double inverse_n, double inverse_t) {
    return x.n * x.n * inverse_n + (x.t1 * x.t1 + x.t2 * x.t2) * inverse_t;
}

/// The impulse moved along the search direction, to which the last change is added.
[[gnu::always_inline]] inline double accelerated(double now, double change, double share, double& direction) {
    const double old = share * direction;
    direction = old + change;
    return now + old;
}

}  // namespace

SweepReport RowSweeps::run(const Problem& p, const SweepPlan& plan, std::vector<double>& v) {
    converged_ = plan.start_tolerance;
    start(p, v.size());
    return sweep_all(p, plan, v);
}

void RowSweeps::go_on(const Problem& p, int most, std::vector<double>& v) {
    converged_ *= 1e-2;
    sweep_all(p, {.most = most, .start_tolerance = converged_}, v);
}

void RowSweeps::take_up(const Problem& p, int most, std::vector<double>& v) {
    y_ = y_free_;
    start_impulses(p, true);
    sweep_all(p, {.most = most, .start_tolerance = converged_}, v);
}

SweepReport RowSweeps::sweep_all(const Problem& p, const SweepPlan& plan, std::vector<double>& v) {
    SweepProgress progress(plan);
    y_before_ = y_;
    double change = sweep(0);
    progress.begin(squared_impulses(), plan.settle_tolerance > 0 ? squared_motion(p) : 0);
    while (!progress.ends(change)) {
        accelerate(progress.share());
        change = sweep(progress.share());
    }
    take_velocities(p, v);
    return progress.report();
}

void RowSweeps::push(const Support& support, double impulse) {
    const double* w = numbers_.data() + support.numbers;
    for (std::uint32_t r = support.first_run; r < support.last_run; ++r) {
        double* y = y_.data() + runs_[r].first;
        const std::size_t count = runs_[r].count;
        for (std::size_t k = 0; k < count; k += 2)
            put(y + k, pair_at(y + k) + both(impulse) * pair_at(w + k));
        w += count;
    }
}

void RowSweeps::push(const Support& support, const ContactImpulse& impulse) {
    const double* w = numbers_.data() + support.numbers;
    for (std::uint32_t r = support.first_run; r < support.last_run; ++r) {
        double* y = y_.data() + runs_[r].first;
        const std::size_t count = runs_[r].count;
        for (std::size_t k = 0; k < count; k += 2)
            put(y + k, pair_at(y + k) +
                           (both(impulse.n) * pair_at(w + k) + both(impulse.t1) * pair_at(w + count + k) +
                            both(impulse.t2) * pair_at(w + 2 * count + k)));
        w += 3 * count;
    }
}

double RowSweeps::sweep_scalar(Scalar& row, double share) {
    const double before = accelerated(row.now, row.change, share, row.direction);
    const double* w = numbers_.data() + row.support.numbers;
    Pair sum{};
    for (std::uint32_t r = row.support.first_run; r < row.support.last_run; ++r) {
        const double* y = y_.data() + runs_[r].first;
        for (std::size_t k = 0; k < runs_[r].count; k += 2) sum += pair_at(w + k) * pair_at(y + k);
        w += runs_[r].count;
    }
    const double wanted = before + (row.target - (sum[0] + sum[1]) - row.compliance * before) * row.mass;
    row.now = std::clamp(wanted, row.low, row.high);
    row.change = row.now - before;
    if (row.change == 0) return 0;
    push(row.support, row.change);
    return row.change * row.change * row.inverse_mass;
}

double RowSweeps::sweep_contact(Contact& row, double share) {
    const ContactImpulse before{accelerated(row.now.n, row.change.n, share, row.direction.n),
                                accelerated(row.now.t1, row.change.t1, share, row.direction.t1),
                                accelerated(row.now.t2, row.change.t2, share, row.direction.t2)};
    const double* w = numbers_.data() + row.support.numbers;
    Pair n{}, t1{}, t2{};
    for (std::uint32_t r = row.support.first_run; r < row.support.last_run; ++r) {
        const double* y = y_.data() + runs_[r].first;
        const std::size_t count = runs_[r].count;
        for (std::size_t k = 0; k < count; k += 2) {
            const Pair at = pair_at(y + k);
            n += pair_at(w + k) * at;
            t1 += pair_at(w + count + k) * at, t2 += pair_at(w + 2 * count + k) * at;
        }
        w += 3 * count;
    }
    ContactImpulse now;
    now.n = before.n + (row.target_n - (n[0] + n[1]) - row.compliance * before.n) * row.mass_n;
    now.n = std::clamp(now.n, row.low, row.high);
    row.change = {};
    if (now.n == 0 && before.n == 0 && before.t1 == 0 && before.t2 == 0) {  // most do not push
        row.now = now;
        return 0;
    }
    const double dn = now.n - before.n, u_1 = t1[0] + t1[1] - row.target_1,
                 u_2 = t2[0] + t2[1] - row.target_2;
    now.t1 = before.t1 - (u_1 + row.n_on_1 * dn + row.slip * before.t1) * row.mass_t;
    now.t2 = before.t2 - (u_2 + row.n_on_2 * dn + row.slip * before.t2) * row.mass_t;
    const double bound = row.bound + row.coefficient * now.n, size2 = now.t1 * now.t1 + now.t2 * now.t2;
    if (size2 > bound * bound) {
        const double cut = bound / std::sqrt(size2);
        now.t1 *= cut, now.t2 *= cut;
    }
    row.now = now;
    row.change = {dn, now.t1 - before.t1, now.t2 - before.t2};
    push(row.support, row.change);
    return squared(row.change, row.inverse_n, row.inverse_t);
}

/// One sweep; returns the squared change of the impulses, each by its effective mass.
double RowSweeps::sweep(double share) {
    double change = 0;
    for (Scalar& row : scalars_) change += sweep_scalar(row, share);
    for (Contact& row : contacts_) change += sweep_contact(row, share);
    return change;
}

double RowSweeps::squared_impulses() const {
    double sum = 0;
    for (const Scalar& row : scalars_) sum += row.now * row.now * row.inverse_mass;
    for (const Contact& row : contacts_) sum += squared(row.now, row.inverse_n, row.inverse_t);
    return sum;
}

/// Of the velocities that the solve starts from along the contact points, each by its effective mass.
double RowSweeps::squared_motion(const Problem& p) const {
    double sum = 0;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        const ContactRow& row = p.rows.contacts[order_[k]];
        sum += row.normal.u * row.normal.u * contacts_[k].mass_n +
               (row.slip.u_1 * row.slip.u_1 + row.slip.u_2 * row.slip.u_2) * contacts_[k].mass_t;
    }
    return sum;
}

/// Moves along the search direction, shortened by `share`, and adds the last sweep's change to it. Velocities
/// are linear in the impulses, so they have a search direction of their own. Keeps them.
void RowSweeps::accelerate(double share) {
    for (std::size_t i = 0; i < y_.size(); ++i) {
        const double old = share * y_direction_[i], now = y_[i];
        y_direction_[i] = old + (now - y_before_[i]);
        y_[i] = y_before_[i] = now + old;
    }
}

/// v = L^-1 D^-1/2 y
void RowSweeps::take_velocities(const Problem& p, std::vector<double>& v) const {
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const DofPaths& paths = p.robots[r]->type->paths;
        const double *y = y_.data() + first_[r], *root = roots_.data() + first_[r],
                     *factor = factors_.data() + factor_first_[r];
        double* to = v.data() + p.offsets[r];
        for (std::size_t i = 0; i < paths.size(); ++i)
            to[i] =
                y[i] * root[i] - path::dot(factor + paths.row(i), paths.path(i), 0, paths.length(i) - 1, to);
    }
}

bool sweeps_know_friction(const IslandRows& rows) {
    return rows.angulars.empty() && std::ranges::none_of(rows.contacts, [](const ContactRow& row) {
               return slip_disc::slips(row.slip);
           });
}

}  // namespace roboss
