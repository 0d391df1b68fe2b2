// Free bodies that touch each other and scenery, as their solver keeps them (body_solver.h): six numbers a
// body, blocks of six by six, whose rows fit into one to three vector registers. Plain numbers, filled and
// ordered by code for every processor; body_kernel.h computes with them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/minimum_degree.h"
#include "core/team.h"
#include "physics/bodies/body_pairs.h"
#include "physics/bodies/factor_tasks.h"
#include "physics/bodies/six.h"

namespace roboss {

struct FreeBody {
    SixBlock mass;
    Six impulse;       // M v + dt (applied - bias)
    Six v, mv;         // velocity, M v
    Six gradient;      // mv - impulse - applied
    Six applied;       // impulses of all contacts
    Six step, m_step;  // of the velocity, M step
    Six lightness;     // 1 / M's diagonal
};

/// A contact point. `n`, `t1`, `t2`: normal, tangents. Friction velocities are relative to their targets.
struct BodyPoint {
    Six n_a, t1_a, t2_a, n_b, t1_b, t2_b;  // Jacobian: of body a, of body b
    int a = 0, b = -1;                     // b: -1 for scenery
    int edge = -1;                         // of the two bodies, in the factor
    bool b_first = false;                  // b is eliminated before a
    bool sticks = false;                   // it probably will: ContactRow::sticks
    double target_n = 0, target_1 = 0, target_2 = 0;
    double stiffness_n = 0, stiffness_t = 0, coefficient = 0, bound = 0;
    double u_n = 0, u_1 = 0, u_2 = 0, du_n = 0, du_1 = 0, du_2 = 0;
    double f_n = 0, f_1 = 0, f_2 = 0;                          // impulses
    double d_n = 0, d_11 = 0, d_12 = 0, d_22 = 0;              // minus their derivatives by the velocity
    double d_1n = 0, d_2n = 0;                                 // of friction by the normal velocity
    double held_n = 0, held_11 = 0, held_12 = 0, held_22 = 0;  // what the matrix holds
    double bound_error = 0, relaxation = 1;                    // FrictionDisc::bound_error
    double swept_n = 0, swept_1 = 0, swept_2 = 0;              // impulses that sweeps found
};

/// Order of elimination and places of all blocks of the factor. Edges join a body to those that are
/// eliminated after it and are coupled to it by then; they are numbered body by body, as eliminated.
class BodyOrder {
  public:
    /// Orders by minimum degree, and gives the points their edges.
    void analyse(std::size_t bodies, std::vector<BodyPoint>& points);

    struct Pivot {
        int body = 0;
        std::size_t first = 0, last = 0;  // edges
        std::size_t updates = 0;          // where its updates begin
    };
    const std::vector<Pivot>& pivots() const { return pivots_; }
    /// The other body of an edge.
    const std::vector<int>& ends() const { return elimination_.ends(); }
    /// For each pivot, each pair of its edges (i < j): the edge that joins their ends, and whether the end of
    /// j is eliminated before that of i.
    struct Update {
        int edge = 0;
        bool j_first = false;
    };
    const std::vector<Update>& updates() const { return updates_; }
    std::size_t edges() const { return elimination_.ends().size(); }
    /// Number of the pivot that eliminates a body.
    std::size_t position(int body) const {
        return static_cast<std::size_t>(elimination_.position()[static_cast<std::size_t>(body)]);
    }

  private:
    bool goes_first(int a, int b) const;
    int edge_of(int a, int b) const;

    MinimumDegree elimination_;
    std::vector<Pivot> pivots_;
    std::vector<Update> updates_;
};

/// By body: the points that it has a share in, in their order. So each body can sum up by itself what its
/// points do, with the bits of a sum point by point.
struct PointEnds {
    struct End {
        std::uint32_t point = 0;
        bool is_b = false;
    };
    std::vector<End> ends;
    std::vector<std::uint32_t> first;  // by body, and the end

    void sort(std::size_t bodies, const std::vector<BodyPoint>& points);
    /// act(point, is_b)
    template <class Act>
    void for_each(std::size_t body, const Act& act) const {
        for (std::uint32_t k = first[body]; k < first[body + 1]; ++k) act(ends[k].point, ends[k].is_b);
    }
};

struct BodyIsland {
    std::vector<FreeBody> bodies;
    std::vector<BodyPoint> points;
    BodyOrder order;
    Team team;  // shares loops and the factor; of one thread if they are not worth it
    // For a team:
    PointEnds ends;
    FactorTasks tasks;
    std::vector<Six> body_terms;      // of sums over bodies: two of each
    std::vector<double> point_terms;  // of sums over points

    /// act(body) for all bodies, by the threads of the team; likewise act(point).
    template <class Act>
    void for_bodies(const Act& act) const {
        constexpr std::size_t kBlock = 64;
        team.run_blocks(bodies.size(), kBlock, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) act(b);
        });
    }
    template <class Act>
    void for_points(const Act& act) const {
        constexpr std::size_t kBlock = 128;
        team.run_blocks(points.size(), kBlock, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) act(k);
        });
    }
    bool symmetric = true;                            // the matrix factored last
    std::vector<SixBlock> kept_diagonal, kept_upper;  // the symmetric matrix, by body and by edge
    std::vector<SixBlock> diagonal, upper, lower;     // its factor; `lower` transposed
    struct PivotFactor {
        double l[6][6] = {}, inverse[6] = {};
    };
    std::vector<PivotFactor> pivot_factors;  // by body

    // Sweeps.
    bool bounds_stay = false;  // of friction; else they follow the normal impulses
    PairBatches pairs;
    std::vector<PointSlot> slots;
    std::vector<SixBlock> whitening;  // by body: L^-1 of its mass matrix L L^T, column by column
    std::vector<SixFloats> swept;     // by body, and two that never move: y of body_pairs.h
    std::vector<SixFloats> swept_before, swept_direction;  // before the last sweep; search direction
    std::vector<Eight> slot_terms;                         // for a team: of the squared change, by slot
};

}  // namespace roboss
