// See bond_projection.h.
#include "physics/bonds/bond_projection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/coordinates.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

// A row whose mobility, given the others, is below this share of its own counts as implied by them (two
// grippers on stiff arms hold one box).
constexpr double kImplied = 1e-9;
constexpr double kClosed = 1e-13;    // m or rad: less is left
constexpr double kRounding = 1e-15;  // relative, of positions
constexpr double kStepMax = 0.2;     // rad or m, of one Newton step
constexpr int kNewtonMax = 4;        // of one tick

}  // namespace

void BondProjection::gather_robots(std::span<const RobotWork> robots, std::span<const HeldBond> bonds) {
    members_.clear();
    for (const HeldBond& bond : bonds) {
        members_.push_back(bond.holder);
        if (bond.other != HeldBond::kScenery) members_.push_back(bond.other);
    }
    std::ranges::sort(members_);
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
    if (works_.size() < members_.size()) works_.resize(members_.size());
    offsets_.assign(1, 0);
    for (std::size_t m = 0; m < members_.size(); ++m) {
        const RobotWork& robot = robots[members_[m]];
        works_[m].id = robot.id, works_[m].take(*robot.type, *robot.state);
        offsets_.push_back(offsets_.back() + static_cast<std::size_t>(robot.type->nv));
    }
    bonds_.assign(bonds.begin(), bonds.end());
    for (HeldBond& bond : bonds_) {
        bond.holder = static_cast<std::uint32_t>(slot_of(bond.holder));
        if (bond.other != HeldBond::kScenery) bond.other = static_cast<std::uint32_t>(slot_of(bond.other));
    }
    places_.find(bonds_, members_.size());
}

std::size_t BondProjection::slot_of(std::uint32_t robot) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(members_, robot) - members_.begin());
}

/// Where the robots are now.
void BondProjection::place() {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        RobotWork& work = works_[m];
        forward_kinematics<double>(*work.type, work.state->q, work);
        for (BodyWork& body : work.bodies) body.velocity = body.bias = {};
    }
}

void BondProjection::add_bond_rows(std::size_t number) {
    const HeldBond& held = bonds_[number];
    const BondFrames frames = frames_of({works_.data(), members_.size()}, held);
    const Spatial off{frames.twist, frames.slip()};
    slack_ = std::max(slack_, kClosed + kRounding * norm(frames.p_W));
    for (std::size_t k = 0; k < 6; ++k) {
        Row row;
        row.axis = bond_axis(k), row.bond = static_cast<int>(number);
        row.slots = {held.holder, held.other == HeldBond::kScenery ? kNone : held.other};
        row.first = columns_.size(), row.error = dot(off, row.axis);
        const auto add_side = [&](std::uint32_t slot, int body, const Vec3& p_W, double sign) {
            visit_bond_columns(works_[slot], body, p_W, row.axis, [&](int dof, double j) {
                columns_.push_back({offsets_[slot] + static_cast<std::size_t>(dof), sign * j});
            });
        };
        add_side(held.holder, held.body, frames.p_W, -1.0);
        if (held.other != HeldBond::kScenery) add_side(held.other, held.other_body, frames.p_other_W, 1.0);
        row.last = columns_.size();
        rows_.push_back(row);
    }
}

/// Loops and couplings of one robot.
void BondProjection::add_own_rows(std::size_t slot) {
    const RobotWork& work = works_[slot];
    if (!work.type->has_equalities()) return;
    gather_equalities(work, work.state->q, own_);
    for (const EqualityRow& equality : own_.rows) {
        if (!(equality.mobility > 0)) continue;
        Row row;
        row.first = columns_.size(), row.error = equality.error;
        row.slots = {slot, kNone};
        for (std::size_t c = equality.first; c < equality.last; ++c)
            columns_.push_back(
                {offsets_[slot] + static_cast<std::size_t>(own_.columns[c].dof), own_.columns[c].j});
        row.last = columns_.size();
        rows_.push_back(row);
    }
}

/// All rows as the robots are placed; returns the largest error.
double BondProjection::gather_rows() {
    rows_.clear(), columns_.clear();
    slack_ = kClosed;
    for (std::size_t b = 0; b < bonds_.size(); ++b) add_bond_rows(b);
    for (std::size_t m = 0; m < members_.size(); ++m) add_own_rows(m);
    double largest = 0;
    for (const Row& row : rows_) largest = std::max(largest, std::fabs(row.error));
    return largest;
}

double BondProjection::times(const Row& row, std::span<const double> x) const {
    double sum = 0;
    for (std::size_t c = row.first; c < row.last; ++c) sum += columns_[c].j * x[columns_[c].dof];
    return sum;
}

/// The order of the rows, and the envelope of each: from the first row that moves one of its robots.
void BondProjection::sort_rows() {
    const std::size_t count = rows_.size();
    order_.resize(count), begin_.resize(count), start_.resize(count);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const auto place = [&](std::size_t row) {
        const Row& r = rows_[row];
        const std::size_t one = places_[r.slots[0]];
        return r.slots[1] == kNone ? one : std::max(one, places_[r.slots[1]]);
    };
    std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
        const std::size_t at_a = place(a), at_b = place(b);
        return at_a != at_b ? at_a < at_b : a < b;
    });
    earliest_.assign(members_.size(), kNone);
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        begin_[i] = i;
        for (const std::size_t slot : rows_[order_[i]].slots) {
            if (slot == kNone) continue;
            earliest_[slot] = std::min(earliest_[slot], i);
            begin_[i] = std::min(begin_[i], earliest_[slot]);
        }
        start_[i] = size;
        size += i - begin_[i] + 1;
    }
    a_.assign(size, 0.0);
}

/// Its part of M^-1 J^T, and its scale.
void BondProjection::prepare_row(Row& row) {
    double mobility = 0;
    std::size_t column = row.first;
    for (std::size_t side = 0; side < 2 && row.slots[side] != kNone; ++side) {
        const std::size_t slot = row.slots[side], offset = offsets_[slot], end = offsets_[slot + 1];
        row.y[side] = y_.size();
        y_.resize(y_.size() + (end - offset), 0.0);
        double* const y = y_.data() + row.y[side];
        const std::size_t first = column;
        for (; column < row.last && columns_[column].dof >= offset && columns_[column].dof < end; ++column)
            y[columns_[column].dof - offset] += columns_[column].j;
        tree_solve(works_[slot].type->paths, works_[slot].mass_matrix.data(), y);
        for (std::size_t c = first; c < column; ++c) mobility += columns_[c].j * y[columns_[c].dof - offset];
    }
    row.scale = mobility > 0 ? 1.0 / std::sqrt(mobility) : 0.0;
}

/// row * M^-1 * other^T.
double BondProjection::coupling(const Row& row, const Row& other) const {
    double sum = 0;
    for (std::size_t side = 0; side < 2 && other.slots[side] != kNone; ++side) {
        const std::size_t slot = other.slots[side], offset = offsets_[slot], end = offsets_[slot + 1];
        if (row.slots[0] != slot && row.slots[1] != slot) continue;
        const double* const y = y_.data() + other.y[side];
        for (std::size_t c = row.first; c < row.last; ++c)
            if (const std::size_t dof = columns_[c].dof; dof >= offset && dof < end)
                sum += columns_[c].j * y[dof - offset];
    }
    return sum;
}

/// Mass matrices, M^-1 J^T in y_ and J M^-1 J^T in a_, scaled to a diagonal of ones, and its factor.
void BondProjection::prepare() {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        RobotWork& work = works_[m];
        compute_inertias(*work.type, work);
        compute_mass_matrix<double>(*work.type, 0.0, work);
        tree_factor(work.type->paths, work.mass_matrix.data());
    }
    y_.clear();
    for (Row& row : rows_) prepare_row(row);
    sort_rows();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[order_[i]];
        for (std::size_t j = begin_[i]; j <= i; ++j) {
            const Row& other = rows_[order_[j]];
            at(i, j) = row.scale * other.scale * coupling(row, other);
        }
    }
    factor();
}

/// Cholesky's method by rows. The diagonal of a row that the rows before it imply becomes zero.
void BondProjection::factor() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t j = begin_[i]; j <= i; ++j) {
            double sum = at(i, j);
            for (std::size_t k = std::max(begin_[i], begin_[j]); k < j; ++k) sum -= at(i, k) * at(j, k);
            if (j == i)
                at(i, i) = sum > kImplied ? std::sqrt(sum) : 0.0;
            else
                at(i, j) = at(j, j) > 0 ? sum / at(j, j) : 0.0;
        }
    }
}

/// change_ = M^-1 J^T impulses_, such that J change = wanted.
void BondProjection::solve(std::span<const double> wanted) {
    const std::size_t count = rows_.size();
    x_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        double sum = wanted[order_[i]] * rows_[order_[i]].scale;
        for (std::size_t k = begin_[i]; k < i; ++k) sum -= at(i, k) * x_[k];
        x_[i] = at(i, i) > 0 ? sum / at(i, i) : 0.0;
    }
    for (std::size_t i = count; i-- > 0;) {
        x_[i] = at(i, i) > 0 ? x_[i] / at(i, i) : 0.0;
        for (std::size_t k = begin_[i]; k < i; ++k) x_[k] -= at(i, k) * x_[i];
    }
    change_.assign(offsets_.back(), 0.0), impulses_.assign(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const Row& row = rows_[order_[i]];
        const double impulse = impulses_[order_[i]] = x_[i] * row.scale;
        for (std::size_t side = 0; side < 2 && row.slots[side] != kNone; ++side) {
            const std::size_t offset = offsets_[row.slots[side]],
                              size = offsets_[row.slots[side] + 1] - offset;
            for (std::size_t k = 0; k < size; ++k) change_[offset + k] += impulse * y_[row.y[side] + k];
        }
    }
}

void BondProjection::close(std::span<const RobotWork> robots, std::span<const HeldBond> bonds) {
    gather_robots(robots, bonds);
    const auto part = [&](std::size_t m) {
        return std::span(change_).subspan(offsets_[m], offsets_[m + 1] - offsets_[m]);
    };
    place();
    for (int i = 0; i < kNewtonMax && gather_rows() > slack_; ++i) {
        wanted_.clear();
        for (const Row& row : rows_) wanted_.push_back(-row.error);
        prepare();
        solve(wanted_);
        double step = 0;
        for (const double x : change_) step = std::max(step, std::fabs(x));
        const double share = step > kStepMax ? kStepMax / step : 1.0;
        for (std::size_t m = 0; m < members_.size(); ++m)
            advance_coordinates<double>(*works_[m].type, part(m), share, works_[m].state->q);
        place();
        if (step <= slack_) break;
    }
    gather_rows();
    wanted_.clear();
    change_.clear();
    for (std::size_t m = 0; m < members_.size(); ++m)
        change_.insert(change_.end(), works_[m].state->v.begin(), works_[m].state->v.end());
    for (const Row& row : rows_) wanted_.push_back(-times(row, change_));
    prepare();
    solve(wanted_);
    for (std::size_t m = 0; m < members_.size(); ++m)
        for (std::size_t k = 0; k < part(m).size(); ++k) works_[m].state->v[k] += part(m)[k];
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (rows_[r].bond < 0) continue;
        Bond& bond = *bonds_[static_cast<std::size_t>(rows_[r].bond)].bond;
        bond.torque_impulse += rows_[r].axis.angular * impulses_[r];
        bond.force_impulse += rows_[r].axis.linear * impulses_[r];
    }
}

}  // namespace roboss
