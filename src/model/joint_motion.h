// What a joint does, in one place for the step, the compiler and every reading: where its coordinates put its
// body, and how the body moves per unit of its velocities.
#pragma once

#include <span>

#include "core/fixed_math.h"
#include "math/spatial.h"
#include "model/model.h"

namespace roboss {

/// R turned by `angle` about `axis` of its own frame; about a coordinate axis, as joints mostly are, two
/// columns are mixed.
inline Mat3 turned(const Mat3& R, const Vec3& axis, double angle) {
    const SinCos turn = fixed_sincos(angle);
    const auto mix = [&](auto component_a, auto component_b, double sign) {
        Mat3 result = R;
        for (std::size_t i = 0; i < 3; ++i) {
            Vec3& row = result.row(i);
            const double a = row.*component_a, b = row.*component_b, s = sign * turn.sin, c = turn.cos;
            row.*component_a = c * a + s * b, row.*component_b = c * b - s * a;
        }
        return result;
    };
    if (axis.y == 0 && axis.z == 0) return mix(&Vec3::y, &Vec3::z, axis.x);
    if (axis.x == 0 && axis.z == 0) return mix(&Vec3::z, &Vec3::x, axis.y);
    if (axis.x == 0 && axis.y == 0) return mix(&Vec3::x, &Vec3::y, axis.z);
    return R * to_matrix(axis_angle(axis, angle));
}

/// Pose of the body's frame: X_WJ is the joint frame before its motion, q all coordinates of the robot.
inline Transform joint_motion(const Body& body, const Transform& X_WJ, std::span<const double> q) {
    const auto i = static_cast<std::size_t>(body.q_index);
    switch (body.joint) {
        case JointKind::kRevolute:
            return {turned(X_WJ.R, body.axis_J, q[i]), X_WJ.p};
        case JointKind::kPrismatic:
            return {X_WJ.R, X_WJ.p + X_WJ.R * (body.axis_J * q[i])};
        case JointKind::kScrew:
            return {turned(X_WJ.R, body.axis_J, q[i]), X_WJ.p + X_WJ.R * (body.axis_J * (body.pitch * q[i]))};
        case JointKind::kBall: {
            const Quat rotation{q[i], q[i + 1], q[i + 2], q[i + 3]};
            return {X_WJ.R * to_matrix(body.reversed_ball ? conjugate(rotation) : rotation), X_WJ.p};
        }
        case JointKind::kFree:
            break;
    }
    return X_WJ;
}

/// Motions about O per unit of the joint's velocities. R_WJ: joint frame before its motion; X_OB: the body's
/// frame, its origin from O, world axes.
inline void joint_axes(const Body& body, const Mat3& R_WJ, const Transform& X_OB, Spatial* axes) {
    const Vec3& anchor = X_OB.p;
    switch (body.joint) {
        case JointKind::kRevolute: {
            const Vec3 a = R_WJ * body.axis_J;
            axes[0] = {a, cross(anchor, a)};
            break;
        }
        case JointKind::kPrismatic:
            axes[0] = {{}, R_WJ * body.axis_J};
            break;
        case JointKind::kScrew: {
            const Vec3 a = R_WJ * body.axis_J;
            axes[0] = {a, cross(anchor, a) + a * body.pitch};
            break;
        }
        case JointKind::kBall:
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 a = body.reversed_ball ? -X_OB.R.col(k) : R_WJ.col(k);
                axes[k] = {a, cross(anchor, a)};
            }
            break;
        case JointKind::kFree:
            for (std::size_t k = 0; k < 3; ++k) {
                axes[k] = axes[k + 3] = Spatial{};
                axes[k].angular[k] = axes[k + 3].linear[k] = 1;
            }
            break;
    }
}

}  // namespace roboss
