// One face of a box as a rectangle with numbered parts, and the clipping of another face against it. Numbers
// of a box's parts (8 bits): corners 0 .. 7 (bit i: the + side of axis i), edges 8 .. 19, 31 for a face.
#pragma once

#include <array>

#include "geometry/narrow.h"

namespace roboss::narrow {

inline constexpr std::uint32_t kFacePart = 31;

inline std::uint32_t feature_of(std::uint32_t part_a, std::uint32_t part_b) {
    return part_a << 8 | part_b;
}

/// Number of the edge along `axis`, on the + side (1) or - side (0) of the two axes that follow it
/// cyclically.
inline std::uint32_t edge_part(std::size_t axis, std::uint32_t next_side, std::uint32_t last_side) {
    return 8 + static_cast<std::uint32_t>(axis) * 4 + next_side + 2 * last_side;
}

struct BoxFace {
    Vec3 centre, n;  // centre in W, outward unit normal
    Vec3 ex, ey;     // unit vectors of the rectangle; ex x ey = the box's axis k, not always n
    double hx = 0, hy = 0;
    std::size_t k = 0;       // the box's axis across the face; ex is axis k + 1, ey axis k + 2
    std::uint32_t side = 0;  // 1: the + side of axis k

    /// The face of `box` that looks most along d.
    BoxFace(const Posed& box, const Vec3& d);
    BoxFace(const Posed& box, std::size_t axis, bool upper);

    /// Corners are counted round the rectangle: (+,+), (-,+), (-,-), (+,-).
    std::uint32_t corner_part(std::size_t corner) const;
    /// The edge from a corner to the next.
    std::uint32_t edge_part_after(std::size_t corner) const;
};

/// A point over a reference face: x and y in the face, gap along its normal, and the parts that made it.
struct ClippedPoint {
    double x = 0, y = 0, gap = 0;
    std::uint32_t part = kFacePart;            // of the incident shape
    std::uint32_t reference_part = kFacePart;  // of the reference box
};

struct ClippedFace {
    int count = 0;
    std::array<ClippedPoint, 8> points;
};

/// The part of the incident face inside the prism over the reference face; corners of the resulting polygon
/// that nearly coincide are merged and named after the box corner they sit at, so rounding does not rename
/// the points of a stack.
ClippedFace clip(const BoxFace& reference, const BoxFace& incident);

/// Adds the points with gap <= margin. `reference_is_first`: the reference face belongs to the pair's first
/// shape.
void add_clipped(const BoxFace& reference, const ClippedFace& clipped, bool reference_is_first, double margin,
                 Manifold& out);

}  // namespace roboss::narrow
