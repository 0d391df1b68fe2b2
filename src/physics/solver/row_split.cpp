// See row_split.h.
#include "physics/solver/row_split.h"

#include <algorithm>

#include "physics/solver/row_math.h"

namespace roboss {
namespace {

bool is_at_bound(const BoundedRow& row) {
    return row.impulse <= row.low || row.impulse >= row.high;
}

/// What a hard row would give if it did not give way by its compliance.
double speed_of(const JointRow& row) {
    return row.target - (row.motor != nullptr ? row.compliance * row.motor->load : 0.0);
}

/// A joint is held where what the solver takes implicitly (hard rows, stiff springs, dampings and servos)
/// outweighs its inertia: then it moves as solved, and nothing else does to it within the tick.
void find_locked(const IslandSolver::Problem& p, double dt, RowSplit& split) {
    std::size_t row = 0;
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const RobotType& type = *p.robots[r]->type;
        const auto first = static_cast<std::size_t>(p.offsets[r] + type.base_nv());
        for (std::size_t d = 0; d < type.dofs.size(); ++d) {
            const Dof& dof = type.dofs[d];
            const double hard = hard_compliance<double>(p.accuracy) * dof.inverse_inertia;
            double stiffness = dt * dof.damping + dt * dt * dof.spring_stiffness;
            for (; row < p.rows.joints.size() && p.rows.joints[row].dof == static_cast<int>(first + d);
                 ++row) {
                const JointRow& joint = p.rows.joints[row];
                if (is_at_bound(joint)) continue;
                stiffness += joint.stiffness;
                if (joint.compliance <= hard) split.held[first + d] = speed_of(joint);
            }
            split.locked[first + d] = stiffness * dof.inverse_inertia > 1;
        }
    }
}

/// The part of a row's impulse that changes velocities, if it acted alone; the rest balances forces.
double kick_of(const IslandSolver::Problem& p, const CouplingRow& row, std::span<const double> v_before,
               std::span<const double> v) {
    if (row.soft || is_at_bound(row)) return 0;
    double change = 0;
    for (std::size_t c = row.first; c < row.last; ++c) {
        const CouplingColumn& column = p.rows.coupling_columns[c];
        const auto i = static_cast<std::size_t>(column.dof);
        change += column.j * (v[i] - v_before[i]);
    }
    const double mobility = row.compliance / p.accuracy.compliance;
    return std::clamp(change / mobility, std::min(row.impulse, 0.0), std::max(row.impulse, 0.0));
}

void split_couplings(const IslandSolver::Problem& p, std::span<const double> v_before,
                     std::span<const double> v, RowSplit& split) {
    for (const CouplingRow& row : p.rows.couplings) {
        if (row.equality) continue;
        const double kick = kick_of(p, row, v_before, v);
        for (std::size_t c = row.first; c < row.last; ++c) {
            const CouplingColumn& column = p.rows.coupling_columns[c];
            const auto i = static_cast<std::size_t>(column.dof);
            split.kick[i] += column.j * kick, split.load[i] += column.j * (row.impulse - kick);
        }
    }
}

void add(const ContactColumns& columns, std::size_t first, std::size_t last, const BoundedRow& row,
         const FrictionDisc& disc, std::vector<double>& to) {
    jacobian::add<double>(columns, first, last, {row.impulse, disc.impulse_1, disc.impulse_2}, to);
}

/// True for a contact whose spring does not outweigh the inertia in one tick.
bool is_soft(const ContactRow& row) {
    return row.soft && row.normal.stiffness * row.inverse_effective_mass < 1;
}

}  // namespace

void split_rows(const IslandSolver::Problem& p, std::span<const double> v_before, std::span<const double> v,
                double dt, RowSplit& split) {
    split.locked.assign(v.size(), 0);
    split.held.assign(v.begin(), v.end());
    split.kick.assign(v.size(), 0.0), split.load.assign(v.size(), 0.0);
    find_locked(p, dt, split);
    for (const JointRow& row : p.rows.joints)
        if (const auto i = static_cast<std::size_t>(row.dof); !split.locked[i]) split.load[i] += row.impulse;
    split_couplings(p, v_before, v, split);
    const auto& contacts = p.rows.contacts;
    for (const ContactRow& row : contacts)
        add(p.rows.columns, row.first, row.last, row.normal, row.slip,
            is_soft(row) ? split.load : split.kick);
    for (const AngularRow& row : p.rows.angulars)
        add(p.rows.columns, row.first, row.last, row.spin, row.roll,
            is_soft(contacts[row.contact]) ? split.load : split.kick);
}

}  // namespace roboss
