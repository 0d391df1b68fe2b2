// Poses of bodies, geoms, sites, frames and inertias: pos, and one of quat, axisangle, xyaxes, zaxis, euler.
#pragma once

#include "math/pose.h"
#include "mjcf/attributes.h"
#include "mjcf/settings.h"

namespace roboss::mjcf {

/// A rotation by angles (rad) about the axes of `sequence`: lower case turns with the frame, upper case does
/// not.
Quat from_euler(const Vec3& angles, const std::string& sequence);

/// The shortest rotation that turns z into this direction.
Quat from_z(const Vec3& direction);

/// The orientation that the attributes give; identity: none. Two of them in one element are an error.
Quat read_orientation(const Attributes& attributes, const Settings& settings);

Pose read_pose(const Attributes& attributes, const Settings& settings);

}  // namespace roboss::mjcf
