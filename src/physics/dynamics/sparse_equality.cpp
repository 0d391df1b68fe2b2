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
    first_row_.assign(1, 0), count_.clear(), rows_.clear(), wanted_of_.clear();
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
        count_.push_back(rows_.size() - first_row_.back());
        first_row_.push_back(rows_.size());
    }
    scale_.resize(rows_.size());
    team_.run_blocks(count_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) scale_rows(k);
    });
}

/// What the joint between a body and its parent bears.
void SparseEqualitySolver::add_tree_rows(std::size_t body) {
    const Body& b = work_->type->bodies[body];
    const Vec3 p = work_->bodies[body].X_WB.p - work_->origin;
    const Axes axes = axes_of(body, p);
    if (b.joint == JointKind::kBall && axes.count == 3) {
        for (const Vec3& force : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add_tree_row(p, {{}, force});
        return;
    }
    const JointComplement complement = joint_complement(std::span(axes.axis).first(axes.count));
    for (std::size_t i = 0; i < complement.count; ++i) add_tree_row(p, complement.wrenches[i]);
}

/// A wrench about p.
void SparseEqualitySolver::add_tree_row(const Vec3& p, const Spatial& wrench) {
    rows_.push_back({force_from(wrench, p), {}, {}});
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
    wrenches_.assign(type.bodies.size(), {});
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        wrenches_[b] += joint_wrenches_[b];
        if (type.bodies[b].parent >= 0)
            wrenches_[static_cast<std::size_t>(type.bodies[b].parent)] += joint_wrenches_[b] * -1.0;
    }
    change_.resize(type.bodies.size());
    team_.run_blocks(type.bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) change_[b] = moved(static_cast<int>(b), wrenches_[b]);
    });
}

/// x_ := what the rows lack of `wanted` at the bodies' motions.
void SparseEqualitySolver::set_lacking(std::span<const double> wanted) {
    const JointElimination& elimination = elimination_of(*work_);
    x_.resize(rows_.size());
    for (std::size_t k = 0; k < elimination.nodes.size(); ++k) {
        const JointElimination::Node& node = elimination.nodes[k];
        Spatial motion;
        if (node.body_b >= 0) motion = change_[static_cast<std::size_t>(node.body_b)];
        if (node.body_a >= 0) motion = motion - change_[static_cast<std::size_t>(node.body_a)];
        for (std::size_t i = first_row_[k]; i < first_row_[k + 1]; ++i) {
            const double asked =
                wanted_of_[i] < 0 ? 0.0 : scale_[i] * wanted[static_cast<std::size_t>(wanted_of_[i])];
            x_[i] = asked - dot(rows_[i].wrench, motion);
        }
    }
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
    for (std::size_t i = 0; i < rows_.size(); ++i)
        x_[i] = wanted_of_[i] < 0 ? 0.0 : scale_[i] * wanted[static_cast<std::size_t>(wanted_of_[i])];
    matrix_.solve(*this, x_, kImplied, team_);
    change_.assign(mobilities_.size(), {});
    push_bodies();
    read_joints(change);
}

/// Adds what the rows' impulses do to the bodies' motions.
void SparseEqualitySolver::push_bodies() {
    const JointElimination& elimination = elimination_of(*work_);
    for (std::size_t k = 0; k < elimination.nodes.size(); ++k) {
        const JointElimination::Node& node = elimination.nodes[k];
        for (std::size_t i = first_row_[k]; i < first_row_[k + 1]; ++i) {
            if (node.body_a >= 0) change_[static_cast<std::size_t>(node.body_a)] += rows_[i].by_a * x_[i];
            if (node.body_b >= 0) change_[static_cast<std::size_t>(node.body_b)] += rows_[i].by_b * x_[i];
        }
    }
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
