// A tree of boxes for rays, in floats: a leaf holds a few items, an inner node two children side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/aabb.h"

namespace roboss::render {

struct BoxNode {
    float min[3] = {0, 0, 0};
    std::uint32_t first = 0;  // leaf: place of its first item in the order; inner: its left child
    float max[3] = {0, 0, 0};
    std::uint32_t count = 0;  // leaf: how many items; inner: 0
};

struct BoxTree {
    static constexpr std::size_t kDepthMost = 80;
    std::vector<BoxNode> nodes;        // the root first; empty: no items
    std::vector<std::uint32_t> order;  // items by leaf
};

/// Over finite boxes, which are rounded outwards; `origin` is subtracted from them. A function of its
/// arguments alone: split by the surface area heuristic (Wald, 2007), halved where that finds nothing.
BoxTree make_box_tree(std::span<const Aabb> boxes, std::size_t leaf_most, const Vec3& origin = {});

}  // namespace roboss::render
