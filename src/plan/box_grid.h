// BoxGrid: which boxes overlap, found as they come one by one, so that little is left to do when the last has
// come. Boxes lie in the cells of a hashed grid over x and y (Teschner et al. 2003). A crowd in which all lie
// on each other is no work for it; it says so, and a Sweep over all boxes does better.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/sweep.h"

namespace roboss {

class BoxGrid {
  public:
    /// Takes all boxes out. The cells will suit boxes like these.
    void reset(std::span<const OwnedBox> like);
    /// Unites in `sets` the owners of this box and of each box here that overlaps it. Returns how many unions
    /// were new.
    std::size_t add(const OwnedBox& box, UnionFind& sets);
    /// Gave up: not all that overlap were united.
    bool overwhelmed() const { return overwhelmed_; }

  private:
    struct Cells;  // that a box lies in
    struct Link {
        std::uint32_t box = 0, next = 0;
    };
    std::uint32_t& first_in(std::int32_t x, std::int32_t y);
    bool meets(const OwnedBox& box, std::uint32_t other, UnionFind& sets);

    float cells_per_m_ = 0;
    std::vector<std::uint32_t> first_;  // by hash of the cell: its last link, or 0
    std::vector<Link> links_;           // the first one is none
    std::vector<OwnedBox> boxes_;
    std::vector<std::uint32_t> large_;  // boxes in too many cells; compared with all
    std::size_t tests_left_ = 0;
    bool overwhelmed_ = false;
    std::vector<float> sizes_;
};

}  // namespace roboss
