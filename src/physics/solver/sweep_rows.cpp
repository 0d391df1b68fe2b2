// The rows of RowSweeps before it sweeps: their vectors w, their effective masses, their order.
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/pair.h"
#include "physics/solver/row_sweeps.h"

namespace roboss {
namespace {

/// Cuts friction to its bound.
void cut(double bound, RowSweeps::ContactImpulse& x) {
    const double size2 = x.t1 * x.t1 + x.t2 * x.t2;
    if (!(size2 > bound * bound)) return;
    const double share = bound / std::sqrt(size2);
    x.t1 *= share, x.t2 *= share;
}

}  // namespace

void RowSweeps::start(const Problem& p, std::size_t n) {
    numbers_.clear(), runs_.clear(), scalars_.clear(), contacts_.clear();
    start_robots(p, n);
    joints_ = p.rows.joints.size();
    for (const JointRow& row : p.rows.joints) add_joint(p, row);
    for (const CouplingRow& row : p.rows.couplings) add_coupling(p, row);
    order_contacts(p);
    for (const std::uint32_t index : order_) add_contact(p, index);
    start_impulses(p, p.again || p.position);
}

/// Mass matrices, and velocities without rows: y = D^-1/2 L^-T impulse.
void RowSweeps::start_robots(const Problem& p, std::size_t n) {
    factors_.clear(), factor_first_.clear();
    robot_of_.resize(n);
    first_.assign(1, 0);
    std::size_t most = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const std::size_t nv = p.robots[r]->type->paths.size();
        std::fill_n(robot_of_.begin() + p.offsets[r], nv, r);
        first_.push_back(first_.back() + ((nv + 2) & ~std::size_t{1}));  // room for the end of the last run
        most = std::max(most, nv);
    }
    entries_.assign(most, {}), marks_.assign(most, 0);
    y_free_.assign(first_.back(), 0.0), roots_.assign(first_.back(), 0.0);
    y_direction_.assign(first_.back(), 0.0);
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const Mechanics<double>& robot = *p.robots[r];
        const DofPaths& paths = robot.type->paths;
        factor_first_.push_back(factors_.size());
        factors_.insert(factors_.end(), robot.mass_matrix.begin(), robot.mass_matrix.end());
        double *factor = factors_.data() + factor_first_[r], *y = y_free_.data() + first_[r],
               *root = roots_.data() + first_[r];
        tree_factor(paths, factor);
        std::copy(robot.impulse.begin(), robot.impulse.end(), y);
        for (std::size_t i = paths.size(); i-- > 0;) {
            path::subtract(factor + paths.row(i), paths.path(i), 0, paths.length(i) - 1, y[i], y);
            root[i] = std::sqrt(factor[paths.diagonal(i)]);
            y[i] *= root[i];
        }
    }
    y_ = y_free_;
}

/// Contacts of the same two robots follow each other, and those of pairs that share no robot stand side by
/// side: one colour after the other, of a greedy colouring of the pairs. So the processor need not wait for
/// one contact before it begins the next.
void RowSweeps::order_contacts(const Problem& p) {
    constexpr std::uint32_t kColours = 64;
    const std::vector<ContactRow>& rows = p.rows.contacts;
    taken_.assign(p.robots.size(), 0);
    place_of_.resize(rows.size()), order_.resize(rows.size());
    std::array<std::uint32_t, kColours + 1> counts{};
    std::size_t last_a = p.robots.size(), last_b = last_a;
    std::uint32_t colour = 0;
    for (std::size_t c = 0; c < rows.size(); ++c) {
        if (rows[c].first != rows[c].last) {
            const std::size_t a = robot_of_[static_cast<std::size_t>(p.rows.columns.dof[rows[c].first])],
                              b = robot_of_[static_cast<std::size_t>(p.rows.columns.dof[rows[c].last - 1])];
            if (a != last_a || b != last_b) {
                colour = static_cast<std::uint32_t>(std::countr_one(taken_[a] | taken_[b]));
                colour = std::min(colour, kColours - 1);
                taken_[a] |= std::uint64_t{1} << colour, taken_[b] |= std::uint64_t{1} << colour;
                last_a = a, last_b = b;
            }
        }
        place_of_[c] = colour;
        ++counts[colour + 1];
    }
    for (std::uint32_t k = 0; k < kColours; ++k) counts[k + 1] += counts[k];
    for (std::size_t c = 0; c < rows.size(); ++c) {
        place_of_[c] = counts[place_of_[c]]++;
        order_[place_of_[c]] = static_cast<std::uint32_t>(c);
    }
}

/// An entry of J; marks the unknowns that a row on this one acts on.
void RowSweeps::touch(const Problem& p, std::size_t robot, int dof, const Entry& entry) {
    const DofPaths& paths = p.robots[robot]->type->paths;
    const auto i = static_cast<std::size_t>(dof - p.offsets[robot]);
    for (std::size_t k = 0; k < 4; ++k) entries_[i][k] += entry[k];
    const int* path = paths.path(i);
    for (std::size_t k = paths.length(i); k-- > 0 && !marks_[static_cast<std::size_t>(path[k])];) {
        marks_[static_cast<std::size_t>(path[k])] = 1;
        support_.push_back(path[k]);
    }
}

/// w of what was touched of a robot, in runs, and its products. Nothing is touched then.
void RowSweeps::add_support(const Problem& p, std::size_t robot, std::size_t vectors) {
    const DofPaths& paths = p.robots[robot]->type->paths;
    const double *factor = factors_.data() + factor_first_[robot], *root = roots_.data() + first_[robot];
    std::ranges::sort(support_);
    for (std::size_t s = support_.size(); s-- > 0;) {
        const auto i = static_cast<std::size_t>(support_[s]);
        double* const x = entries_[i].data();
        const Pair nt = pair_at(x), t = pair_at(x + 2);
        const double* row = factor + paths.row(i);
        const int* path = paths.path(i);
        for (std::size_t k = 0; k + 1 < paths.length(i); ++k) {
            double* above = entries_[static_cast<std::size_t>(path[k])].data();
            put(above, pair_at(above) - both(row[k]) * nt);
            put(above + 2, pair_at(above + 2) - both(row[k]) * t);
        }
        put(x, nt * both(root[i])), put(x + 2, t * both(root[i]));
    }
    for (std::size_t s = 0, end = 0; s < support_.size(); s = end) {
        while (end < support_.size() && support_[end] - support_[s] == static_cast<int>(end - s)) ++end;
        const std::size_t count = (end - s + 1) & ~std::size_t{1}, at = numbers_.size();
        numbers_.resize(at + vectors * count);
        for (std::size_t k = 0; k < end - s; ++k) {
            Entry& w = entries_[static_cast<std::size_t>(support_[s + k])];
            for (std::size_t i = 0; i < vectors; ++i) numbers_[at + i * count + k] = w[i];
            products_[0] += w[0] * w[0], products_[1] += w[1] * w[1], products_[2] += w[2] * w[2];
            products_[3] += w[0] * w[1], products_[4] += w[0] * w[2];
            w = {};
            marks_[static_cast<std::size_t>(support_[s + k])] = 0;
        }
        runs_.push_back({static_cast<std::uint32_t>(first_[robot]) + static_cast<std::uint32_t>(support_[s]),
                         static_cast<std::uint32_t>(count)});
    }
    support_.clear();
}

void RowSweeps::add_scalar(const BoundedRow& row, std::size_t first_run, std::size_t first_number) {
    const double inverse = products_[0] + row.compliance;
    scalars_.push_back({.support = {static_cast<std::uint32_t>(first_run),
                                    static_cast<std::uint32_t>(runs_.size()), first_number},
                        .target = row.target,
                        .compliance = row.compliance,
                        .low = row.low,
                        .high = row.high,
                        .mass = 1.0 / inverse,
                        .inverse_mass = inverse});
}

void RowSweeps::add_joint(const Problem& p, const JointRow& row) {
    const std::size_t run = runs_.size(), number = numbers_.size();
    const std::size_t robot = robot_of_[static_cast<std::size_t>(row.dof)];
    products_ = {};
    touch(p, robot, row.dof, {1, 0, 0, 0});
    add_support(p, robot, 1);
    add_scalar(row, run, number);
}

void RowSweeps::add_coupling(const Problem& p, const CouplingRow& row) {
    const std::size_t run = runs_.size(), number = numbers_.size();
    products_ = {};
    const auto robot_at = [&](std::size_t c) {
        return robot_of_[static_cast<std::size_t>(p.rows.coupling_columns[c].dof)];
    };
    const auto add = [&](std::size_t robot) {
        for (std::size_t c = row.first; c < row.last; ++c)
            if (robot_at(c) == robot)
                touch(p, robot, p.rows.coupling_columns[c].dof, {p.rows.coupling_columns[c].j, 0, 0, 0});
        add_support(p, robot, 1);
    };
    if (row.first != row.last) {
        const std::size_t a = robot_at(row.first);
        add(a);
        for (std::size_t c = row.first; c < row.last; ++c)
            if (robot_at(c) != a) {
                add(robot_at(c));
                break;
            }
    }
    add_scalar(row, run, number);
}

void RowSweeps::add_contact(const Problem& p, std::size_t index) {
    const ContactRow& row = p.rows.contacts[index];
    const ContactColumns& columns = p.rows.columns;
    const std::size_t run = runs_.size();
    Contact contact;
    contact.support.numbers = numbers_.size();
    products_ = {};
    for (std::size_t c = row.first; c < row.last;) {  // A's columns, then B's
        const std::size_t robot = robot_of_[static_cast<std::size_t>(columns.dof[c])];
        for (; c < row.last && robot_of_[static_cast<std::size_t>(columns.dof[c])] == robot; ++c)
            touch(p, robot, columns.dof[c], {columns.n[c], columns.t1[c], columns.t2[c], 0});
        add_support(p, robot, 3);
    }
    contact.support.first_run = static_cast<std::uint32_t>(run);
    contact.support.last_run = static_cast<std::uint32_t>(runs_.size());
    const BoundedRow& normal = row.normal;
    const FrictionDisc& slip = row.slip;
    contact.target_n = normal.target, contact.compliance = normal.compliance;
    contact.low = normal.low, contact.high = normal.high;
    contact.target_1 = slip.target_1, contact.target_2 = slip.target_2, contact.slip = slip.compliance;
    (p.position ? contact.bound : contact.coefficient) = p.position ? slip.bound : slip.coefficient;
    contact.inverse_n = products_[0] + normal.compliance;
    contact.inverse_t = std::max(products_[1], products_[2]) + slip.compliance;
    contact.mass_n = 1.0 / contact.inverse_n, contact.mass_t = 1.0 / contact.inverse_t;
    contact.n_on_1 = products_[3], contact.n_on_2 = products_[4];
    contacts_.push_back(contact);
}

/// `again`: from the impulses that the rows hold.
void RowSweeps::start_impulses(const Problem& p, bool again) {
    for (std::size_t i = 0; i < scalars_.size(); ++i) {
        Scalar& row = scalars_[i];
        row.change = row.direction = row.now = 0;
        if (!again) continue;
        row.now = i < joints_ ? p.rows.joints[i].impulse : p.rows.couplings[i - joints_].impulse;
        push(row.support, row.now);
    }
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        Contact& row = contacts_[k];
        const ContactRow& from = p.rows.contacts[order_[k]];
        const FrictionDisc& slip = from.slip;
        row.change = row.direction = {};
        row.now = {from.normal.impulse, slip.impulse_1, slip.impulse_2};
        if (!again)
            row.now.t1 = slip.target_1 / slip.compliance, row.now.t2 = slip.target_2 / slip.compliance;
        cut(row.bound + row.coefficient * row.now.n, row.now);
        push(row.support, row.now);
    }
    std::ranges::fill(y_direction_, 0.0);
}

}  // namespace roboss
