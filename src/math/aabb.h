// Axis-aligned boxes in the world frame.
#pragma once

#include <cmath>
#include <limits>

#include "core/lanes.h"
#include "math/vec3.h"

namespace roboss {

/// Box with edges along the axes; m. A new one is empty.
template <class T>
struct AabbT {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();  ///< bound of the empty box
    Vec3T<T> min{kInfinity, kInfinity, kInfinity};                                ///< lowest corner
    Vec3T<T> max{-kInfinity, -kInfinity, -kInfinity};                             ///< highest corner

    /// Whether it holds no point.
    bool empty() const { return min.x > max.x; }
    /// Grows to hold p.
    void include(const Vec3T<T>& p) {
        min = {smaller(min.x, p.x), smaller(min.y, p.y), smaller(min.z, p.z)};
        max = {larger(max.x, p.x), larger(max.y, p.y), larger(max.z, p.z)};
    }
    /// An empty box changes nothing.
    void include(const AabbT& b) {
        min = {smaller(min.x, b.min.x), smaller(min.y, b.min.y), smaller(min.z, b.min.z)};
        max = {larger(max.x, b.max.x), larger(max.y, b.max.y), larger(max.z, b.max.z)};
    }
    /// Larger by `margin` (m) on every side.
    AabbT inflated(const T& margin) const {
        const Vec3T<T> m{margin, margin, margin};
        return {min - m, max + m};
    }
    /// Compares all members.
    friend bool operator==(const AabbT&, const AabbT&) = default;
    /// Centre; not of an empty box.
    Vec3T<T> centre() const { return (min + max) * T(0.5); }
};

using Aabb = AabbT<double>;

/// Closed boxes: touching counts as overlapping.
inline bool overlaps(const Aabb& a, const Aabb& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

}  // namespace roboss
