// A bounding-volume hierarchy over boxes that never move (the static scenery), built once, shared by all.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fixed_math.h"
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

    /// Calls visit(item) for the bounded items whose boxes, and those above them in the tree, meets(box)
    /// says. In no order that means anything.
    template <class Meets, class Visit>
    void visit(Meets meets, Visit visit) const;

    /// Likewise visit(item of a, item of b) for pairs of which meets(box of a, box of b) says so.
    template <class Meets, class Visit>
    static void visit_pairs(const Bvh& a, const Bvh& b, Meets meets, Visit visit);

    /// True if there are items whose boxes overlap `box`; bounded items only.
    bool overlaps_any(const Aabb& box) const;

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

template <class Meets, class Visit>
void Bvh::visit(Meets meets, Visit visit) const {
    std::array<std::uint32_t, kStackDepth> stack{};
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t number = stack[--depth];
        const Node& node = nodes_[number];
        if (!meets(node.box)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first;
            stack[depth++] = number + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (meets(item_boxes_[i])) visit(items_[i]);
    }
}

template <class Meets, class Visit>
void Bvh::visit_pairs(const Bvh& a, const Bvh& b, Meets meets, Visit visit) {
    struct NodePair {
        std::uint32_t a, b;
    };
    std::array<NodePair, 2 * kStackDepth> stack;  // read below `depth` only
    std::size_t depth = 0;
    if (!a.nodes_.empty() && !b.nodes_.empty()) stack[depth++] = {0, 0};
    const auto size = [](const Node& node) { return norm_squared(node.box.max - node.box.min); };
    while (depth > 0) {
        const NodePair pair = stack[--depth];
        const Node &node_a = a.nodes_[pair.a], &node_b = b.nodes_[pair.b];
        if (!meets(node_a.box, node_b.box)) continue;
        if (node_a.count == 0 && (node_b.count > 0 || size(node_a) >= size(node_b))) {
            stack[depth++] = {node_a.first, pair.b}, stack[depth++] = {pair.a + 1, pair.b};
        } else if (node_b.count == 0) {
            stack[depth++] = {pair.a, node_b.first}, stack[depth++] = {pair.a, pair.b + 1};
        } else {
            for (std::uint32_t i = node_a.first; i < node_a.first + node_a.count; ++i)
                for (std::uint32_t j = node_b.first; j < node_b.first + node_b.count; ++j)
                    if (meets(a.item_boxes_[i], b.item_boxes_[j])) visit(a.items_[i], b.items_[j]);
        }
    }
}

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
            limit = fixed_min(limit, distance_to(items_[i]));
    }
    return limit;
}

}  // namespace roboss
