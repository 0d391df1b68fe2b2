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
template <class T>
Mat3T<T> turned(const Mat3T<T>& R, const Vec3& axis, const T& angle) {
    using Row = Vec3T<T>;
    const auto mix = [&](T Row::*component_a, T Row::*component_b, double sign) {
        const SinCosT<T> turn = fixed_sincos(angle);
        const T s = T(sign) * turn.sin, c = turn.cos;
        Mat3T<T> result = R;
        for (std::size_t i = 0; i < 3; ++i) {
            Row& row = result.row(i);
            const T a = row.*component_a, b = row.*component_b;
            row.*component_a = c * a + s * b, row.*component_b = c * b - s * a;
        }
        return result;
    };
    if (axis.y == 0 && axis.z == 0) return mix(&Row::y, &Row::z, axis.x);
    if (axis.x == 0 && axis.z == 0) return mix(&Row::z, &Row::x, axis.y);
    if (axis.x == 0 && axis.y == 0) return mix(&Row::x, &Row::y, axis.z);
    return R * to_matrix(axis_angle(broadcast<T>(axis), angle));
}

/// Pose of the body's frame: X_WJ is the joint frame before its motion, q all coordinates of the robot.
template <class T>
TransformT<T> joint_motion(const Body& body, const TransformT<T>& X_WJ, std::span<const T> q) {
    const auto i = static_cast<std::size_t>(body.q_index);
    const auto along = [&](const T& way) { return X_WJ.p + X_WJ.R * (broadcast<T>(body.axis_J) * way); };
    switch (body.joint) {
        case JointKind::kRevolute:
            return {turned(X_WJ.R, body.axis_J, q[i]), X_WJ.p};
        case JointKind::kPrismatic:
            return {X_WJ.R, along(q[i])};
        case JointKind::kScrew:
            return {turned(X_WJ.R, body.axis_J, q[i]), along(T(body.pitch) * q[i])};
        case JointKind::kBall: {
            const QuatT<T> rotation{q[i], q[i + 1], q[i + 2], q[i + 3]};
            return {X_WJ.R * to_matrix(body.reversed_ball ? conjugate(rotation) : rotation), X_WJ.p};
        }
        case JointKind::kFree:
            break;
    }
    return X_WJ;
}

/// Motions about O per unit of the joint's velocities. R_WJ: joint frame before its motion; X_OB: the body's
/// frame, its origin from O, world axes.
template <class T>
void joint_axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& X_OB, SpatialT<T>* axes) {
    const Vec3T<T>& anchor = X_OB.p;
    switch (body.joint) {
        case JointKind::kRevolute: {
            const Vec3T<T> a = R_WJ * broadcast<T>(body.axis_J);
            axes[0] = {a, cross(anchor, a)};
            break;
        }
        case JointKind::kPrismatic:
            axes[0] = {{}, R_WJ * broadcast<T>(body.axis_J)};
            break;
        case JointKind::kScrew: {
            const Vec3T<T> a = R_WJ * broadcast<T>(body.axis_J);
            axes[0] = {a, cross(anchor, a) + a * T(body.pitch)};
            break;
        }
        case JointKind::kBall:
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3T<T> a = body.reversed_ball ? -X_OB.R.col(k) : R_WJ.col(k);
                axes[k] = {a, cross(anchor, a)};
            }
            break;
        case JointKind::kFree:
            for (std::size_t k = 0; k < 3; ++k) {
                axes[k] = axes[k + 3] = SpatialT<T>{};
                axes[k].angular[k] = axes[k + 3].linear[k] = T(1);
            }
            break;
    }
}

}  // namespace roboss
