// A hinge: one angle about the axis.
#pragma once

#include "model/joints/joint_traits.h"
#include "model/joints/turned.h"

namespace roboss {

struct RevoluteJoint : OneCoordinate {
    static constexpr JointTraits kTraits{
        .name = "revolute", .unit = "rad", .turns = true, .is_periodic = true};

    /// m along the axis per unit of the coordinate.
    static double slide(const Body& /*body*/) { return 0; }

    template <class T>
    static TransformT<T> motion(const Body& body, const TransformT<T>& X_WJ, const T* q) {
        return {turned(X_WJ.R, body.axis_J, q[0]), X_WJ.p};
    }

    template <class T>
    static void axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& X_OB, SpatialT<T>* out) {
        const Vec3T<T> a = R_WJ * broadcast<T>(body.axis_J);
        out[0] = {a, cross(X_OB.p, a)};
    }
};

}  // namespace roboss
