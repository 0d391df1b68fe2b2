// Sweep and prune in strips.
#include "schedule/sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace roboss {

namespace {
constexpr double kStripsMax = 4096;
}

std::uint32_t Sweep::Strips::of(float y) const {
    const double strip = (static_cast<double>(y) - origin) / height;
    if (!(strip > 0)) return 0;
    return strip >= static_cast<double>(count) ? count - 1 : static_cast<std::uint32_t>(strip);
}

Sweep::Strips Sweep::cut(std::span<const OwnedBox> boxes) {
    double low = 0, high = 0, heights = 0;
    std::size_t n = 0;
    for (const OwnedBox& b : boxes) {
        const double bottom = b.box.min[1], top = b.box.max[1];
        if (!std::isfinite(bottom) || !std::isfinite(top)) continue;
        low = n == 0 ? bottom : std::min(low, bottom);
        high = n == 0 ? top : std::max(high, top);
        heights += top - bottom;
        ++n;
    }
    Strips strips;
    if (n < 64) return strips;
    // a few mean box heights a strip, and no more strips than sqrt(n), so that tall boxes are not repeated
    // often
    const double wanted =
        std::max(4.0 * heights / static_cast<double>(n), (high - low) / std::sqrt(static_cast<double>(n)));
    if (!(wanted > 0) || !std::isfinite(wanted)) return strips;
    strips.origin = low;
    strips.height = wanted;
    strips.count = static_cast<std::uint32_t>(std::clamp(std::ceil((high - low) / wanted), 1.0, kStripsMax));
    return strips;
}

void Sweep::fill(std::span<const OwnedBox> boxes, const Strips& strips) {
    offsets_.assign(strips.count + 1, 0);
    for (const OwnedBox& b : boxes)
        for (std::uint32_t s = strips.of(b.box.min[1]), last = strips.of(b.box.max[1]); s <= last; ++s)
            ++offsets_[s + 1];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    entries_.resize(offsets_.back());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t s = strips.of(boxes[i].box.min[1]), last = strips.of(boxes[i].box.max[1]);
             s <= last; ++s)
            entries_[next[s]++] = {boxes[i].box.min[0], i};
}

std::size_t Sweep::sweep(std::span<const OwnedBox> boxes, std::span<Entry> strip, UnionFind& sets) {
    std::sort(strip.begin(), strip.end(), [](const Entry& a, const Entry& b) {
        return a.left != b.left ? a.left < b.left : a.box < b.box;
    });
    sorted_.clear();
    for (const Entry& entry : strip) sorted_.push_back(boxes[entry.box]);
    std::size_t unions = 0;
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const OwnedBox& a = sorted_[i];
        for (std::size_t j = i + 1; j < sorted_.size() && sorted_[j].box.min[0] <= a.box.max[0]; ++j) {
            const OwnedBox& b = sorted_[j];
            if (a.owner != b.owner && overlaps(a.box, b.box) && sets.unite(a.owner, b.owner)) ++unions;
        }
    }
    return unions;
}

std::size_t Sweep::unite_overlapping(std::span<const OwnedBox> boxes, UnionFind& sets) {
    const Strips strips = cut(boxes);
    fill(boxes, strips);
    std::size_t unions = 0;
    for (std::uint32_t s = 0; s < strips.count; ++s)
        unions += sweep(boxes, std::span(entries_).subspan(offsets_[s], offsets_[s + 1] - offsets_[s]), sets);
    return unions;
}

}  // namespace roboss
