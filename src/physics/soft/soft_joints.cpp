// See soft_joints.h.
#include "physics/soft/soft_joints.h"

#include <algorithm>
#include <cmath>

#include "physics/dynamics/axis_rows.h"
#include "physics/soft/soft_solver.h"

namespace roboss::soft {
namespace {

constexpr double kLimitSpeedMax = 1;  // rad/s or m/s, of recovery

double along(const double* w, const AxisRow& row, const double* y) {
    double sum = 0;
    for (std::size_t k = 0; k < row.count; ++k) sum += w[k] * y[row.path[k]];
    return sum;
}
void push(const double* w, const AxisRow& row, double f, double* y) {
    for (std::size_t k = 0; k < row.count; ++k) y[row.path[k]] += w[k] * f;
}

/// A limit pushes one way without bound; no other row does.
bool is_limit(const JointRow& row) {
    return std::isinf(row.low) != std::isinf(row.high);
}
bool is_friction(const JointRow& row) {
    return row.motor == nullptr && row.target == 0 && row.low == -row.high;
}

void set_hard_limit(const JointRow& joint, const Dof& dof, double q, AxisRow& row) {
    row.is_limit = true;
    row.side = joint.low == 0 ? 1 : -1;
    row.room = joint.low == 0 ? q - dof.lower : dof.upper - q;
}

/// The law of the tick, its impulse spread over the substeps.
void set_bounded(const JointRow& joint, AxisRow& row) {
    row.target = joint.target, row.compliance = joint.compliance * kSubsteps;
    row.low = joint.low / kSubsteps, row.high = joint.high / kSubsteps;
}

/// Where a row starts. `known`: what the rows of its axis bore in the last tick; each takes what it may have
/// been.
double start_of(const JointRow& joint, const AxisRow& row, double velocity, double& known) {
    if (joint.motor != nullptr) return std::clamp(joint.motor->impulse / kSubsteps, row.low, row.high);
    if (!is_remembered(joint)) return std::clamp((row.target - velocity) / row.compliance, row.low, row.high);
    const double low = joint.low / kSubsteps, high = joint.high / kSubsteps;
    const double taken = std::clamp(known, low, high);
    known -= taken;
    return row.side * taken;
}

}  // namespace

bool is_remembered(const JointRow& row) {
    return is_limit(row) || is_friction(row);
}

void Joints::add_columns(const Tree& tree, std::size_t i, AxisRow& row) {
    const DofPaths& paths = tree.robot->type->paths;
    row.path = paths.path(i), row.count = paths.length(i), row.first = columns_.size();
    columns_.resize(row.first + row.count);
    double* w = columns_.data() + row.first;
    double J[kMostDofs];
    for (std::size_t k = 0; k < row.count; ++k) J[row.path[k]] = 0;
    J[i] = 1;
    for (std::size_t k = row.count; k-- > 0;) {
        const auto at = static_cast<std::size_t>(row.path[k]);
        const double* l = tree.M + paths.row(at);
        for (std::size_t m = 0; m < k; ++m) J[row.path[m]] -= l[m] * J[at];
        w[k] = J[at] * tree.root[at], row.mobility += w[k] * w[k];
    }
}

void Joints::add(const Model& model, const Tree& tree, std::span<const JointRow> joints, int offset) {
    const RobotType& type = *tree.robot->type;
    const RobotState& state = *tree.robot->state;
    double known = 0;
    int last = -1;
    for (const JointRow& joint : joints) {
        AxisRow& row = rows_.emplace_back();
        const auto i = static_cast<std::size_t>(joint.dof - offset);
        const std::size_t d = i - static_cast<std::size_t>(type.base_nv());
        const Dof& dof = tree.robot->type->dofs[d];
        add_columns(tree, i, row);
        if (joint.dof != last) known = joint.motor == nullptr ? state.motors[d].impulse / kSubsteps : 0;
        last = joint.dof;
        const auto q = static_cast<std::size_t>(type.bodies[static_cast<std::size_t>(dof.body)].q_index);
        if (is_limit(joint) && joint.compliance <= model.accuracy.compliance * dof.inverse_inertia)
            set_hard_limit(joint, dof, state.q[q], row);
        else
            set_bounded(joint, row);
        row.impulse = start_of(joint, row, state.v[i], known);
    }
    first_.push_back(rows_.size());
}

void Joints::warm(std::size_t tree, double* velocity) const {
    for (std::size_t r = first_[tree]; r < first_[tree + 1]; ++r)
        push(columns_.data() + rows_[r].first, rows_[r], rows_[r].side * rows_[r].impulse, velocity);
}

double Joints::impulse_of(const AxisRow& row, const Substep& substep, bool recovers, double speed,
                          double moved) const {
    if (!row.is_limit) {
        const double change =
            (row.target - speed - row.compliance * row.impulse) / (row.mobility + row.compliance);
        return std::clamp(row.impulse + change, row.low, row.high);
    }
    const double gap = row.room + row.side * moved, u = row.side * speed;
    double wanted = -gap / substep.h;
    if (gap < 0) wanted = recovers ? std::min(-substep.scenery.rate * gap, kLimitSpeedMax) : 0;
    const double change = (wanted - u) / row.mobility;
    return std::max(row.impulse + change, 0.0);
}

void Joints::solve(std::size_t tree, const Substep& substep, bool recovers, const double* displacement,
                   double* velocity) {
    for (AxisRow& row : rows_of(tree)) {
        const double* w = columns_.data() + row.first;
        const double moved = row.is_limit ? along(w, row, displacement) : 0.0;
        const double now = impulse_of(row, substep, recovers, along(w, row, velocity), moved);
        push(w, row, row.side * (now - row.impulse), velocity);
        row.impulse = now;
        if (!recovers) row.total += now;
    }
}

void Joints::take_out(std::size_t tree, double* motion) const {
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round)
        for (std::size_t r = first_[tree]; r < first_[tree + 1]; ++r) {
            const AxisRow& row = rows_[r];
            if (row.total == 0) continue;
            const double* w = columns_.data() + row.first;
            push(w, row, -along(w, row, motion) / row.mobility, motion);
        }
}

void Joints::give(std::span<JointRow> joints) const {
    for (std::size_t r = 0; r < joints.size(); ++r) joints[r].impulse = rows_[r].side * rows_[r].total;
}

}  // namespace roboss::soft
