// The matrix of Newton's method, M + J^T D J with D the rows' curvatures, and its factorisation: on the tree
// of a single robot without fill-in; by fronts where rows couple several robots, or branches of one.
#pragma once

#include <span>
#include <vector>

#include "physics/front_factor.h"
#include "physics/rows.h"

namespace roboss {

class Hessian {
  public:
    /// Chooses the form and, for fronts, the order of elimination; `offsets`: first dof of each robot.
    void start(std::span<const RobotWork* const> robots, std::span<const int> offsets, const IslandRows& rows,
               std::size_t n);
    /// Takes the rows' curvatures `d`; with `coupled` also those of friction bounds that move with the normal
    /// impulse, which make the matrix unsymmetric.
    void assemble(const IslandRows& rows, bool coupled);
    /// x := H^-1 x; the matrix is lost. False if an unsymmetric matrix has no factorisation without pivoting.
    bool solve(std::span<double> x);

  private:
    void start_fronts(const IslandRows& rows);
    void add_mass();
    void add_block(const IslandRows& rows, std::size_t first, std::size_t last, std::size_t clique,
                   const BoundedRow& normal, const FrictionDisc& disc);
    void add_to_tree(std::span<const ContactColumn> columns, const BoundedRow& normal,
                     const FrictionDisc& disc);
    void add_to_front(std::span<const ContactColumn> columns, const FrontFactor::Place& place,
                      const BoundedRow& normal, const FrictionDisc& disc);
    void add_coupling(const IslandRows& rows, const CouplingRow& row, std::size_t clique);

    std::span<const RobotWork* const> robots_;
    std::span<const int> offsets_;
    std::size_t n_ = 0;
    bool tree_ = false, coupled_ = false;
    std::vector<double> h_, upper_;  // tree: n x n, lower triangle; coupled: upper triangle, transposed
    FrontFactor fronts_;
    std::vector<int> group_first_, unknowns_;
    std::vector<FrontFactor::Clique> cliques_;  // of contacts, angulars, couplings, in this order
};

}  // namespace roboss
