// Sets to islands.
#include "schedule/islands.h"

#include <algorithm>

namespace roboss {

std::size_t Islands::largest() const {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < count(); ++i) largest = std::max(largest, size_of(i));
    return largest;
}

void collect_islands(UnionFind& sets, std::span<const RobotId> only, Islands& out) {
    // Robots come in ascending order, so the first of a set to come is the island's lowest.
    std::vector<std::uint32_t> robots;
    robots.reserve(only.size());
    for (const RobotId robot : only) robots.push_back(robot.value);
    sets.sort_by_set(robots);
    out.offsets.assign(1, 0), out.robots.clear();
    sets.for_each_set(robots, [&](std::span<const std::uint32_t> island) {
        for (const std::uint32_t robot : island) out.robots.emplace_back(robot);
        out.offsets.push_back(static_cast<std::uint32_t>(out.robots.size()));
    });
}

void collect_islands(UnionFind& sets, Islands& out) {
    std::vector<RobotId> all;
    all.reserve(sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i) all.emplace_back(i);
    collect_islands(sets, all, out);
}

}  // namespace roboss
