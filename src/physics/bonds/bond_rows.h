// The six rows of a bond: the velocity of the other link against the holder's, at the bond's point.
#pragma once

#include <span>

#include "physics/bonds/bond_keeper.h"
#include "physics/solver/rows.h"

namespace roboss {

/// Adds the rows of bond number `number` of the contact island; offsets[i] is the first dof of robots[i].
/// They ask that both links move alike at the end of the tick, and start from the impulses of the last tick.
void add_bond_rows(const Model& model, std::span<const RobotWork> robots, std::span<const int> offsets,
                   const HeldBond& held, int number, IslandRows& rows);

/// The solved impulses of the rows, into the states of the holders.
void take_bond_impulses(const IslandRows& rows, std::span<const HeldBond> bonds);

/// Columns along the path of a link's body: for each degree of freedom that moves it, add(dof, rate) with the
/// work per unit of its velocity of a wrench about p_W.
template <class Add>
void visit_bond_columns(const RobotWork& robot, int body, const Vec3& p_W, const Spatial& wrench, Add&& add) {
    if (body < 0) return;
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    const DofPaths& paths = robot.type->paths;
    const auto last = static_cast<std::size_t>(info.v_index + info.nv - 1);
    const Spatial about_origin{wrench.angular + cross(p_W - robot.origin, wrench.linear), wrench.linear};
    for (std::size_t k = 0; k < paths.length(last); ++k) {
        const int dof = paths.path(last)[k];
        add(dof, dot(robot.axes[static_cast<std::size_t>(dof)], about_origin));
    }
}

/// Axis `k` of a bond's rows, 0 to 5: torques, then forces, along the world axes.
Spatial bond_axis(std::size_t k);

}  // namespace roboss
