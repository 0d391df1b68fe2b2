// A ball in its socket: a quaternion; velocities about the axes of the joint frame that the file's parent
// carries.
#pragma once

#include "model/joints/joint_traits.h"

namespace roboss {

struct BallJoint {
    static constexpr JointTraits kTraits{
        .name = "ball", .nq = 4, .nv = 3, .unit = "rad", .turns = true, .is_quaternion = true};

    static double slide(const Body& /*body*/) { return 0; }

    template <class T>
    static TransformT<T> motion(const Body& body, const TransformT<T>& X_WJ, const T* q) {
        const QuatT<T> rotation = get_quat(q);
        return {X_WJ.R * to_matrix(body.reversed_ball ? conjugate(rotation) : rotation), X_WJ.p};
    }

    template <class T>
    static void axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& X_OB, SpatialT<T>* out) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3T<T> a = body.reversed_ball ? -X_OB.R.col(k) : R_WJ.col(k);
            out[k] = {a, cross(X_OB.p, a)};
        }
    }

    template <class T>
    static void advance(const T* v, double dt, T* q) {
        turn_quat(q, Vec3T<T>{v[0], v[1], v[2]} * T(dt));
    }
    template <class T>
    static void rate(const T* q, const T* v, T* rate) {
        put_quat_rate(q, Vec3T<T>{v[0], v[1], v[2]}, rate);
    }
    template <class T>
    static void normalise(T* q) {
        put_quat(q, normalized(get_quat(q)));
    }
};

}  // namespace roboss
