// Narrow phase: contact points of two shapes. Pure functions of the two shapes and poses with a fixed order
// of operations (no libm but sqrt), so every machine gets the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/shape.h"

namespace roboss {

struct ContactPoint {
    Vec3 p_W;                   // midway between the two surfaces, m
    double gap = 0;             // signed distance along the normal, negative: penetration, m
    std::uint32_t feature = 0;  // names the same point on the same pair from tick to tick
};

struct Manifold {
    static constexpr int kMaxPoints = 8;
    Vec3 n_W;  // unit, from shape B towards shape A (push A along +n)
    int count = 0;
    std::array<ContactPoint, kMaxPoints> points;

    void add(const Vec3& p_W, double gap, std::uint32_t feature) {
        if (count < kMaxPoints) points[static_cast<std::size_t>(count++)] = {p_W, gap, feature};
    }
};

/// All points with gap <= margin. A box on a plane gives its four corners, a cylinder lying on its side the
/// two ends of its line, standing on its end four rim points. Empty (count 0) when apart. Points come in an
/// order that depends on the shapes and poses only. Plane against plane gives nothing, nor does a surface
/// (see collide_surface.h). Guaranteed: if the boxes bounds(A) and bounds(B), each inflated by margin / 2, do
/// not overlap, the result is empty.
Manifold collide(const Shape& a, const Transform& X_WA, const Shape& b, const Transform& X_WB, double margin);

/// The same for a caller that has compared such boxes.
Manifold collide_near(const Shape& a, const Transform& X_WA, const Shape& b, const Transform& X_WB,
                      double margin);

}  // namespace roboss
