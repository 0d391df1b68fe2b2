// A box in single precision that surely contains its double original: what swept bounds travel as (24 bytes).
// Rounded outward, so it can only make two robots look closer than they are, which costs time and never
// truth.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "math/aabb.h"

namespace roboss {

/// The largest float that is not above `value`; -infinity for NaN.
inline float round_down(double value) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float f = static_cast<float>(value);
    if (static_cast<double>(f) <= value) return f;
    return std::isnan(value) ? -kInfinity : std::nextafter(f, -kInfinity);
}

/// The smallest float that is not below `value`; +infinity for NaN.
inline float round_up(double value) {
    return -round_down(-value);
}

struct Box32 {
    std::array<float, 3> min{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity()};
    std::array<float, 3> max{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};

    friend bool operator==(const Box32&, const Box32&) = default;
};

/// The box, or all of space if it is invalid (empty, or a bound is no number): a robot with such a bound is
/// stepped together with all others.
inline Aabb valid_or_everywhere(const Aabb& box) {
    constexpr double kInfinity = Aabb::kInfinity;
    const bool valid = box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z;
    return valid ? box : Aabb{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

/// An empty box stays empty; a bound that is NaN becomes infinite (overlaps everything).
inline Box32 outward(const Aabb& box) {
    return {{round_down(box.min.x), round_down(box.min.y), round_down(box.min.z)},
            {round_up(box.max.x), round_up(box.max.y), round_up(box.max.z)}};
}

/// Closed boxes: touching counts as overlapping.
inline bool overlaps(const Box32& a, const Box32& b) {
    return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] && a.min[1] <= b.max[1] && b.min[1] <= a.max[1] &&
           a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

}  // namespace roboss
