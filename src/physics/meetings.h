// Which boxes meet another one: the first sieve of the broad phase.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/aabb.h"

namespace roboss {

class Meetings {
  public:
    /// Sets meets[i] to 1 for each of `wanted` whose box overlaps any other, and for that other; the rest of
    /// `meets` stays. Boxes must be finite numbers.
    void mark(std::span<const Aabb> boxes, std::span<const std::uint32_t> wanted, std::span<char> meets);

  private:
    void mark_by_strips(std::span<const Aabb> boxes, std::span<char> meets);

    struct Entry {
        std::int64_t strip = 0;  // along y, as wide as the widest box
        double min_x = 0;
        std::uint32_t box = 0;
    };
    std::vector<Entry> entries_;
};

}  // namespace roboss
