// See sparse_equality.h.
#include "physics/dynamics/sparse_equality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/joint_motion.h"
#include "physics/dynamics/equality.h"
#include "physics/dynamics/joint_complement.h"

namespace roboss {
namespace {

// A row whose mobility, given those before it, is below this share of its own counts as implied by them.
constexpr double kImplied = 1e-7;

/// The inverse of a symmetric matrix that is positive definite.
Mat3 inverse_of(const Mat3& m) {
    const Vec3 a = cross(m.r1, m.r2), b = cross(m.r2, m.r0), c = cross(m.r0, m.r1);
    const double s = 1.0 / dot(m.r0, a);
    return {a * s, b * s, c * s};
}

/// The same motion about a point at p from O.
Spatial about(const Spatial& motion, const Vec3& p) {
    return {motion.angular, motion.linear + cross(motion.angular, p)};
}

const JointElimination& elimination_of(const RobotWork& work) {
    return work.type->elimination;
}

/// Least squares for at most 6 unknowns: the axes' share in a motion that they span.
void solve_axes(std::span<const Spatial> axes, const Spatial& motion, double* rates) {
    const std::size_t n = axes.size();
    double a[6][6], x[6];
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) a[i][j] = dot(axes[i], axes[j]);
        x[i] = dot(axes[i], motion);
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] = i == j ? std::sqrt(a[i][i]) : a[i][j] / a[j][j];
        }
        for (std::size_t k = 0; k < i; ++k) x[i] -= a[i][k] * x[k];
        x[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= a[k][i] * x[k];
        x[i] /= a[i][i];
        rates[i] = x[i];
    }
}

}  // namespace

void SparseEqualitySolver::prepare(const RobotWork& work, std::span<const char> locked,
                                   const Equalities& equalities) {
    work_ = &work, locked_ = locked;
    prepare_bodies();
    gather_rows(equalities);
    lay_out();
    assemble();
    factor();
}

void SparseEqualitySolver::prepare_bodies() {
    const RobotType& type = *work_->type;
    mobilities_.resize(type.bodies.size());
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        const Mat3& R = work_->bodies[b].X_WB.R;
        mobilities_[b] = {1.0 / body.mass, R * inverse_of(body.inertia_C) * transpose(R),
                          work_->bodies[b].centre};
    }
}

/// How a body moves when it gets this impulse; the fixed base does not.
Spatial SparseEqualitySolver::moved(int body, const Spatial& wrench) const {
    if (body < 0) return {};
    const BodyMobility& m = mobilities_[static_cast<std::size_t>(body)];
    const Vec3 angular = m.inverse_inertia * (wrench.angular - cross(m.centre, wrench.linear));
    return {angular, wrench.linear * m.inverse_mass - cross(angular, m.centre)};
}

void SparseEqualitySolver::gather_rows(const Equalities& equalities) {
    const JointElimination& elimination = elimination_of(*work_);
    loop_rows_.assign(work_->type->loops.size() + 1, 0);
    for (const EqualityRow& row : equalities.rows) ++loop_rows_[static_cast<std::size_t>(row.loop) + 1];
    for (std::size_t i = 1; i < loop_rows_.size(); ++i) loop_rows_[i] += loop_rows_[i - 1];
    first_row_.assign(1, 0), rows_.clear(), wanted_of_.clear(), scale_.clear();
    for (std::size_t k = 0; k < elimination.nodes.size(); ++k) {
        const JointElimination::Node& node = elimination.nodes[k];
        if (node.loop < 0) {
            add_tree_rows(static_cast<std::size_t>(node.body_b));
        } else {
            const auto loop = static_cast<std::size_t>(node.loop);
            for (std::size_t i = loop_rows_[loop]; i < loop_rows_[loop + 1]; ++i) {
                rows_.push_back({equalities.rows[i].wrench, {}, {}});
                wanted_of_.push_back(static_cast<int>(i));
            }
        }
        first_row_.push_back(rows_.size());
        scale_rows(k);
    }
}

/// What the joint between a body and its parent bears.
void SparseEqualitySolver::add_tree_rows(std::size_t body) {
    const Body& b = work_->type->bodies[body];
    const Vec3 p = work_->bodies[body].X_WB.p - work_->origin;
    std::array<Spatial, 6> axes;
    std::size_t count = 0;
    for (int k = 0; k < b.nv; ++k) {
        const auto dof = static_cast<std::size_t>(b.v_index + k);
        if (!is_locked(dof)) axes[count++] = about(work_->axes[dof], p);
    }
    if (b.joint == JointKind::kBall && count == 3) {
        for (const Vec3& force : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add_tree_row(p, {{}, force});
        return;
    }
    const JointComplement complement = joint_complement(std::span(axes).first(count));
    for (std::size_t i = 0; i < complement.count; ++i) add_tree_row(p, complement.wrenches[i]);
}

/// A wrench about p.
void SparseEqualitySolver::add_tree_row(const Vec3& p, const Spatial& wrench) {
    rows_.push_back({{wrench.angular + cross(p, wrench.linear), wrench.linear}, {}, {}});
    wanted_of_.push_back(-1);
}

/// To mobility 1.
void SparseEqualitySolver::scale_rows(std::size_t node) {
    const JointElimination::Node& joint = elimination_of(*work_).nodes[node];
    for (std::size_t i = first_row_[node]; i < first_row_[node + 1]; ++i) {
        Row& row = rows_[i];
        row.by_a = moved(joint.body_a, row.wrench) * -1.0, row.by_b = moved(joint.body_b, row.wrench);
        const double mobility = dot(row.wrench, row.by_b) - dot(row.wrench, row.by_a);
        const double scale = mobility > 0 ? 1.0 / std::sqrt(mobility) : 0.0;
        row.wrench = row.wrench * scale, row.by_a = row.by_a * scale, row.by_b = row.by_b * scale;
        scale_.push_back(scale);
    }
}

bool SparseEqualitySolver::is_laid_out() const {
    const JointElimination& elimination = elimination_of(*work_);
    return laid_out_.rows == first_row_ && laid_out_.ends == elimination.ends &&
           std::ranges::equal(laid_out_.last_edges, elimination.nodes, {}, {}, &JointElimination::Node::last);
}

void SparseEqualitySolver::lay_out() {
    const JointElimination& elimination = elimination_of(*work_);
    if (is_laid_out()) {
        std::ranges::fill(a_, 0.0);
        return;
    }
    laid_out_.rows = first_row_, laid_out_.ends = elimination.ends;
    laid_out_.last_edges.clear();
    for (const JointElimination::Node& node : elimination.nodes) laid_out_.last_edges.push_back(node.last);
    const std::size_t nodes = elimination.nodes.size();
    width_.resize(nodes), start_.resize(nodes), column_.resize(elimination.ends.size());
    std::size_t size = 0;
    for (std::size_t k = 0; k < nodes; ++k) {
        const std::size_t own = rows_of(k);
        std::size_t width = own;
        for (std::size_t e = elimination.nodes[k].first; e < elimination.nodes[k].last; ++e) {
            column_[e] = width;
            width += rows_of(static_cast<std::size_t>(elimination.ends[e]));
        }
        width_[k] = width, start_[k] = size;
        size += own * width;
    }
    a_.assign(size, 0.0);
    runs_.clear(), first_run_.clear();
    for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t e = elimination.nodes[k].first; e < elimination.nodes[k].last; ++e) {
            first_run_.push_back(runs_.size());
            find_runs(k, e);
        }
    first_run_.push_back(runs_.size());
}

void SparseEqualitySolver::assemble() {
    const JointElimination& elimination = elimination_of(*work_);
    for (const JointElimination::Coupling& coupling : elimination.couplings) {
        const auto p = static_cast<std::size_t>(coupling.p), q = static_cast<std::size_t>(coupling.q);
        const bool b_of_p = elimination.nodes[p].body_b == coupling.body;
        const double sign = elimination.nodes[q].body_b == coupling.body ? 1.0 : -1.0;
        double* to = a_.data() + start_[p];
        if (coupling.edge >= 0) to += column_[static_cast<std::size_t>(coupling.edge)];
        for (std::size_t i = first_row_[p]; i < first_row_[p + 1]; ++i, to += width_[p]) {
            const Spatial by = (b_of_p ? rows_[i].by_b : rows_[i].by_a) * sign;
            for (std::size_t j = first_row_[q]; j < first_row_[q + 1]; ++j)
                to[j - first_row_[q]] += dot(rows_[j].wrench, by);
        }
    }
}

void SparseEqualitySolver::factor() {
    for (std::size_t k = 0; k + 1 < first_row_.size(); ++k) {
        eliminate_own(k);
        update_later(k);
    }
}

/// The rows of one joint become those of D L^T.
void SparseEqualitySolver::eliminate_own(std::size_t node) {
    const std::size_t own = rows_of(node), width = width_[node];
    double* a = a_.data() + start_[node];
    for (std::size_t c = 0; c < own; ++c) {
        double* pivot = a + c * width;
        if (!(pivot[c] > kImplied)) {
            std::fill(pivot, pivot + width, 0.0);
            continue;
        }
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (std::size_t r = c + 1; r < own; ++r) {
            const double f = pivot[r] * inverse;
            double* __restrict row = a + r * width;
            for (std::size_t j = r; j < width; ++j) row[j] -= f * pivot[j];
        }
    }
}

/// Where the columns of a node's rows, from an edge on, stand in the rows of that edge's end.
void SparseEqualitySolver::find_runs(std::size_t node, std::size_t edge) {
    const JointElimination& elimination = elimination_of(*work_);
    const auto target = static_cast<std::size_t>(elimination.ends[edge]);
    runs_.push_back({column_[edge], 0, rows_of(target)});
    std::size_t at = elimination.nodes[target].first;
    for (std::size_t e = edge + 1; e < elimination.nodes[node].last; ++e) {
        while (elimination.ends[at] != elimination.ends[e]) ++at;
        const std::size_t count = rows_of(static_cast<std::size_t>(elimination.ends[e]));
        Run& last = runs_.back();
        if (last.to + last.count == column_[at])
            last.count += count;
        else
            runs_.push_back({column_[e], column_[at], count});
    }
}

/// row -= f * pivot for up to three pivots of a joint at once, run by run.
void SparseEqualitySolver::subtract(std::span<const Run> runs, const double* pivots, std::size_t width,
                                    std::span<const double> f, double* row) const {
    for (const Run& run : runs) {
        double* __restrict to = row + run.to;
        const double* __restrict p0 = pivots + run.from;
        const double f0 = f[0];
        if (f.size() == 3) {
            const double* __restrict p1 = p0 + width, * __restrict p2 = p1 + width;
            const double f1 = f[1], f2 = f[2];
            for (std::size_t j = 0; j < run.count; ++j) to[j] -= f0 * p0[j] + f1 * p1[j] + f2 * p2[j];
        } else if (f.size() == 2) {
            const double* __restrict p1 = p0 + width;
            const double f1 = f[1];
            for (std::size_t j = 0; j < run.count; ++j) to[j] -= f0 * p0[j] + f1 * p1[j];
        } else {
            for (std::size_t j = 0; j < run.count; ++j) to[j] -= f0 * p0[j];
        }
    }
}

void SparseEqualitySolver::update_later(std::size_t node) {
    const JointElimination& elimination = elimination_of(*work_);
    const std::size_t own = rows_of(node), width = width_[node];
    const double* a = a_.data() + start_[node];
    std::array<double, 6> f;
    for (std::size_t e = elimination.nodes[node].first; e < elimination.nodes[node].last; ++e) {
        const auto target = static_cast<std::size_t>(elimination.ends[e]);
        const auto runs = std::span(runs_).subspan(first_run_[e], first_run_[e + 1] - first_run_[e]);
        for (std::size_t r = 0; r < rows_of(target); ++r) {
            double* row = a_.data() + start_[target] + r * width_[target];
            for (std::size_t c = 0; c < own; ++c) f[c] = a[c * width + column_[e] + r] * a[c * width + c];
            for (std::size_t c = 0; c < own; c += 3)
                subtract(runs, a + c * width, width,
                         std::span(f).subspan(c, std::min<std::size_t>(3, own - c)), row);
        }
    }
}

/// x := A^-1 x
void SparseEqualitySolver::substitute() {
    const JointElimination& elimination = elimination_of(*work_);
    const std::size_t nodes = elimination.nodes.size();
    for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t c = 0; c < rows_of(k); ++c) {
            const double* row = a_.data() + start_[k] + c * width_[k];
            const double f = row[c] * x_[first_row_[k] + c];
            for (std::size_t r = c + 1; r < rows_of(k); ++r) x_[first_row_[k] + r] -= row[r] * f;
            for (std::size_t e = elimination.nodes[k].first; e < elimination.nodes[k].last; ++e) {
                const auto end = static_cast<std::size_t>(elimination.ends[e]);
                for (std::size_t j = 0; j < rows_of(end); ++j)
                    x_[first_row_[end] + j] -= row[column_[e] + j] * f;
            }
        }
    for (std::size_t k = nodes; k-- > 0;)
        for (std::size_t c = rows_of(k); c-- > 0;) {
            const double* row = a_.data() + start_[k] + c * width_[k];
            double& x = x_[first_row_[k] + c];
            for (std::size_t r = c + 1; r < rows_of(k); ++r) x -= row[r] * x_[first_row_[k] + r];
            for (std::size_t e = elimination.nodes[k].first; e < elimination.nodes[k].last; ++e) {
                const auto end = static_cast<std::size_t>(elimination.ends[e]);
                for (std::size_t j = 0; j < rows_of(end); ++j)
                    x -= row[column_[e] + j] * x_[first_row_[end] + j];
            }
            x *= row[c];
        }
}

void SparseEqualitySolver::solve(std::span<const double> wanted, std::span<double> change) {
    x_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i)
        x_[i] = wanted_of_[i] < 0 ? 0.0 : scale_[i] * wanted[static_cast<std::size_t>(wanted_of_[i])];
    substitute();
    const JointElimination& elimination = elimination_of(*work_);
    change_.assign(mobilities_.size(), {});
    for (std::size_t k = 0; k < elimination.nodes.size(); ++k) {
        const JointElimination::Node& node = elimination.nodes[k];
        for (std::size_t i = first_row_[k]; i < first_row_[k + 1]; ++i) {
            if (node.body_a >= 0) change_[static_cast<std::size_t>(node.body_a)] += rows_[i].by_a * x_[i];
            if (node.body_b >= 0) change_[static_cast<std::size_t>(node.body_b)] += rows_[i].by_b * x_[i];
        }
    }
    read_joints(change);
}

/// The joints' rates from the motions of the bodies.
void SparseEqualitySolver::read_joints(std::span<double> change) {
    const RobotType& type = *work_->type;
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        const Vec3 p = work_->bodies[b].X_WB.p - work_->origin;
        Spatial motion = change_[b];
        if (body.parent >= 0) motion = motion - change_[static_cast<std::size_t>(body.parent)];
        std::array<Spatial, 6> axes;
        std::array<std::size_t, 6> dofs;
        std::array<double, 6> rates;
        std::size_t count = 0;
        for (int k = 0; k < body.nv; ++k) {
            const auto dof = static_cast<std::size_t>(body.v_index + k);
            change[dof] = 0;
            if (!is_locked(dof)) axes[count] = about(work_->axes[dof], p), dofs[count++] = dof;
        }
        solve_axes(std::span(axes).first(count), about(motion, p), rates.data());
        for (std::size_t i = 0; i < count; ++i) change[dofs[i]] = rates[i];
    }
}

}  // namespace roboss
