// A thread: one angle about the axis, and pitch times that angle along it.
#pragma once

#include "model/joints/joint_traits.h"
#include "model/joints/turned.h"

namespace roboss {

struct ScrewJoint : OneCoordinate {
    static constexpr JointTraits kTraits{
        .name = "screw", .unit = "rad", .turns = true, .slides = true, .has_pitch = true};

    static double slide(const Body& body) { return body.pitch; }

    template <class T>
    static TransformT<T> motion(const Body& body, const TransformT<T>& X_WJ, const T* q) {
        const T displacement = T(body.pitch) * q[0];
        return {turned(X_WJ.R, body.axis_J, q[0]),
                X_WJ.p + X_WJ.R * (broadcast<T>(body.axis_J) * displacement)};
    }

    template <class T>
    static void axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& X_OB, SpatialT<T>* out) {
        const Vec3T<T> a = R_WJ * broadcast<T>(body.axis_J);
        out[0] = {a, cross(X_OB.p, a) + a * T(body.pitch)};
    }
};

}  // namespace roboss
