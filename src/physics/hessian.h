// The matrix of Newton's method for any contact island: on the tree of a single robot without fill-in
// (tree_hessian.h); by fronts where rows couple several robots, or branches of one.
#pragma once

#include <span>
#include <vector>

#include "physics/front_factor.h"
#include "physics/tree_hessian.h"

namespace roboss {

class Hessian {
  public:
    /// Chooses the form and, for fronts, the order of elimination; `offsets`: first dof of each robot. The
    /// rows' curvatures are not in yet.
    void start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
               IslandRows& rows, std::size_t n);
    /// Takes the rows' curvatures, as far as they changed; with `coupled` also those of friction bounds that
    /// move with the normal impulse, which make the matrix unsymmetric.
    void assemble(IslandRows& rows, bool coupled);
    /// x := H^-1 x, once after assemble. False if an unsymmetric matrix has no factorisation without
    /// pivoting.
    bool solve(std::vector<double>& x);

  private:
    void start_fronts(IslandRows& rows);
    void sort_columns(IslandRows& rows);
    void add_mass();
    void add_changes(IslandRows& rows);
    void add_block(const ContactColumns& columns, std::size_t first, std::size_t last, std::size_t clique,
                   BoundedRow& normal, FrictionDisc& disc);
    void add_coupling(const IslandRows& rows, CouplingRow& row, std::size_t clique);
    void add_slides(const IslandRows& rows);

    std::span<const Mechanics<double>* const> robots_;
    std::span<const int> offsets_;
    std::size_t n_ = 0;
    bool is_tree_ = false;
    TreeHessian<double> tree_;
    FrontFactor fronts_;
    std::vector<int> group_first_, unknowns_;
    std::vector<FrontFactor::Clique> cliques_;  // of contacts, angulars, couplings, in this order
};

}  // namespace roboss
