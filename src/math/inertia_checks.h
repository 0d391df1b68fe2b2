// Tests if a matrix can be the inertia of a body about its centre of mass.
#pragma once

#include <algorithm>

#include "math/vec3.h"

namespace roboss {

inline bool positive_definite(const Mat3& m) {
    const double minor2 = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    return m(0, 0) > 0 && minor2 > 0 && dot(m.r0, cross(m.r1, m.r2)) > 0;
}

/// Half the trace minus the inertia is the matrix of second moments of mass; a real body's is never negative.
inline bool obeys_triangle_inequality(const Mat3& inertia) {
    const double trace = inertia(0, 0) + inertia(1, 1) + inertia(2, 2);
    // A thin plate lies on the border; files round to few digits.
    const double slack = 1e-3 * trace;
    const double half = 0.5 * trace + slack;
    return positive_definite(Mat3::diagonal(half, half, half) - inertia);
}

/// A share of the greatest moment: less is lost in rounding. The mass matrix is singular then, and the state
/// soon not finite (seen below 1e-15).
inline constexpr double kVanishingShare = 1e-12;

/// About every axis there is more than what is lost in rounding.
inline bool resists_every_turn(const Mat3& m) {
    const double lost = kVanishingShare * std::max({m(0, 0), m(1, 1), m(2, 2), 0.0});
    return positive_definite(m - Mat3::diagonal(lost, lost, lost));
}

}  // namespace roboss
