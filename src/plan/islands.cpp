// Sets to islands by counting: O(n), no sorting.
#include "plan/islands.h"

#include <algorithm>
#include <numeric>

namespace roboss {

std::size_t Islands::largest() const {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < count(); ++i) largest = std::max(largest, size_of(i));
    return largest;
}

void collect_islands(UnionFind& sets, std::span<const RobotId> only, Islands& out) {
    // Robots come in ascending order, so the first of a set to come opens its island and islands ascend by
    // root.
    std::vector<std::uint32_t> island_of(sets.size(), RobotId::kNone), number(only.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < only.size(); ++i) {
        std::uint32_t& island = island_of[sets.find(only[i].value)];
        if (island == RobotId::kNone) island = count++;
        number[i] = island;
    }
    out.offsets.assign(count + 1, 0);
    for (const std::uint32_t n : number) ++out.offsets[n + 1];
    std::partial_sum(out.offsets.begin(), out.offsets.end(), out.offsets.begin());
    std::vector<std::uint32_t> next(out.offsets.begin(), out.offsets.end() - 1);
    out.robots.resize(only.size());
    for (std::size_t i = 0; i < only.size(); ++i) out.robots[next[number[i]]++] = only[i];
}

void collect_islands(UnionFind& sets, Islands& out) {
    std::vector<RobotId> all;
    all.reserve(sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i) all.emplace_back(i);
    collect_islands(sets, all, out);
}

}  // namespace roboss
