// See coordinates.h.
#include "model/coordinates.h"

#include "model/joint_motion.h"

namespace roboss {
namespace {

Vec3 get_vec(std::span<const double> v, std::size_t i) {
    return {v[i], v[i + 1], v[i + 2]};
}

/// Turns the quaternion at q[i] by a rotation vector.
void turn(std::span<double> q, std::size_t i, const Vec3& rotation) {
    const Quat x = normalized(exponential(rotation) * Quat{q[i], q[i + 1], q[i + 2], q[i + 3]});
    q[i] = x.w, q[i + 1] = x.x, q[i + 2] = x.y, q[i + 3] = x.z;
}

}  // namespace

void advance_coordinates(const RobotType& type, std::span<const double> v, double dt, std::span<double> q) {
    for (const Body& body : type.bodies) {
        const auto i = static_cast<std::size_t>(body.q_index);
        const auto k = static_cast<std::size_t>(body.v_index);
        if (body.joint == JointKind::kFree) {
            for (std::size_t a = 0; a < 3; ++a) q[a] += dt * v[k + 3 + a];
            turn(q, 3, get_vec(v, k) * dt);
        } else if (body.joint == JointKind::kBall) {
            turn(q, i, get_vec(v, k) * dt);
        } else {
            q[i] += dt * v[k];
        }
    }
}

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
