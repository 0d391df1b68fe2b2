// The contact points of free bodies, arranged for Gauss-Seidel sweeps in lanes (lanes/lane_pair_sweeps.h):
// pairs that share no body go side by side, eight at a time, and point after point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/bodies/six.h"

namespace roboss {

struct BodyPoint;
struct BodyIsland;

/// Numbers of eight pairs.
struct alignas(32) Eight {
    float x[8] = {};
};

/// One contact point of each of eight pairs; where a pair has none, all is zero. Jacobians are those of the
/// velocities y = L^T (v - v0), with L L^T the mass matrix and v0 where the solve starts: what an impulse f
/// does to y is J^T f. Targets are relative to v0, too. So single precision serves: it rounds changes only.
struct PointSlot {
    Eight n_a[6], t1_a[6], t2_a[6], n_b[6], t1_b[6], t2_b[6];
    Eight target_n, target_1, target_2;
    Eight compliance, slip;                // of the normal, of friction
    Eight bound, coefficient;              // of friction: bound + coefficient * normal impulse
    Eight mass_n, mass_t;                  // effective, compliance included
    Eight inverse_mass_n, inverse_mass_t;  // 1 / the same
    Eight n_on_1, n_on_2;                  // tangential velocity by a normal impulse
    Eight impulse_n, impulse_1, impulse_2;
    Eight change_n, change_1, change_2;           // by the last sweep
    Eight direction_n, direction_1, direction_2;  // search direction of the acceleration
};

/// Eight pairs of bodies or fewer. `b` of a pair with scenery, and both of an unused lane, are a body that
/// never moves: its index is the number of bodies, or one more if the batch is of scenery. So batches of one
/// colour share no body.
struct PairBatch {
    int a[8] = {}, b[8] = {};
    int pairs = 0;
    bool scenery = false;             // so are all or none
    std::size_t first = 0, last = 0;  // slots
};

/// Greedy graph colouring in the order of the pairs: each gets the lowest colour that neither body has; if
/// the two have all of the first 64, the first one after every further colour that either has. Within a
/// colour come pairs of two bodies, then pairs with scenery; in each group those with more points first.
class PairBatches {
  public:
    /// Neighbours in `points` that join the same bodies are one pair.
    void arrange(std::size_t bodies, const std::vector<BodyPoint>& points);

    const std::vector<PairBatch>& batches() const { return batches_; }
    /// First batch of each colour, and the end.
    const std::vector<std::size_t>& colours() const { return colours_; }
    /// The batches of each colour by their first bodies, for a team: who sweeps the pairs of a body in one
    /// colour mostly does so in the others. After sort_by_bodies().
    const std::vector<std::uint32_t>& by_bodies() const { return by_bodies_; }
    void sort_by_bodies();
    std::size_t slots() const { return batches_.empty() ? 0 : batches_.back().last; }
    /// Where a point is: slot * 8 + lane.
    std::size_t place_of(std::size_t point) const { return places_[point]; }

  private:
    struct Pair {
        std::uint32_t colour = 0;
        bool scenery = false;
        std::uint32_t first = 0, points = 0;  // in `points`
    };
    std::uint32_t take_colour(int a, int b);
    void fill_batches(const std::vector<BodyPoint>& points, int bodies);

    std::vector<Pair> pairs_;
    std::vector<PairBatch> batches_;
    std::vector<std::size_t> colours_;
    std::vector<std::uint32_t> by_bodies_;
    std::vector<std::size_t> places_;
    std::vector<std::uint64_t> taken_;    // by body: the lowest 64 colours
    std::vector<std::uint32_t> further_;  // by body: the first free one beyond
};

/// Arranges the island's pairs and makes room for its sweeps. Not inlined into the code for one processor.
void make_room_for_sweeps(BodyIsland& island);

}  // namespace roboss
