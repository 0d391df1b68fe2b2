// A bounding-volume hierarchy over boxes that never move (the static scenery), built once, shared by all.
#pragma once

#include <array>
#include <cmath>
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

    /// The smallest distance that `distance_to(item)` gives over the items whose box the ray meets nearer
    /// than the best so far; `limit` if none is smaller. Bounded items only.
    template <class Distance>
    double nearest(const Vec3& origin, const Vec3& direction, double limit, Distance distance_to) const;

  private:
    static constexpr std::size_t kStackDepth = 64;  // a balanced tree over 2^32 items is at most 32 deep
    static bool meets(const Aabb& box, const Vec3& origin, const Vec3& direction, double limit);

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

template <class Distance>
double Bvh::nearest(const Vec3& origin, const Vec3& direction, double limit, Distance distance_to) const {
    std::array<std::uint32_t, kStackDepth> stack{};
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t number = stack[--depth];
        const Node& node = nodes_[number];
        if (!meets(node.box, origin, direction, limit)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first;
            stack[depth++] = number + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            limit = std::fmin(limit, distance_to(items_[i]));
    }
    return limit;
}

}  // namespace roboss
