// Boxes in images, and what boxes of space look like in them.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "math/aabb.h"
#include "render/lens.h"

namespace roboss::render {

/// In pixels; empty while left is beyond right.
struct ImageBox {
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;

    void include(double l, double t, double r, double b) {
        left = std::min(left, l), top = std::min(top, t);
        right = std::max(right, r), bottom = std::max(bottom, b);
    }
    /// The part of it within the image.
    ImageBox cut(const CameraOptics& optics) const {
        return {std::max(left, 0.0), std::max(top, 0.0), std::min(right, static_cast<double>(optics.width)),
                std::min(bottom, static_cast<double>(optics.height))};
    }
    /// Of an empty one 0.
    double area() const { return std::max(0.0, right - left) * std::max(0.0, bottom - top); }
};

/// Bit 0, 1, 2 of an index: at the high end of x, y, z.
std::array<Vec3, 8> corners_of(const Aabb& box);

/// What boxes look like, also beyond the edges of the image. `corners_C`: in the camera's frame, eight of
/// each box as of corners_of(). Edges are cut at the near plane.
ImageBox image_of(const Lens& lens, double near, std::span<const Vec3> corners_C);

}  // namespace roboss::render
