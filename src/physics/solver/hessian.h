// The matrix of Newton's method for any contact island: on the tree of a single robot without fill-in
// (tree_hessian.h); by fronts where rows couple several robots, or branches of one; body by body where robots
// have many loops (net_hessian.h).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "physics/solver/front_factor.h"
#include "physics/solver/net_hessian.h"
#include "physics/solver/tree_hessian.h"

namespace roboss {

class Hessian {
  public:
    /// Whose threads may share the work.
    void share_with(const Team& team) { team_ = team; }
    /// Chooses the form and, for fronts, the order of elimination; `offsets`: first dof of each robot. The
    /// rows' curvatures are not in yet.
    void start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
               IslandRows& rows, std::size_t n);
    /// Whether it does unsymmetric matrices.
    bool couples() const { return form_ != Form::kNet; }
    /// Takes the rows' curvatures, as far as they changed; with `coupled` also those of friction bounds that
    /// move with the normal impulse, which make the matrix unsymmetric. Of the curvature of friction that
    /// only turned a little, it may lack the share `lack`.
    void assemble(IslandRows& rows, bool coupled, double lack);
    /// x := H^-1 x, once after assemble. False if an unsymmetric matrix has no factorisation without
    /// pivoting.
    bool solve(std::vector<double>& x);

  private:
    void start_fronts(const IslandRows& rows);
    void choose_fronts();
    bool is_last_clique(std::size_t begin) const;
    void add_mass();
    void add_changes(IslandRows& rows, double lack);
    void add_block(const ContactColumns& columns, std::size_t first, std::size_t clique,
                   const CurvatureChange<double>& d);
    void add_coupling(const IslandRows& rows, CouplingRow& row, std::size_t clique);
    void add_slides(const IslandRows& rows);

    std::span<const Mechanics<double>* const> robots_;
    std::span<const int> offsets_;
    std::size_t n_ = 0;
    enum class Form : char { kTree, kFronts, kNet } form_ = Form::kTree;
    TreeHessian<double> tree_;
    NetHessian net_;
    Team team_;
    FrontFactor& fronts() { return fronts_[kept_]; }
    // Small parts come again, tick by tick, so a few analyses are kept; large ones have the first.
    static constexpr std::size_t kKept = 8, kSmall = 64;  // fronts, unknowns
    std::array<FrontFactor, kKept> fronts_;
    std::size_t kept_ = 0, oldest_ = 1;
    std::vector<int> group_first_, heads_, unknowns_;
    std::vector<FrontFactor::Clique> cliques_;
    std::vector<std::size_t> clique_of_;  // contacts, angulars, couplings, in this order
};

}  // namespace roboss
