// Axis-aligned boxes in the world frame.
#pragma once

#include <cmath>
#include <limits>

#include "math/vec3.h"

namespace roboss {

struct Aabb {
    Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    Vec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

    bool empty() const { return min.x > max.x; }
    void include(const Vec3& p) {
        min = {std::fmin(min.x, p.x), std::fmin(min.y, p.y), std::fmin(min.z, p.z)};
        max = {std::fmax(max.x, p.x), std::fmax(max.y, p.y), std::fmax(max.z, p.z)};
    }
    void include(const Aabb& b) {
        if (b.empty()) return;
        include(b.min);
        include(b.max);
    }
    Aabb inflated(double margin) const {
        const Vec3 m{margin, margin, margin};
        return {min - m, max + m};
    }
    friend bool operator==(const Aabb&, const Aabb&) = default;
    Vec3 centre() const { return (min + max) * 0.5; }
};

/// Closed boxes: touching counts as overlapping.
inline bool overlaps(const Aabb& a, const Aabb& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

}  // namespace roboss
