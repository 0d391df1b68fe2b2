// Which boxes meet: the first sieve of the broad phase.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.h"
#include "math/aabb.h"

namespace roboss {

class Meetings {
  public:
    /// Joins each of `wanted` with all whose boxes overlap its own, these with all that overlap theirs, and
    /// so on; perhaps others that overlap, too. Boxes must be finite numbers.
    void join(std::span<const Aabb> boxes, std::span<const std::uint32_t> wanted, UnionFind& sets);

  private:
    void join_by_strips(std::span<const Aabb> boxes, UnionFind& sets);

    struct Entry {
        std::int64_t strip = 0;  // along y, as wide as the widest box
        double min_x = 0;
        std::uint32_t box = 0;
    };
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> reached_;
    std::vector<char> is_reached_;
};

}  // namespace roboss
