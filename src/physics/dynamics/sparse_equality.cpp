// See sparse_equality.h.
#include "physics/dynamics/sparse_equality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/spatial_shift.h"
#include "model/joint_motion.h"
#include "physics/dynamics/equality.h"
#include "physics/dynamics/joint_complement.h"

namespace roboss {
namespace {

// A row whose mobility, given those before it, is below this share of its own counts as implied by them.
constexpr double kImplied = 1e-7;

constexpr std::size_t kBlock = 64;  // bodies or nodes that a thread of a team takes at a time

/// The inverse of a symmetric matrix that is positive definite.
Mat3 inverse_of(const Mat3& m) {
    const Vec3 a = cross(m.r1, m.r2), b = cross(m.r2, m.r0), c = cross(m.r0, m.r1);
    const double s = 1.0 / dot(m.r0, a);
    return {a * s, b * s, c * s};
}

const JointElimination& elimination_of(const RobotWork& work) {
    return work.type->elimination;
}

/// x := (S^T S)^-1 x for at most 6 axes S.
void solve_axes(std::span<const Spatial> axes, double* x) {
    const std::size_t n = axes.size();
    double a[6][6];
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) a[i][j] = dot(axes[i], axes[j]);
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
    }
}

}  // namespace

void SparseEqualitySolver::prepare(const RobotWork& work, std::span<const char> locked,
                                   const Equalities& equalities) {
    work_ = &work, locked_ = locked;
    branches_.lay_out(*work.type);
    prepare_bodies();
    gather_rows(equalities);
    matrix_.lay_out(elimination_of(work).pattern, count_);
}

void SparseEqualitySolver::prepare_bodies() {
    const RobotType& type = *work_->type;
    mobilities_.resize(type.bodies.size());
    team_.run_blocks(type.bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Body& body = type.bodies[b];
            const Mat3& R = work_->bodies[b].X_WB.R;
            mobilities_[b] = {1.0 / body.mass, R * inverse_of(body.inertia_C) * transpose(R),
                              work_->bodies[b].centre};
        }
    });
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
    tree_rows_.resize(work_->type->bodies.size());
    team_.run_blocks(tree_rows_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) tree_rows_[b] = tree_rows(b);
    });
    first_row_.assign(1, 0), count_.clear();
    for (const JointElimination::Node& node : elimination.nodes) {
        const auto loop = static_cast<std::size_t>(node.loop);
        count_.push_back(node.loop < 0 ? tree_rows_[static_cast<std::size_t>(node.body_b)].count
                                       : loop_rows_[loop + 1] - loop_rows_[loop]);
        first_row_.push_back(first_row_.back() + count_.back());
    }
    const std::size_t rows = first_row_.back();
    rows_.resize(rows), scale_.resize(rows), wanted_of_.resize(rows);
    team_.run_blocks(count_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) put_rows(k, equalities), scale_rows(k);
    });
}

SparseEqualitySolver::TreeRows SparseEqualitySolver::tree_rows(std::size_t body) const {
    const Body& b = work_->type->bodies[body];
    const Vec3 p = work_->bodies[body].X_WB.p - work_->origin;
    const Axes axes = axes_of(body, p);
    TreeRows rows;
    if (b.joint == JointKind::kBall && axes.count == 3) {
        for (const Vec3& force : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            rows.wrench[rows.count++] = force_from({{}, force}, p);
        return rows;
    }
    const JointComplement complement = joint_complement(std::span(axes.axis).first(axes.count));
    for (std::size_t i = 0; i < complement.count; ++i)
        rows.wrench[rows.count++] = force_from(complement.wrenches[i], p);
    return rows;
}

void SparseEqualitySolver::put_rows(std::size_t node, const Equalities& equalities) {
    const JointElimination::Node& joint = elimination_of(*work_).nodes[node];
    for (std::size_t i = 0; i < count_[node]; ++i) {
        const std::size_t to = first_row_[node] + i;
        if (joint.loop < 0) {
            rows_[to].wrench = tree_rows_[static_cast<std::size_t>(joint.body_b)].wrench[i];
            wanted_of_[to] = -1;
        } else {
            const std::size_t from = loop_rows_[static_cast<std::size_t>(joint.loop)] + i;
            rows_[to].wrench = equalities.rows[from].wrench;
            wanted_of_[to] = static_cast<int>(from);
        }
    }
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
        scale_[i] = scale;
    }
}

/// The conditions of a joint against its own and those of joints at the same bodies that come later.
void SparseEqualitySolver::add_rows(std::size_t position, BlockLdlt& matrix) const {
    const JointElimination& elimination = elimination_of(*work_);
    for (const JointElimination::Coupling& coupling : elimination.couplings_at(position)) {
        const auto p = static_cast<std::size_t>(coupling.p), q = static_cast<std::size_t>(coupling.q);
        const bool b_of_p = elimination.nodes[p].body_b == coupling.body;
        const double sign = elimination.nodes[q].body_b == coupling.body ? 1.0 : -1.0;
        const BlockLdlt::Block to = matrix.block(position, elimination.pattern.position(q));
        for (std::size_t i = 0; i < count_[p]; ++i) {
            const Row& row = rows_[first_row_[p] + i];
            const Spatial by = (b_of_p ? row.by_b : row.by_a) * sign;
            double* entries = to.at + i * to.stride;
            for (std::size_t j = p == q ? i : 0; j < count_[q]; ++j)
                entries[j] += dot(rows_[first_row_[q] + j].wrench, by);
        }
    }
}

/// The axes of a body's joint that are not locked, about p.
SparseEqualitySolver::Axes SparseEqualitySolver::axes_of(std::size_t body, const Vec3& p) const {
    const Body& b = work_->type->bodies[body];
    Axes axes;
    for (int k = 0; k < b.nv; ++k) {
        const auto dof = static_cast<std::size_t>(b.v_index + k);
        if (is_locked(dof)) continue;
        axes.axis[axes.count] = motion_about(work_->axes[dof], p), axes.dof[axes.count] = dof;
        ++axes.count;
    }
    return axes;
}

/// What forces along a joint do to its body; the opposite acts on the parent.
Spatial SparseEqualitySolver::wrench_of(std::size_t body, std::span<const double> forces) const {
    const Vec3 p = work_->bodies[body].X_WB.p - work_->origin;
    const Axes axes = axes_of(body, p);
    std::array<double, 6> x;
    for (std::size_t i = 0; i < axes.count; ++i) x[i] = forces[axes.dof[i]];
    solve_axes(std::span(axes.axis).first(axes.count), x.data());
    Spatial wrench;
    for (std::size_t i = 0; i < axes.count; ++i) wrench += axes.axis[i] * x[i];
    return force_from(wrench, p);
}

/// How each body would move by forces along the joints if none held another.
void SparseEqualitySolver::move_bodies(std::span<const double> forces) {
    const RobotType& type = *work_->type;
    joint_wrenches_.resize(type.bodies.size());
    team_.run_blocks(type.bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) joint_wrenches_[b] = wrench_of(b, forces);
    });
    change_.resize(type.bodies.size());
    team_.run_blocks(type.bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            Spatial wrench;
            for (const std::size_t k : branches_.nodes_of(b)) {
                const JointElimination::Node& node = elimination_of(*work_).nodes[k];
                if (node.loop >= 0) break;  // nodes of the tree come first
                const auto child = static_cast<std::size_t>(node.body_b);
                wrench += child == b ? joint_wrenches_[child] : joint_wrenches_[child] * -1.0;
            }
            change_[b] = moved(static_cast<int>(b), wrench);
        }
    });
}

/// x_ := what the rows lack of `wanted` at the bodies' motions.
void SparseEqualitySolver::set_lacking(std::span<const double> wanted) {
    const JointElimination& elimination = elimination_of(*work_);
    x_.resize(rows_.size());
    team_.run_blocks(elimination.nodes.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const JointElimination::Node& node = elimination.nodes[k];
            Spatial motion;
            if (node.body_b >= 0) motion = change_[static_cast<std::size_t>(node.body_b)];
            if (node.body_a >= 0) motion = motion - change_[static_cast<std::size_t>(node.body_a)];
            for (std::size_t i = first_row_[k]; i < first_row_[k + 1]; ++i)
                x_[i] = asked(i, wanted) - dot(rows_[i].wrench, motion);
        }
    });
}

/// What a row is to give, scaled.
double SparseEqualitySolver::asked(std::size_t row, std::span<const double> wanted) const {
    return wanted_of_[row] < 0 ? 0.0 : scale_[row] * wanted[static_cast<std::size_t>(wanted_of_[row])];
}

void SparseEqualitySolver::accelerate(std::span<const double> forces, std::span<const double> wanted,
                                      std::span<double> acceleration) {
    move_bodies(forces);
    set_lacking(wanted);
    matrix_.solve(*this, x_, kImplied, team_);
    push_bodies();
    read_joints(acceleration);
}

void SparseEqualitySolver::solve(std::span<const double> wanted, std::span<double> change) {
    x_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) x_[i] = asked(i, wanted);
    matrix_.solve(*this, x_, kImplied, team_);
    change_.assign(mobilities_.size(), {});
    push_bodies();
    read_joints(change);
}

/// Adds what the rows' impulses do to the bodies' motions.
void SparseEqualitySolver::push_bodies() {
    const JointElimination& elimination = elimination_of(*work_);
    team_.run_blocks(change_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            for (const std::size_t k : branches_.nodes_of(b)) {
                const bool is_a = elimination.nodes[k].body_a == static_cast<int>(b);
                for (std::size_t i = first_row_[k]; i < first_row_[k + 1]; ++i)
                    change_[b] += (is_a ? rows_[i].by_a : rows_[i].by_b) * x_[i];
            }
    });
}

/// The rates of a body's joint from the motions of the bodies, by least squares.
void SparseEqualitySolver::read_joint(std::size_t b, std::span<double> change) const {
    const Body& body = work_->type->bodies[b];
    const Vec3 p = work_->bodies[b].X_WB.p - work_->origin;
    Spatial motion = change_[b];
    if (body.parent >= 0) motion = motion - change_[static_cast<std::size_t>(body.parent)];
    motion = motion_about(motion, p);
    for (int k = 0; k < body.nv; ++k) change[static_cast<std::size_t>(body.v_index + k)] = 0;
    const Axes axes = axes_of(b, p);
    std::array<double, 6> rates;
    for (std::size_t i = 0; i < axes.count; ++i) rates[i] = dot(axes.axis[i], motion);
    solve_axes(std::span(axes.axis).first(axes.count), rates.data());
    for (std::size_t i = 0; i < axes.count; ++i) change[axes.dof[i]] = rates[i];
}

void SparseEqualitySolver::read_joints(std::span<double> change) const {
    team_.run_blocks(work_->type->bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) read_joint(b, change);
    });
}

}  // namespace roboss
