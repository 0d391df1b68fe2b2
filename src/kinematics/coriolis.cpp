// The matrix of Coriolis terms (Echeandia and Wensing 2021), in world axes about the base origin; see
// dynamics.h.
//
// A body of inertia I and velocity w has the force dI/dt w + I dw/dt. Its part that is linear in the
// velocities is B x with
//
//     B x = (w x* (I x) + x x* (I w) - I (w x x)) / 2,
//
// which gives w x* (I w) for x = w, and differs from (dI/dt) / 2 by a skew-symmetric matrix; so dM/dt - 2 C
// is skew-symmetric. With the axes S of the joints, their rates S', and I, B summed over subtrees, for j on
// the path of i:
//
//     C_ji = S_j (I_i S'_i + B_i S_i),   C_ij = S'_j I_i S_i + S_j B_i^T S_i.
#include <algorithm>
#include <array>

#include "kinematics/dynamics.h"
#include "kinematics/posed_robot.h"

namespace roboss {
namespace {

/// B by columns: the force of each unit motion.
using MotionToForce = std::array<Spatial, 6>;

Spatial unit_motion(std::size_t k) {
    Spatial unit;
    (k < 3 ? unit.angular : unit.linear)[k % 3] = 1.0;
    return unit;
}

Spatial times(const MotionToForce& B, const Spatial& x) {
    Spatial sum;
    for (std::size_t k = 0; k < 3; ++k) sum += B[k] * x.angular[k] + B[k + 3] * x.linear[k];
    return sum;
}

Spatial times_transposed(const MotionToForce& B, const Spatial& x) {
    return {{dot(B[0], x), dot(B[1], x), dot(B[2], x)}, {dot(B[3], x), dot(B[4], x), dot(B[5], x)}};
}

MotionToForce velocity_terms(const SpatialInertia& I, const Spatial& w) {
    const Spatial momentum = I * w;
    MotionToForce B;
    for (std::size_t k = 0; k < 6; ++k) {
        const Spatial x = unit_motion(k);
        B[k] = (cross_force(w, I * x) + cross_force(x, momentum) - I * cross_motion(w, x)) * 0.5;
    }
    return B;
}

/// Rate of the body's axis number i about the fixed point at which the base origin stands now.
Spatial axis_rate(const RobotType& type, const Body& body, std::size_t i, const RobotWork& work) {
    if (body.joint == JointKind::kFree) {
        const Vec3& moving = work.bodies[0].velocity.linear;  // the axes of rotation move with the base
        return {{}, cross(moving, work.axes[i].angular)};
    }
    const int carrier = body.reversed_ball ? static_cast<int>(&body - type.bodies.data()) : body.parent;
    return carrier < 0 ? Spatial{}
                       : cross_motion(work.bodies[static_cast<std::size_t>(carrier)].velocity, work.axes[i]);
}

/// The rows and columns of one body's joint; `B`: of its subtree.
void put_terms(const PosedRobot& moving, std::size_t b, const MotionToForce& B,
               std::span<const Spatial> rates, double* out) {
    const RobotModel& robot = moving.robot;
    const Body& body = robot.type().bodies[b];
    const DofPaths& paths = robot.type().paths;
    const std::size_t n = robot.v_columns();
    const SpatialInertia& I = moving.work.bodies[b].inertia;
    for (int k = 0; k < body.nv; ++k) {
        const auto i = static_cast<std::size_t>(body.v_index + k);
        const Spatial& S = moving.work.axes[i];
        const Spatial force = I * rates[i] + times(B, S), momentum = I * S, turned = times_transposed(B, S);
        const std::size_t column = robot.column_of(i);
        for (std::size_t at = 0; at < paths.length(i); ++at) {
            const auto j = static_cast<std::size_t>(paths.path(i)[at]);
            const std::size_t other = robot.column_of(j);
            out[column * n + other] = dot(rates[j], momentum) + dot(moving.work.axes[j], turned);
            out[other * n + column] = dot(moving.work.axes[j], force);
        }
    }
}

}  // namespace

void coriolis_matrices(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                       std::span<double> out) {
    const RobotType& type = robot.type();
    const std::size_t n = robot.v_columns(), rows = RobotModel::rows(q.size(), robot.q_columns());
    ROBOSS_CHECK(v.size() == rows * n && out.size() == rows * n * n, std::to_string(out.size()) + " numbers");
    std::fill(out.begin(), out.end(), 0.0);
    PosedRobot moving(robot);
    RobotWork& work = moving.work;
    std::vector<MotionToForce> terms(type.bodies.size());
    std::vector<Spatial> rates(n);
    for (std::size_t r = 0; r < rows; ++r) {
        moving.place(&q[r * robot.q_columns()]);
        moving.move(&v[r * n]);
        for (std::size_t b = 0; b < type.bodies.size(); ++b) {
            const Body& body = type.bodies[b];
            set_inertia(body, work.bodies[b]);
            terms[b] = velocity_terms(work.bodies[b].inertia, work.bodies[b].velocity);
            for (int k = 0; k < body.nv; ++k) {
                const auto i = static_cast<std::size_t>(body.v_index + k);
                rates[i] = axis_rate(type, body, i, work);
            }
        }
        for (std::size_t b = type.bodies.size(); b-- > 0;) {
            put_terms(moving, b, terms[b], rates, &out[r * n * n]);
            if (type.bodies[b].parent < 0) continue;
            const auto parent = static_cast<std::size_t>(type.bodies[b].parent);
            work.bodies[parent].inertia += work.bodies[b].inertia;
            for (std::size_t k = 0; k < 6; ++k) terms[parent][k] += terms[b][k];
        }
    }
}

}  // namespace roboss
