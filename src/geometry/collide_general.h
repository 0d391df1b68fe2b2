// Contacts of any two convex bodies along a direction that is known to separate them best: faces are clipped,
// lines crossed, and what is neither touches at one point.
#pragma once

#include "geometry/clip_feature.h"
#include "geometry/general_sum.h"

namespace roboss::narrow {

/// A manifold with names of 32 bits: part of the first << 16 | part of the second.
inline std::uint32_t wide_feature(std::uint32_t part_a, std::uint32_t part_b) {
    return part_a << 16 | (part_b & 0xFFFFu);
}

/// The best direction, or any that separates by more than `enough` (of the cores).
Separation best_separation(const ConvexBody& a, const ConvexBody& b, double enough);

/// Writes the contact along best.n; best.s is the cores' separation there.
void write_general(const ConvexBody& a, const ConvexBody& b, const Separation& best, double margin,
                   Manifold& out);

}  // namespace roboss::narrow
