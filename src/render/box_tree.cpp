// See box_tree.h.
#include "render/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace roboss::render {
namespace {

constexpr std::size_t kBins = 16;
constexpr std::size_t kHalvedFrom = 40;  // depth from which ranges are halved: 40 + 32 levels at most

struct Bin {
    Aabb box;
    std::size_t count = 0;
};

double area(const Aabb& box) {
    if (box.empty()) return 0;
    const Vec3 e = box.max - box.min;
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Builder {
    std::span<const Aabb> boxes;
    std::vector<Vec3> centres;
    std::size_t leaf_most;
    Vec3 origin;
    BoxTree tree;

    struct Range {
        std::size_t node, first, last, depth;
    };

    Aabb box_of(std::size_t first, std::size_t last) const {
        Aabb box;
        for (std::size_t i = first; i < last; ++i) box.include(boxes[tree.order[i]]);
        return box;
    }

    void set_box(BoxNode& node, const Aabb& box) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const double low = box.min[k] - origin[k], high = box.max[k] - origin[k];
            const float margin = 1e-6F * static_cast<float>(std::fabs(low) + std::fabs(high)) + 1e-7F;
            node.min[k] = static_cast<float>(low) - margin;
            node.max[k] = static_cast<float>(high) + margin;
        }
    }

    /// Where to part the range, in order of one axis; `first`: nowhere, it stays a leaf.
    std::size_t part(const Range& range) {
        const std::size_t count = range.last - range.first;
        if (count <= leaf_most) return range.first;
        Aabb middle;
        for (std::size_t i = range.first; i < range.last; ++i) middle.include(centres[tree.order[i]]);
        const Vec3 extent = middle.max - middle.min;
        const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                                 : extent.y >= extent.z                       ? 1
                                                                              : 2;
        const auto begin = tree.order.begin() + static_cast<std::ptrdiff_t>(range.first);
        const auto end = tree.order.begin() + static_cast<std::ptrdiff_t>(range.last);
        if (extent[axis] > 0 && range.depth < kHalvedFrom) {
            const double scale = static_cast<double>(kBins) * (1 - 1e-12) / extent[axis];
            const auto bin_of = [&](std::uint32_t item) {
                return static_cast<std::size_t>((centres[item][axis] - middle.min[axis]) * scale);
            };
            const std::size_t best = best_bin(range, bin_of);
            const auto at = std::partition(begin, end, [&](std::uint32_t i) { return bin_of(i) < best; });
            if (at != begin && at != end) return static_cast<std::size_t>(at - tree.order.begin());
        }
        const std::size_t half = range.first + count / 2;
        std::nth_element(begin, tree.order.begin() + static_cast<std::ptrdiff_t>(half), end,
                         [&](std::uint32_t a, std::uint32_t b) {
                             return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis]
                                                                         : a < b;
                         });
        return half;
    }

    template <class BinOf>
    std::size_t best_bin(const Range& range, const BinOf& bin_of) const {
        std::array<Bin, kBins> bins;
        for (std::size_t i = range.first; i < range.last; ++i) {
            Bin& bin = bins[bin_of(tree.order[i])];
            bin.box.include(boxes[tree.order[i]]), ++bin.count;
        }
        std::array<double, kBins> below{};
        Bin sum;
        for (std::size_t b = 0; b + 1 < kBins; ++b) {
            sum.box.include(bins[b].box), sum.count += bins[b].count;
            below[b + 1] = area(sum.box) * static_cast<double>(sum.count);
        }
        sum = {};
        std::size_t best = 0;
        double least = Aabb::kInfinity;
        for (std::size_t b = kBins - 1; b > 0; --b) {
            sum.box.include(bins[b].box), sum.count += bins[b].count;
            const double cost = below[b] + area(sum.box) * static_cast<double>(sum.count);
            if (cost < least) least = cost, best = b;
        }
        return best;
    }

    void build() {
        tree.order.resize(boxes.size());
        std::iota(tree.order.begin(), tree.order.end(), 0u);
        for (const Aabb& box : boxes) centres.push_back(box.centre());
        tree.nodes.reserve(2 * boxes.size());
        tree.nodes.emplace_back();
        std::vector<Range> open{{0, 0, boxes.size(), 0}};
        while (!open.empty()) {
            const Range range = open.back();
            open.pop_back();
            set_box(tree.nodes[range.node], box_of(range.first, range.last));
            const std::size_t at = part(range);
            BoxNode& node = tree.nodes[range.node];
            if (at == range.first) {
                node.first = static_cast<std::uint32_t>(range.first);
                node.count = static_cast<std::uint32_t>(range.last - range.first);
                continue;
            }
            const std::size_t left = tree.nodes.size();
            node.first = static_cast<std::uint32_t>(left), node.count = 0;
            tree.nodes.emplace_back(), tree.nodes.emplace_back();
            open.push_back({left, range.first, at, range.depth + 1});
            open.push_back({left + 1, at, range.last, range.depth + 1});
        }
    }
};

}  // namespace

BoxTree make_box_tree(std::span<const Aabb> boxes, std::size_t leaf_most, const Vec3& origin) {
    if (boxes.empty()) return {};
    Builder builder{boxes, {}, leaf_most, origin, {}};
    builder.build();
    return std::move(builder.tree);
}

}  // namespace roboss::render
