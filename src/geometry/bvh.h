// A bounding-volume hierarchy over boxes that never move (the static scenery), built once, shared by all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/aabb.h"

namespace roboss {

class Bvh {
  public:
    Bvh() = default;
    /// Items are numbered as in `boxes`. Infinite boxes are allowed (planes); they are tested one by one.
    explicit Bvh(std::span<const Aabb> boxes);

    /// Appends the numbers of all items whose box overlaps `box`, in ascending order, to `out` (cleared
    /// first; no allocation once its capacity suffices).
    void query(const Aabb& box, std::vector<std::uint32_t>& out) const;

  private:
    struct Node {
        Aabb box;
        std::uint32_t first = 0;  // leaf: first item in items_; inner: right child (the left one follows)
        std::uint32_t count = 0;  // leaf: how many items; inner: 0
    };
    struct Builder;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;
    std::vector<Aabb> item_boxes_;         // in the order of items_, then of infinite_
    std::vector<std::uint32_t> infinite_;  // items with an infinite box
};

}  // namespace roboss
