// See coordinates.h.
#include "model/coordinates.h"

namespace roboss {

void place_tree(const RobotType& type, std::span<const double> q, TreePlacement& placement) {
    placement.origin = {q[0], q[1], q[2]};
    placement.X_OR = {to_matrix(Quat{q[3], q[4], q[5], q[6]}), {}};
    placement.X_OB.resize(type.bodies.size());
    placement.axes.resize(static_cast<std::size_t>(type.nv));
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        Transform X_OJ = placement.X_OR;
        if (body.joint != JointKind::kFree) X_OJ = placement.of(body.parent) * body.X_PJ;
        placement.X_OB[b] = joint_motion(body, X_OJ, q);
        joint_axes(body, X_OJ.R, placement.X_OB[b], &placement.axes[static_cast<std::size_t>(body.v_index)]);
    }
}

}  // namespace roboss
