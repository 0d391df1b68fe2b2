// Motions and forces about another point than O.
#pragma once

#include "math/spatial.h"

namespace roboss {

/// The motion about O as one about a point at p from O.
inline Spatial motion_about(const Spatial& motion, const Vec3& p) {
    return {motion.angular, motion.linear + cross(motion.angular, p)};
}

/// The force about O as one about a point at p from O.
inline Spatial force_about(const Spatial& force, const Vec3& p) {
    return {force.angular - cross(p, force.linear), force.linear};
}

/// The force about a point at p from O as one about O.
inline Spatial force_from(const Spatial& force, const Vec3& p) {
    return {force.angular + cross(p, force.linear), force.linear};
}

}  // namespace roboss
