// See equality.h.
#include "physics/dynamics/equality.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/check.h"
#include "model/coordinates.h"
#include "model/loop_closure.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

// A row whose free mobility, given the others, is below this share of its nominal one counts as implied by
// them: hinges of a planar linkage that are parallel to 3e-4 rad do not lock it.
constexpr double kImplied = 1e-7;
constexpr double kClosed = 1e-14;        // m or rad
constexpr double kNearlyClosed = 1e-10;  // m or rad: rounding decides which of two steps is better
constexpr double kStepMax = 0.2;         // rad or m, of one Newton step
constexpr int kNewtonMax = 4;            // of one tick
constexpr int kHalvedMax = 4;            // of one Newton step
constexpr double kMoreError = 2;         // after a Newton step that is taken, times the error before

BodyKinematics motion_of(const RobotWork& work, std::span<const double> q, int body) {
    if (body < 0) return {{to_matrix(Quat{q[3], q[4], q[5], q[6]}), {}}, {}, {}};
    const BodyWork& b = work.bodies[static_cast<std::size_t>(body)];
    return {{b.X_WB.R, b.X_WB.p - work.origin}, b.velocity, b.bias};
}

void add_loop(const RobotWork& work, std::span<const double> q, std::size_t index, Equalities& out) {
    const LoopJoint& loop = work.type->loops[index];
    const ClosureRows closure =
        closure_rows(loop, motion_of(work, q, loop.body_a), motion_of(work, q, loop.body_b));
    for (const ClosureRow& condition : closure.all()) {
        EqualityRow row;
        row.first = out.columns.size();
        if (out.has_columns)
            visit_between(*work.type, loop.body_a, loop.body_b, [&](std::size_t k, double sign) {
                out.columns.push_back({static_cast<int>(k), sign * dot(work.axes[k], condition.wrench)});
            });
        row.last = out.columns.size();
        row.error = condition.error, row.curvature = condition.curvature;
        row.mobility = condition.mobility;
        row.loop = static_cast<int>(index), row.wrench = condition.wrench;
        out.rows.push_back(row);
    }
}

/// How fast a hinge or slide moves.
double rate_of(const RobotWork& work, int dof) {
    const int b = work.type->dofs[static_cast<std::size_t>(dof)].body;
    const int parent = work.type->bodies[static_cast<std::size_t>(b)].parent;
    Spatial motion = work.bodies[static_cast<std::size_t>(b)].velocity;
    if (parent >= 0) motion = motion - work.bodies[static_cast<std::size_t>(parent)].velocity;
    const Spatial& axis = work.axes[static_cast<std::size_t>(work.type->base_nv() + dof)];
    return dot(axis, motion) / dot(axis, axis);
}

void add_coupling(const RobotWork& work, std::span<const double> q, const CoordinateCoupling& coupling,
                  Equalities& out) {
    const RobotType& type = *work.type;
    const auto value = [&](int dof) {
        const Dof& d = type.dofs[static_cast<std::size_t>(dof)];
        return q[static_cast<std::size_t>(type.bodies[static_cast<std::size_t>(d.body)].q_index)];
    };
    EqualityRow row;
    row.first = out.columns.size();
    out.columns.push_back({type.base_nv() + coupling.follower, 1.0});
    const double leader = value(coupling.leader);
    out.columns.push_back({type.base_nv() + coupling.leader, -coupling.slope(leader)});
    row.last = out.columns.size();
    row.error = coupling.gap(value(coupling.follower), leader);
    if (coupling.is_curved()) {
        const double rate = rate_of(work, coupling.leader);
        row.curvature = -coupling.bend(leader) * rate * rate;
    }
    row.mobility = coupling.inverse_inertia;
    out.rows.push_back(row);
}

/// A robot with an elimination has loops alone, and how many rows a loop has is up to its kind.
void gather_loops(const RobotWork& work, std::span<const double> q, const Team& team, Equalities& out) {
    constexpr std::size_t kBlock = 32;  // loops
    const std::vector<LoopJoint>& loops = work.type->loops;
    const auto rows_of = [&](const LoopJoint& loop) {
        return closure_rows(loop, motion_of(work, q, loop.body_a), motion_of(work, q, loop.body_b));
    };
    out.has_columns = false, out.columns.clear();
    if (out.stamp != work.type->elimination.pattern.stamp()) {
        out.stamp = work.type->elimination.pattern.stamp();
        out.first_row.assign(1, 0);
        for (const LoopJoint& loop : loops)
            out.first_row.push_back(out.first_row.back() + rows_of(loop).count);
    }
    out.rows.resize(out.first_row.back());
    team.run_blocks(loops.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const ClosureRows closure = rows_of(loops[i]);
            ROBOSS_CHECK(closure.count == out.first_row[i + 1] - out.first_row[i],
                         std::to_string(closure.count) + " rows of a loop");
            for (std::size_t k = 0; k < closure.count; ++k) {
                const ClosureRow& condition = closure.rows[k];
                EqualityRow& row = out.rows[out.first_row[i] + k];
                row.first = row.last = 0;
                row.error = condition.error, row.curvature = condition.curvature;
                row.mobility = condition.mobility;
                row.loop = static_cast<int>(i), row.wrench = condition.wrench;
            }
        }
    });
}

void gather(const RobotWork& work, std::span<const double> q, bool with_columns, Equalities& out) {
    out.columns.clear(), out.rows.clear();
    out.has_columns = with_columns;
    for (std::size_t i = 0; i < work.type->loops.size(); ++i) add_loop(work, q, i, out);
    for (const CoordinateCoupling& coupling : work.type->couplings) add_coupling(work, q, coupling, out);
}

/// How the bodies move about O at the rates x of what is not locked.
void find_motions(const RobotWork& work, std::span<const double> x, std::span<const char> locked,
                  std::vector<Spatial>& motions) {
    const RobotType& type = *work.type;
    motions.resize(type.bodies.size());
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        Spatial motion;
        if (body.parent >= 0) motion = motions[static_cast<std::size_t>(body.parent)];
        for (int k = 0; k < body.nv; ++k) {
            const auto dof = static_cast<std::size_t>(body.v_index + k);
            if (locked.empty() || !locked[dof]) motion += work.axes[dof] * x[dof];
        }
        motions[b] = motion;
    }
}

}  // namespace

void gather_equalities(const RobotWork& work, std::span<const double> q, Equalities& equalities) {
    gather(work, q, true, equalities);
}

void gather_for_solver(const RobotWork& work, std::span<const double> q, Equalities& equalities,
                       const Team& team) {
    if (EqualitySolver::needs_mass_matrix(*work.type)) return gather(work, q, true, equalities);
    gather_loops(work, q, team, equalities);
}

double times_row(const Equalities& equalities, const EqualityRow& row, std::span<const double> x) {
    double sum = 0;
    for (std::size_t c = row.first; c < row.last; ++c)
        sum += equalities.columns[c].j * x[static_cast<std::size_t>(equalities.columns[c].dof)];
    return sum;
}

void times_rows(const RobotWork& work, std::span<const double> x, std::span<const char> locked,
                Equalities& equalities, std::vector<double>& result) {
    result.clear();
    if (!equalities.has_columns) find_motions(work, x, locked, equalities.motions);
    for (const EqualityRow& row : equalities.rows) {
        if (equalities.has_columns) {
            result.push_back(times_row(equalities, row, x));
            continue;
        }
        const LoopJoint& loop = work.type->loops[static_cast<std::size_t>(row.loop)];
        Spatial motion;
        if (loop.body_b >= 0) motion = equalities.motions[static_cast<std::size_t>(loop.body_b)];
        if (loop.body_a >= 0) motion = motion - equalities.motions[static_cast<std::size_t>(loop.body_a)];
        result.push_back(dot(row.wrench, motion));
    }
}

void EqualitySolver::prepare(const RobotWork& work, std::span<const char> locked,
                             const Equalities& equalities) {
    const RobotType& type = *work.type;
    sparse_ = !needs_mass_matrix(type);
    if (sparse_) return by_joints_.prepare(work, locked, equalities);
    n_ = static_cast<std::size_t>(type.nv), m_ = equalities.rows.size();
    y_.assign(m_ * n_, 0.0);
    a_.resize(m_ * m_);
    scale_.resize(m_);
    for (std::size_t i = 0; i < m_; ++i) {
        const EqualityRow& row = equalities.rows[i];
        scale_[i] = row.mobility > 0 ? 1.0 / std::sqrt(row.mobility) : 0.0;
        double* const y = y_.data() + i * n_;
        for (std::size_t c = row.first; c < row.last; ++c)
            y[equalities.columns[c].dof] = equalities.columns[c].j * scale_[i];
        tree_solve(type.paths, work.mass_matrix.data(), y);
    }
    for (std::size_t i = 0; i < m_; ++i)
        for (std::size_t j = 0; j < m_; ++j)
            a_[i * m_ + j] = scale_[i] * times_row(equalities, equalities.rows[i], {y_.data() + j * n_, n_});
    this->factor();
}

/// L in the lower triangle of a_, rows and columns in the order of order_; stops where only implied rows are
/// left.
void EqualitySolver::factor() {
    order_.resize(m_);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return a_[order_[i] * m_ + order_[j]]; };
    for (rank_ = 0; rank_ < m_; ++rank_) {
        const std::size_t k = rank_;
        std::size_t best = k;
        for (std::size_t i = k + 1; i < m_; ++i)
            if (at(i, i) > at(best, best)) best = i;
        if (!(at(best, best) > kImplied)) return;
        std::swap(order_[k], order_[best]);
        const double pivot = std::sqrt(at(k, k));
        at(k, k) = pivot;
        for (std::size_t i = k + 1; i < m_; ++i) at(i, k) /= pivot;
        for (std::size_t i = k + 1; i < m_; ++i)
            for (std::size_t j = k + 1; j < m_; ++j)
                at(i, j) -= at(i, k) * at(j, k);  // both triangles: rows swap
    }
}

void EqualitySolver::solve(std::span<const double> wanted, std::span<double> change) {
    if (sparse_)
        by_joints_.solve(wanted, change);
    else
        solve_dense(wanted, change);
}

void EqualitySolver::solve_dense(std::span<const double> wanted, std::span<double> change) {
    const auto at = [&](std::size_t i, std::size_t j) { return a_[order_[i] * m_ + order_[j]]; };
    x_.resize(rank_);
    for (std::size_t i = 0; i < rank_; ++i) {
        x_[i] = wanted[order_[i]] * scale_[order_[i]];
        for (std::size_t k = 0; k < i; ++k) x_[i] -= at(i, k) * x_[k];
        x_[i] /= at(i, i);
    }
    for (std::size_t i = rank_; i-- > 0;) {
        for (std::size_t k = i + 1; k < rank_; ++k) x_[i] -= at(k, i) * x_[k];
        x_[i] /= at(i, i);
    }
    std::fill(change.begin(), change.end(), 0.0);
    for (std::size_t i = 0; i < rank_; ++i) {
        const double* const y = y_.data() + order_[i] * n_;
        for (std::size_t k = 0; k < n_; ++k) change[k] += x_[i] * y[k];
    }
}

void leave_out_locked(std::span<const char> locked, Equalities& equalities) {
    if (locked.empty()) return;
    for (EqualityColumn& column : equalities.columns)
        if (locked[static_cast<std::size_t>(column.dof)]) column.j = 0;
}

void EqualityProjection::place(const RobotWork& robot, std::span<const double> q) {
    const RobotType& type = *robot.type;
    work_.type = robot.type;
    walk_.place(type, q, work_);
    for (BodyWork& body : work_.bodies) body.velocity = body.bias = {};
    gather_for_solver(work_, q, equalities_, walk_.team());
    wanted_.resize(equalities_.rows.size());
    change_.resize(static_cast<std::size_t>(type.nv));
}

void EqualityProjection::prepare(const RobotType& type, std::span<const char> locked) {
    leave_out_locked(locked, equalities_);
    if (EqualitySolver::needs_mass_matrix(type)) {
        compute_inertias(type, work_);
        compute_mass_matrix<double>(type, 0.0, work_);
        lock_rows(type.paths, locked, work_.mass_matrix.data());
        tree_factor(type.paths, work_.mass_matrix.data());
    }
    solver_.prepare(work_, locked, equalities_);
}

double EqualityProjection::largest_error() const {
    double largest = 0;
    for (const EqualityRow& row : equalities_.rows) largest = std::max(largest, std::fabs(row.error));
    return largest;
}

void EqualityProjection::close_coordinates(const RobotWork& robot, std::span<double> q,
                                           std::span<const char> locked) {
    const RobotType& type = *robot.type;
    place(robot, q);
    double error = largest_error();
    for (int i = 0; i < kNewtonMax && error > kClosed; ++i) {
        for (std::size_t r = 0; r < wanted_.size(); ++r) wanted_[r] = -equalities_.rows[r].error;
        prepare(type, locked);
        solver_.solve(wanted_, change_);
        double step = 0;
        for (const double x : change_) step = std::max(step, std::fabs(x));
        q_before_.assign(q.begin(), q.end());
        double share = step > kStepMax ? kStepMax / step : 1.0;
        for (int halved = 0;; ++halved, share *= 0.5) {
            advance_coordinates<double>(type, change_, share, q);
            if (step * share <= kClosed) return;
            place(robot, q);
            const double now = largest_error();
            if (now <= std::max(kMoreError * error, kNearlyClosed)) {
                error = now;
                break;
            }
            std::copy(q_before_.begin(), q_before_.end(), q.begin());
            if (halved == kHalvedMax) return;
        }
    }
}

void EqualityProjection::close_velocities(const RobotWork& robot, std::span<const double> q,
                                          std::span<double> v, std::span<const char> locked) {
    place(robot, q);
    times_rows(work_, v, {}, equalities_, wanted_);
    for (double& wanted : wanted_) wanted = -wanted;
    prepare(*robot.type, locked);
    solver_.solve(wanted_, change_);
    for (std::size_t k = 0; k < v.size(); ++k) v[k] += change_[k];
}

}  // namespace roboss
