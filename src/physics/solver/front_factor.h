// Sparse factorisation by fronts (Duff and Reid 1983; Davis, Direct Methods for Sparse Linear
// Systems, 2006) for contact islands of several robots. The unknowns of one robot are a group; groups are
// eliminated in the order of minimum degree; each front is a small dense matrix of the group's unknowns and
// of those of later groups that they are coupled to. A car in the middle of a pile costs what its neighbours
// cost, not the pile. All in a fixed order of operations that depends on the island alone.
//
// Rows of a front begin at even places and are taken two entries at a time, also where this reaches over the
// diagonal: what lies below it is not read (or, unsymmetric, no longer). Their last column is the right hand
// side, so that eliminating solves forward too.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/minimum_degree.h"
#include "model/dof_paths.h"

namespace roboss {

class FrontFactor {
  public:
    /// Unknowns that a row couples: [first, last) of the list handed to analyse.
    struct Clique {
        std::size_t first = 0, last = 0;
        bool operator==(const Clique&) const = default;
    };

    /// Unknowns of a clique that stand side by side in its front, in both orders.
    struct Run {
        std::size_t first = 0;  // in the clique
        std::size_t place = 0;  // in the front
        std::size_t count = 0;
    };

    /// Where the entries of a clique go: matrix[local[i] * stride + local[j]], or run by run; runs ascend in
    /// the front.
    struct Place {
        double* matrix = nullptr;
        std::size_t stride = 0;
        const int* local = nullptr;
        std::span<const Run> runs;
    };

    /// Group g holds the unknowns group_first[g] .. group_first[g + 1] - 1, of which the first heads[g] are
    /// coupled to all of it, as those of a free base are. A clique touches at most two groups. Costs nothing
    /// where the question is that of the last call.
    void analyse(std::span<const int> group_first, std::span<const int> heads, std::span<const int> unknowns,
                 std::span<const Clique> cliques);
    /// Whether analyse() was last asked this.
    bool knows(std::span<const int> group_first, std::span<const int> heads, std::span<const int> unknowns,
               std::span<const Clique> cliques) const;

    /// All entries to zero.
    void clear();
    /// The symmetric matrix, kept from one factorisation to the next: its entries with local[i] <= local[j]
    /// count.
    Place place(std::size_t clique);
    /// Adds to the diagonal, or a group's matrix, packed by paths.
    void add(std::size_t group, int unknown, double value);
    void add(std::size_t group, const DofPaths& paths, std::span<const double> matrix);
    /// Copies the matrix for the next factorisation; an unsymmetric one takes further entries, of all i and
    /// j.
    void begin_factor(bool symmetric);
    Place unsymmetric_place(std::size_t clique);
    /// x := A^-1 x, once after begin_factor: by A = L D L^T, or A = L U without pivoting if it is not
    /// symmetric. False if a pivot of that is zero.
    bool solve(std::span<double> x);

  private:
    static constexpr std::size_t kSmall = 64;

    struct Front {
        std::size_t own = 0, size = 0;  // unknowns eliminated here, unknowns of the front
        std::size_t index_at = 0;       // of the front's unknowns in index_
        std::size_t stride = 0;         // of its rows: unknowns, right hand side, even
        std::size_t matrix_at = 0;      // size rows, upper triangle
        std::size_t update_at = 0;      // in to_parent_: where its boundary lies in the parent's front
        int parent = -1, first_child = -1, sibling = -1;
    };

    void order_groups(std::span<const int> unknowns, std::span<const Clique> cliques);
    void order_small();
    void order_large();
    void take_group(std::size_t group);
    void rank_unknowns();
    void assign_cliques(std::span<const int> unknowns, std::span<const Clique> cliques);
    void gather_front(std::size_t group, std::span<const int> unknowns, std::span<const Clique> cliques);
    void map_to_parents();
    void localise(std::span<const int> unknowns, std::span<const Clique> cliques);
    void find_runs(const Clique& clique);
    std::size_t own_place(std::size_t group, int unknown) const;
    Place place_in(std::vector<double>& matrices, std::size_t clique) const;
    void add_to_parent(const Front& front);
    void eliminate(const Front& front);
    bool eliminate_general(const Front& front);
    void solve_back(const Front& front, std::span<double> x);

    std::size_t groups_ = 0;
    bool symmetric_ = true;
    std::vector<int> group_first_, heads_, group_of_;  // of the groups, twice; of the unknowns
    std::vector<int> unknowns_;                        // as analysed
    std::vector<Clique> cliques_;                      // likewise
    std::vector<std::pair<int, int>> links_;           // groups that a clique couples
    MinimumDegree large_;                              // order of many groups
    std::vector<int> order_, position_;                // groups as eliminated; and back
    std::vector<int> rank_;                            // of the unknowns: when they are eliminated
    std::vector<int> clique_front_;                    // group of each clique
    std::vector<std::size_t> clique_start_, cliques_by_front_, clique_first_;
    std::vector<Front> fronts_;  // by group
    std::vector<int> index_, to_parent_, local_, mark_, where_;
    std::vector<Run> runs_;               // of all cliques
    std::vector<std::size_t> run_first_;  // of each clique, and the end
    std::vector<double> a_, kept_;        // to factor; the symmetric matrix, its upper triangles
    std::vector<double> x_;               // the solution in one front
};

}  // namespace roboss
