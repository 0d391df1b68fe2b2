// A slide: one translation along the axis.
#pragma once

#include "model/joints/joint_traits.h"

namespace roboss {

struct PrismaticJoint : OneCoordinate {
    static constexpr JointTraits kTraits{.name = "prismatic", .unit = "m", .slides = true};

    static double slide(const Body& /*body*/) { return 1; }

    template <class T>
    static TransformT<T> motion(const Body& body, const TransformT<T>& X_WJ, const T* q) {
        return {X_WJ.R, X_WJ.p + X_WJ.R * (broadcast<T>(body.axis_J) * q[0])};
    }

    template <class T>
    static void axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& /*X_OB*/,
                     SpatialT<T>* out) {
        out[0] = {{}, R_WJ * broadcast<T>(body.axis_J)};
    }
};

}  // namespace roboss
