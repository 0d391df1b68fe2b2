// Sweep and prune (Baraff 1992; Cohen et al. 1995): all overlapping pairs among many boxes. Boxes are cut
// into strips along y and each strip is swept along x, so that a wide crowd costs O(n log n) too. A robot may
// own several boxes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/box32.h"
#include "schedule/islands.h"

namespace roboss {

struct OwnedBox {
    Box32 box;
    std::uint32_t owner = 0;
};

class Sweep {
  public:
    /// Unites in `sets` the owners of every two overlapping boxes. Returns how many unions were new.
    std::size_t unite_overlapping(std::span<const OwnedBox> boxes, UnionFind& sets);

  private:
    struct Strips {
        double origin = 0, height = 1;
        std::uint32_t count = 1;
        std::uint32_t of(float y) const;
    };
    static Strips cut(std::span<const OwnedBox> boxes);
    void fill(std::span<const OwnedBox> boxes, const Strips& strips);
    /// A box in a strip.
    struct Entry {
        float left = 0;
        std::uint32_t box = 0;
    };
    std::size_t sweep(std::span<const OwnedBox> boxes, std::span<Entry> strip, UnionFind& sets);

    std::vector<std::uint32_t> offsets_;  // strip -> its entries_
    std::vector<Entry> entries_;
    std::vector<OwnedBox> sorted_;  // boxes of a strip, one behind the other
};

}  // namespace roboss
