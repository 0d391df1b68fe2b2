// BoxGrid: finds overlapping boxes as they arrive one by one, so that little is left to do after the last
// one. Boxes lie in the cells of a hashed grid over x and y (Teschner et al. 2003). It gives up on crowds in
// which most boxes overlap; a Sweep over all boxes is faster there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "schedule/sweep.h"

namespace roboss {

class BoxGrid {
  public:
    /// Removes all boxes and chooses the cell size for boxes like these.
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
