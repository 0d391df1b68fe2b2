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
    /// Chooses the form and, for fronts, the order of elimination; `offsets`: first dof of each robot. The
    /// rows' curvatures are not in yet.
    void start(std::span<const RobotWork* const> robots, std::span<const int> offsets, IslandRows& rows,
               std::size_t n);
    /// Takes the rows' curvatures, as far as they changed; with `coupled` also those of friction bounds that
    /// move with the normal impulse, which make the matrix unsymmetric.
    void assemble(IslandRows& rows, bool coupled);
    /// x := H^-1 x, once after assemble. False if an unsymmetric matrix has no factorisation without
    /// pivoting.
    bool solve(std::span<double> x);

  private:
    void start_fronts(IslandRows& rows);
    void sort_columns(IslandRows& rows);
    void add_mass();
    void add_changes(IslandRows& rows);
    void add_block(const ContactColumns& columns, std::size_t first, std::size_t last, std::size_t clique,
                   BoundedRow& normal, FrictionDisc& disc);
    void add_coupling(const IslandRows& rows, CouplingRow& row, std::size_t clique);
    void add_slides(const IslandRows& rows);
    void add_slide(const ContactColumns& columns, const ContactRow& row, std::size_t a, double slide);

    std::span<const RobotWork* const> robots_;
    std::span<const int> offsets_;
    std::size_t n_ = 0;
    bool tree_ = false, coupled_ = false;
    // tree: packed by paths, lower triangle; to factor; coupled: upper triangle, transposed
    std::vector<double> kept_, h_, upper_;
    FrontFactor fronts_;
    std::vector<int> group_first_, unknowns_;
    std::vector<FrontFactor::Clique> cliques_;  // of contacts, angulars, couplings, in this order
};

}  // namespace roboss
