// See meetings.h.
#include "physics/contact/meetings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roboss {

void Meetings::join(std::span<const Aabb> boxes, std::span<const std::uint32_t> wanted, UnionFind& sets) {
    constexpr std::size_t kFew = 12;  // each against all is quicker than sorting
    reached_.assign(wanted.begin(), wanted.end());
    is_reached_.assign(boxes.size(), 0);
    for (const std::uint32_t i : wanted) is_reached_[i] = 1;
    for (std::size_t k = 0; k < reached_.size(); ++k) {
        if (reached_.size() > kFew) return join_by_strips(boxes, sets);
        const std::uint32_t i = reached_[k];
        for (std::uint32_t j = 0; j < boxes.size(); ++j) {
            if (j == i || !overlaps(boxes[i], boxes[j])) continue;
            sets.unite(i, j);
            if (!std::exchange(is_reached_[j], 1)) reached_.push_back(j);
        }
    }
}

/// Boxes sorted by strips along y, and by x within a strip: a box can meet those of its own strip and of the
/// next ones. A box far wider than the others makes one strip of all, which is a plain sweep along x.
void Meetings::join_by_strips(std::span<const Aabb> boxes, UnionFind& sets) {
    double wide_x = 0, wide_y = 1e-6, largest = 0;
    for (const Aabb& box : boxes) {
        wide_x = std::max(wide_x, box.max.x - box.min.x), wide_y = std::max(wide_y, box.max.y - box.min.y);
        largest = std::max(largest, std::fabs(box.min.y));
    }
    const double width = std::max(wide_y, 1e-12 * largest);
    entries_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        entries_.push_back(
            {static_cast<std::int64_t>(std::floor(boxes[i].min.y / width)), boxes[i].min.x, i});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.strip != b.strip ? a.strip < b.strip : a.min_x < b.min_x;
    });
    std::size_t other = 0;  // first entry of the next strip that may still be met
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        const Aabb& box = boxes[entry.box];
        const auto meet = [&](std::size_t j) {
            const std::uint32_t b = entries_[j].box;
            if (overlaps(box, boxes[b])) sets.unite(entry.box, b);
        };
        for (std::size_t j = i + 1;
             j < entries_.size() && entries_[j].strip == entry.strip && entries_[j].min_x <= box.max.x; ++j)
            meet(j);
        while (other < entries_.size() &&
               (entries_[other].strip <= entry.strip ||
                (entries_[other].strip == entry.strip + 1 && entries_[other].min_x < entry.min_x - wide_x)))
            ++other;
        for (std::size_t j = other;
             j < entries_.size() && entries_[j].strip == entry.strip + 1 && entries_[j].min_x <= box.max.x;
             ++j)
            meet(j);
    }
}

}  // namespace roboss
