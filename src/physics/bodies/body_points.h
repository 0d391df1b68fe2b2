// Impulses and curvatures of the contact points of free bodies (body_island.h), as BodySolver needs them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/bodies/body_island.h"

namespace roboss {

/// Curvatures of a contact at the present velocities.
inline void set_curvature(BodyPoint& p) {
    p.d_n = p.target_n > p.u_n ? p.stiffness_n : 0;
    p.d_1n = p.d_2n = p.d_11 = p.d_12 = p.d_22 = 0;
    if (!(p.bound > 0)) return;
    const double speed = std::sqrt(p.u_1 * p.u_1 + p.u_2 * p.u_2);
    if (speed * p.stiffness_t > p.bound) {
        const double e1 = p.u_1 / speed, e2 = p.u_2 / speed, share = p.bound / speed;
        p.d_11 = share * (1 - e1 * e1), p.d_12 = -share * e1 * e2, p.d_22 = share * (1 - e2 * e2);
    } else {
        p.d_11 = p.d_22 = p.stiffness_t;
    }
}

/// Derivatives of sliding friction by the normal velocity, its bound moving with the normal impulse; true
/// where anything slides.
inline bool couple_bounds(std::vector<BodyPoint>& points) {
    bool slides = false;
    for (BodyPoint& p : points) {
        if (p.d_n == 0 || !(p.bound > 0)) continue;
        const double speed = std::sqrt(p.u_1 * p.u_1 + p.u_2 * p.u_2);
        if (!(speed * p.stiffness_t > p.bound)) continue;
        const double share = -p.coefficient * p.d_n / speed;
        p.d_1n = share * p.u_1, p.d_2n = share * p.u_2;
        slides = true;
    }
    return slides;
}

/// The point as it would be if it pushed and stuck.
inline void stick(BodyPoint& p) {
    p.d_11 = p.d_22 = p.stiffness_t, p.d_12 = 0;
    p.f_1 = -p.u_1 * p.stiffness_t, p.f_2 = -p.u_2 * p.stiffness_t;
}
inline void push(BodyPoint& p) {
    p.d_n = p.stiffness_n;
    p.f_n = (p.target_n - p.u_n) * p.stiffness_n;
}

/// Change of a point's friction if its bound became that of its normal impulse.
inline double friction_change(const BodyPoint& p) {
    const double f_1 = -p.u_1 * p.stiffness_t, f_2 = -p.u_2 * p.stiffness_t;
    const double wanted = p.coefficient * p.f_n, size2 = f_1 * f_1 + f_2 * f_2;
    const double share = size2 > wanted * wanted ? wanted / std::sqrt(size2) : 1;
    return std::fabs(f_1 * share - p.f_1) + std::fabs(f_2 * share - p.f_2);
}

}  // namespace roboss
