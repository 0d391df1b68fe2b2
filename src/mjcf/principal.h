// Principal moments and axes of an inertia.
#pragma once

#include <array>

#include "math/quat.h"
#include "math/vec3.h"

namespace roboss::mjcf {

struct PrincipalAxes {
    std::array<double, 3> moments{};  ///< the largest first
    Quat q;                           ///< from the principal axes to the frame of the inertia
};

/// Of a symmetric matrix.
PrincipalAxes principal_axes(const Mat3& inertia);

/// The symmetric matrix with these moments about the axes of `q`.
Mat3 from_principal(const Vec3& moments, const Quat& q);

}  // namespace roboss::mjcf
