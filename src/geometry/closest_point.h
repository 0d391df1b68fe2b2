// The point of a triangle that is closest to another: where the search for a separating direction begins.
#pragma once

#include <algorithm>
#include <array>

#include "math/vec3.h"

namespace roboss::narrow {

/// On the triangle v.
inline Vec3 closest_point(const std::array<Vec3, 3>& v, const Vec3& p) {
    // Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
    const auto on_edge = [&](std::size_t a, std::size_t b) {
        const Vec3 along = v[b] - v[a];
        return v[a] + along * std::clamp(dot(p - v[a], along) / norm_squared(along), 0.0, 1.0);
    };
    const Vec3 ab = v[1] - v[0], ac = v[2] - v[0], ap = p - v[0], bp = p - v[1], cp = p - v[2];
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return v[0];
    if (d3 >= 0 && d4 <= d3) return v[1];
    if (d6 >= 0 && d5 <= d6) return v[2];
    const double c = d1 * d4 - d3 * d2, b = d5 * d2 - d1 * d6, a = d3 * d6 - d5 * d4;
    if (c <= 0 && d1 >= 0 && d3 <= 0) return on_edge(0, 1);
    if (b <= 0 && d2 >= 0 && d6 <= 0) return on_edge(0, 2);
    if (a <= 0 && d4 >= d3 && d5 >= d6) return on_edge(1, 2);
    return v[0] + ab * (b / (a + b + c)) + ac * (c / (a + b + c));
}

}  // namespace roboss::narrow
