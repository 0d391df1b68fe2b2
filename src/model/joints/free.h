// The base of a robot that nothing fixes: q = position, quaternion; v = angular, linear velocity, in world
// axes.
#pragma once

#include "model/joints/joint_traits.h"

namespace roboss {

struct FreeJoint {
    static constexpr JointTraits kTraits{.name = "free", .nq = 7, .nv = 6, .turns = true, .slides = true};

    static double slide(const Body& /*body*/) { return 0; }

    /// X_WJ is the base pose itself.
    template <class T>
    static TransformT<T> motion(const Body& /*body*/, const TransformT<T>& X_WJ, const T* /*q*/) {
        return X_WJ;
    }

    template <class T>
    static void axes(const Body& /*body*/, const Mat3T<T>& /*R_WJ*/, const TransformT<T>& /*X_OB*/,
                     SpatialT<T>* out) {
        for (std::size_t k = 0; k < 3; ++k) {
            out[k] = out[k + 3] = SpatialT<T>{};
            out[k].angular[k] = out[k + 3].linear[k] = T(1);
        }
    }

    template <class T>
    static void advance(const T* v, double dt, T* q) {
        for (std::size_t a = 0; a < 3; ++a) q[a] += dt * v[3 + a];
        turn_quat(q + 3, Vec3T<T>{v[0], v[1], v[2]} * T(dt));
    }
    template <class T>
    static void rate(const T* q, const T* v, T* rate) {
        for (std::size_t a = 0; a < 3; ++a) rate[a] = v[3 + a];
        put_quat_rate(q + 3, Vec3T<T>{v[0], v[1], v[2]}, rate + 3);
    }
    template <class T>
    static void normalise(T* q) {
        put_quat(q + 3, normalized(get_quat(q + 3)));
    }
};

}  // namespace roboss
