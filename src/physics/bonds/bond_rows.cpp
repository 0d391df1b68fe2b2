// See bond_rows.h.
#include "physics/bonds/bond_rows.h"

#include <limits>

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Acceleration of a body, and of a point of it, with all joint accelerations zero.
Spatial bias_at(const RobotWork& robot, int body, const Vec3& p_W) {
    if (body < 0) return {};
    const BodyWork& b = robot.bodies[static_cast<std::size_t>(body)];
    const Vec3 arm = p_W - robot.origin, turning = b.velocity.angular;
    return {b.bias.angular, b.bias.linear + cross(b.bias.angular, arm) +
                                cross(turning, b.velocity.linear + cross(turning, arm))};
}

/// Mobility of a body at the zero pose: of turning, of moving.
struct Mobility {
    double angular = 0, linear = 0;
};

Mobility mobility_of(const RobotWork& robot, int body) {
    if (body < 0) return {};
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    return {info.inverse_inertia_angular, info.inverse_mass_linear};
}

}  // namespace

Spatial bond_axis(std::size_t k) {
    Spatial axis;
    (k < 3 ? axis.angular : axis.linear)[k % 3] = 1;
    return axis;
}

void add_bond_rows(const Model& model, std::span<const RobotWork> robots, std::span<const int> offsets,
                   const HeldBond& held, int number, IslandRows& rows) {
    const bool has_other = held.other != HeldBond::kScenery;
    const RobotWork& holder = robots[held.holder];
    const Vec3 p_W = frames_of(robots, held).p_W;
    const Spatial bias = (has_other ? bias_at(robots[held.other], held.other_body, p_W) : Spatial{}) -
                         bias_at(holder, held.body, p_W);
    Mobility mobility = mobility_of(holder, held.body);
    if (has_other) {
        const Mobility of_other = mobility_of(robots[held.other], held.other_body);
        mobility.angular += of_other.angular, mobility.linear += of_other.linear;
    }
    const Spatial last{held.bond->torque_impulse, held.bond->force_impulse};
    for (std::size_t k = 0; k < 6; ++k) {
        const Spatial axis = bond_axis(k);
        CouplingRow row;
        row.compliance = model.accuracy.compliance * (k < 3 ? mobility.angular : mobility.linear);
        if (!(row.compliance > 0)) continue;
        row.target = row.position_target = -model.dt_s * dot(bias, axis) + row.compliance * dot(last, axis);
        row.low = -kInfinity, row.high = kInfinity;
        row.robot = holder.id, row.bond = number, row.wrench = axis;
        row.first = rows.coupling_columns.size();
        const auto add_side = [&](std::uint32_t robot, int body, double sign) {
            visit_bond_columns(robots[robot], body, p_W, axis, [&](int dof, double j) {
                rows.coupling_columns.push_back({offsets[robot] + dof, sign * j});
            });
        };
        add_side(held.holder, held.body, -1.0);
        if (has_other) add_side(held.other, held.other_body, 1.0);
        row.last = rows.coupling_columns.size();
        rows.couplings.push_back(row);
    }
}

void take_bond_impulses(const IslandRows& rows, std::span<const HeldBond> bonds) {
    for (const HeldBond& held : bonds) held.bond->force_impulse = held.bond->torque_impulse = {};
    for (const CouplingRow& row : rows.couplings) {
        if (row.bond < 0) continue;
        Bond& bond = *bonds[static_cast<std::size_t>(row.bond)].bond;
        bond.torque_impulse += row.wrench.angular * row.impulse;
        bond.force_impulse += row.wrench.linear * row.impulse;
    }
}

}  // namespace roboss
