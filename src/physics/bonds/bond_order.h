// An order for the robots of bonds in which bonded robots stand near each other, so that the factor of
// J M^-1 J^T stays narrow (Cuthill and McKee 1969).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/bonds/bond_rows.h"

namespace roboss {

class BondOrder {
  public:
    /// Breadth first from a robot of few bonds; the robots are 0 to `robots` - 1 in `bonds`.
    void find(std::span<const HeldBond> bonds, std::size_t robots);
    /// Place of a robot in the order.
    std::size_t operator[](std::size_t robot) const { return place_[robot]; }

  private:
    void gather_neighbours(std::span<const HeldBond> bonds, std::size_t robots);

    std::vector<std::size_t> place_, first_, neighbours_, queue_, by_degree_;
};

}  // namespace roboss
