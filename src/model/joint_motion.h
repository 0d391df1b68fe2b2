// What a joint does, in one place for the step, the compiler and every reading: where its coordinates put its
// body, and how the body moves per unit of its velocities. The formulas are in src/model/joints, a file a
// motion; visit_joint() is their register.
#pragma once

#include <span>

#include "model/joints/ball.h"
#include "model/joints/free.h"
#include "model/joints/prismatic.h"
#include "model/joints/revolute.h"
#include "model/joints/screw.h"
#include "world/joint_kind.h"

namespace roboss {

/// Calls visit(RevoluteJoint{}) and so on. What is no JointKind is taken for kFree (broken_part() refuses
/// it).
template <class Visit>
decltype(auto) visit_joint(JointKind kind, Visit&& visit) {
    switch (kind) {
        case JointKind::kRevolute:
            return visit(RevoluteJoint{});
        case JointKind::kPrismatic:
            return visit(PrismaticJoint{});
        case JointKind::kScrew:
            return visit(ScrewJoint{});
        case JointKind::kBall:
            return visit(BallJoint{});
        case JointKind::kFree:
            break;
    }
    return visit(FreeJoint{});
}

inline const JointTraits& joint_traits(JointKind kind) {
    return visit_joint(kind, [](auto joint) -> const JointTraits& { return decltype(joint)::kTraits; });
}

/// m along the body's axis per unit of its coordinate.
inline double slide_of(const Body& body) {
    return visit_joint(body.joint, [&](auto joint) { return joint.slide(body); });
}

/// Pose of the body's frame: X_WJ is the joint frame before its motion, q all coordinates of the robot.
template <class T>
TransformT<T> joint_motion(const Body& body, const TransformT<T>& X_WJ, std::span<const T> q) {
    const T* own = q.data() + body.q_index;
    return visit_joint(body.joint, [&](auto joint) { return joint.motion(body, X_WJ, own); });
}

/// Motions about O per unit of the joint's velocities. R_WJ: joint frame before its motion; X_OB: the body's
/// frame, its origin from O, world axes.
template <class T>
void joint_axes(const Body& body, const Mat3T<T>& R_WJ, const TransformT<T>& X_OB, SpatialT<T>* axes) {
    visit_joint(body.joint, [&](auto joint) { joint.axes(body, R_WJ, X_OB, axes); });
}

}  // namespace roboss
