// See ray_tree.h. Rounding: coordinates are relative to the centre and a ray starts where it enters the cube
// of half edges `extent_`, so each number that a tracer sees is at most a few `extent_`, and its error a few
// units of 2^-24 of that. `margin_`, 2^-18 of the extent, covers it with room to spare.
#include "sensors/ray_tree.h"

#include <algorithm>
#include <cmath>

namespace roboss {
namespace {

using render::BoxNode;

void include(BoxNode& node, const BoxNode& child) {
    for (std::size_t k = 0; k < 3; ++k) {
        node.min[k] = std::min(node.min[k], child.min[k]);
        node.max[k] = std::max(node.max[k], child.max[k]);
    }
}

double area_of(const BoxNode& node) {
    const auto edge = [&](std::size_t k) { return static_cast<double>(node.max[k] - node.min[k]); };
    return edge(0) * edge(1) + edge(1) * edge(2) + edge(2) * edge(0);
}

}  // namespace

void RayTree::update(std::span<const Aabb> boxes) {
    constexpr double kGrown = 1.5;  // times its area when it was built
    if (boxes.empty()) {
        tree_ = {};
        return;
    }
    Aabb all;
    for (const Aabb& box : boxes) all.include(box);
    const Vec3 low = all.min - centre_, high = all.max - centre_;
    const double reach = std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z}) + 2 * margin_;
    const bool fits = tree_.order.size() == boxes.size() && reach <= extent_;
    if (fits && refit(boxes) <= kGrown * area_) return;
    build(boxes);
}

void RayTree::build(std::span<const Aabb> boxes) {
    constexpr double kRoom = 1.25;  // for boxes that move
    Aabb all;
    for (const Aabb& box : boxes) all.include(box);
    const Vec3 size = all.max - all.min;
    centre_ = all.centre();
    extent_ = kRoom * (0.5 * std::max({size.x, size.y, size.z}) + 1.0);
    margin_ = 0x1p-18 * extent_;
    tree_ = render::make_box_tree(boxes, 1, centre_);
    area_ = refit(boxes);
}

double RayTree::refit(std::span<const Aabb> boxes) {
    double area = 0;
    for (std::size_t n = tree_.nodes.size(); n-- > 0;) {  // children stand behind their parents
        BoxNode& node = tree_.nodes[n];
        if (node.count == 0) {
            const BoxNode &left = tree_.nodes[node.first], &right = tree_.nodes[node.first + 1];
            std::copy(left.min, left.min + 3, node.min), std::copy(left.max, left.max + 3, node.max);
            include(node, right);
        } else {
            const Aabb& box = boxes[tree_.order[node.first]];  // a leaf has one item
            for (std::size_t k = 0; k < 3; ++k) {
                node.min[k] = static_cast<float>(box.min[k] - centre_[k] - margin_);
                node.max[k] = static_cast<float>(box.max[k] - centre_[k] + margin_);
            }
        }
        area += area_of(node);
    }
    return area;
}

RayTreeView RayTree::view(std::span<const RayItem> items) const {
    if (tree_.nodes.empty()) return {};
    return {tree_.nodes.data(), tree_.order.data(), items, centre_, extent_, margin_};
}

}  // namespace roboss
