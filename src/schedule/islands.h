// Islands: a partition of the robots. Canonical: an island's root is its lowest robot, islands ascend by
// root, robots ascend within an island; so the partition is the same however it was found.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.h"
#include "core/union_find.h"

namespace roboss {

/// Island i is robots[offsets[i] .. offsets[i + 1]).
struct Islands {
    std::vector<std::uint32_t> offsets{0};
    std::vector<RobotId> robots;

    std::size_t count() const { return offsets.size() - 1; }
    std::size_t size_of(std::size_t island) const { return offsets[island + 1] - offsets[island]; }
    std::span<const RobotId> of(std::size_t island) const {
        return std::span(robots).subspan(offsets[island], size_of(island));
    }
    std::size_t largest() const;
};

/// The sets of `sets` as islands. With `only` (ascending), just the sets that hold these robots, restricted
/// to them.
void collect_islands(UnionFind& sets, Islands& out);
void collect_islands(UnionFind& sets, std::span<const RobotId> only, Islands& out);

}  // namespace roboss
