// Median split on the longest axis of the centres: the tree is balanced whatever the scenery, so the
// traversal stack has a fixed size, and ties are broken by item number, so that the tree is the same for
// every standard library.
#include "geometry/bvh.h"

#include <algorithm>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr std::uint32_t kLeafItems = 4;

bool is_bounded(const Aabb& box) {
    return is_finite(box.min) && is_finite(box.max);
}

std::size_t longest_axis(const Aabb& box) {
    const Vec3 d = box.max - box.min;
    if (d.x >= d.y && d.x >= d.z) return 0;
    return d.y >= d.z ? 1 : 2;
}

}  // namespace

// Builds the nodes in depth-first order: a node, its left subtree, its right subtree.
struct Bvh::Builder {
    std::span<const Aabb> boxes;
    Bvh& bvh;

    std::uint32_t build(std::uint32_t first, std::uint32_t count) {
        const auto number = static_cast<std::uint32_t>(bvh.nodes_.size());
        bvh.nodes_.emplace_back();
        Node node;
        Aabb centres;
        for (std::uint32_t i = first; i < first + count; ++i) {
            node.box.include(boxes[bvh.items_[i]]);
            centres.include(boxes[bvh.items_[i]].centre());
        }
        if (count <= kLeafItems) {
            node.first = first;
            node.count = count;
        } else {
            const std::uint32_t left = count / 2;
            split(first, count, left, longest_axis(centres));
            build(first, left);
            node.first = build(first + left, count - left);
        }
        bvh.nodes_[number] = node;
        return number;
    }

    void split(std::uint32_t first, std::uint32_t count, std::uint32_t left, std::size_t axis) {
        const auto begin = bvh.items_.begin() + first;
        std::nth_element(begin, begin + left, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            const double ca = boxes[a].centre()[axis];
            const double cb = boxes[b].centre()[axis];
            return ca != cb ? ca < cb : a < b;
        });
    }
};

Bvh::Bvh(std::span<const Aabb> boxes) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].empty()) continue;  // overlaps nothing
        (is_bounded(boxes[i]) ? items_ : infinite_).push_back(i);
    }
    if (!items_.empty()) {
        nodes_.reserve(items_.size());
        Builder{boxes, *this}.build(0, static_cast<std::uint32_t>(items_.size()));
    }
    item_boxes_.reserve(items_.size());
    for (std::uint32_t item : items_) item_boxes_.push_back(boxes[item]);
    for (std::uint32_t item : infinite_) item_boxes_.push_back(boxes[item]);
}

void Bvh::query(const Aabb& box, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        if (overlaps(item_boxes_[items_.size() + i], box)) out.push_back(infinite_[i]);
    }
    // Read below `depth` only. NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
    std::array<std::uint32_t, kStackDepth> stack;
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t number = stack[--depth];
        const Node& node = nodes_[number];
        if (!overlaps(node.box, box)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first;
            stack[depth++] = number + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (overlaps(item_boxes_[i], box)) out.push_back(items_[i]);
        }
    }
    std::sort(out.begin(), out.end());
}

bool Bvh::overlaps_any(const Aabb& box) const {
    bool found = false;
    visit([&](const Aabb& other) { return !found && overlaps(other, box); },
          [&](std::uint32_t) { found = true; });
    return found;
}

bool Bvh::meets(const Aabb& box, const Vec3& origin, const Vec3& direction, double limit) {
    // Rounding must not lose a hit on the border of a flat box.
    double enter = 0, leave = limit;
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack =
            1e-12 * (1.0 + std::fabs(box.min[k]) + std::fabs(box.max[k]) + std::fabs(origin[k]));
        const double low = box.min[k] - slack - origin[k], high = box.max[k] + slack - origin[k];
        if (std::fabs(direction[k]) < 1e-300) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double a = low / direction[k], b = high / direction[k];
        enter = fixed_max(enter, fixed_min(a, b));
        leave = fixed_min(leave, fixed_max(a, b));
    }
    return enter <= leave;
}

}  // namespace roboss
