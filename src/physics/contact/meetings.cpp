// See meetings.h.
#include "physics/contact/meetings.h"

#include <utility>

namespace roboss {

void Meetings::join(std::span<const Aabb> boxes, std::span<const std::uint32_t> wanted, UnionFind& sets) {
    constexpr std::size_t kFew = 12;  // each against all is quicker than sorting
    reached_.assign(wanted.begin(), wanted.end());
    is_reached_.assign(boxes.size(), 0);
    for (const std::uint32_t i : wanted) is_reached_[i] = 1;
    for (std::size_t k = 0; k < reached_.size(); ++k) {
        if (reached_.size() > kFew)
            return strips_.for_each_overlap(boxes,
                                            [&](std::uint32_t i, std::uint32_t j) { sets.unite(i, j); });
        const std::uint32_t i = reached_[k];
        for (std::uint32_t j = 0; j < boxes.size(); ++j) {
            if (j == i || !overlaps(boxes[i], boxes[j])) continue;
            sets.unite(i, j);
            if (!std::exchange(is_reached_[j], 1)) reached_.push_back(j);
        }
    }
}

}  // namespace roboss
