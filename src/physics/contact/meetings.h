// Which boxes meet: the first sieve of the broad phase.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.h"
#include "math/aabb.h"
#include "physics/contact/box_strips.h"

namespace roboss {

class Meetings {
  public:
    /// Joins each of `wanted` with all whose boxes overlap its own, these with all that overlap theirs, and
    /// so on; perhaps others that overlap, too. Boxes must be finite numbers.
    void join(std::span<const Aabb> boxes, std::span<const std::uint32_t> wanted, UnionFind& sets);

  private:
    BoxStrips strips_;
    std::vector<std::uint32_t> reached_;
    std::vector<char> is_reached_;
};

}  // namespace roboss
