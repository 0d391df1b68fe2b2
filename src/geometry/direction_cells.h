// The vertices of a convex body by direction: which of them can be the furthest one along a direction, for
// each cell of a grid on the six sides of a cube round the origin. Looking at the few vertices of one cell
// gives what looking at all of them gives, ties included, so the result depends on the direction alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"

namespace roboss {

/// The lowest number of those with the largest dot(d, vertex).
std::uint32_t furthest_of_all(const Vec3& d, std::span<const Vec3> vertices);

class DirectionCells {
  public:
    /// Of few vertices no table is made, nor of more than 65536: all are looked at.
    void build(std::span<const Vec3> vertices);
    bool empty() const { return first_.empty(); }

    /// furthest_of_all(d, vertices), to the last bit; `vertices`: those it was built of.
    std::uint32_t furthest(const Vec3& d, std::span<const Vec3> vertices) const;

    /// Vertices to look at in all cells together, and the number of cells: for tests.
    std::size_t entries() const { return numbers_.size(); }
    std::size_t cells() const { return first_.empty() ? 0 : first_.size() - 1; }

  private:
    std::size_t cell_of(const Vec3& d, const Vec3& sizes) const;

    std::size_t along_ = 0;               // cells along an edge of the cube
    std::vector<std::uint32_t> first_;    // by cell: of `numbers_`
    std::vector<std::uint16_t> numbers_;  // of vertices, ascending within a cell, in blocks
};

}  // namespace roboss
