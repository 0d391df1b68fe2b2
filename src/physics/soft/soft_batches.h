// Arranges patches of contact points for sweeps in lanes: colour by colour, eight side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "physics/soft/soft_rows.h"

namespace roboss::soft {

/// The contact points of a pair of shapes that have one normal, and the bodies that they push.
struct Pair {
    int a = 0, b = -1;         // of Problem::velocity; b: -1 for scenery, and for a robot that touches itself
    std::uint32_t first = 0;   // contact
    std::uint32_t points = 0;  // at most eight
    bool swapped = false;      // a is side B of the contact, which scenery is side A of
    bool jointed = false;      // a or b is a robot with joints
    bool itself = false;       // two bodies of robot a
    std::uint32_t sides = 0;   // of a jointed one, in the solver's list
    int further_a = 0, further_b = 0;  // columns beyond six
    Vec3 middle;                       // of its points, where its friction acts, world axes

    int further() const { return further_a > further_b ? further_a : further_b; }
};

/// Greedy colouring in the order of the pairs: two bodies take the lowest colour that neither has. Pairs with
/// scenery come last: the k-th of a body takes the k-th colour there. So a pair's colour depends on earlier
/// pairs of its connected component alone, and whatever else is in the call leaves each body's order as it
/// is.
class Batches {
  public:
    /// Sets batches and colours of the problem, and makes room for their rows; order() has the pairs of batch
    /// after batch.
    void arrange(std::size_t bodies, std::span<const Pair> pairs, Problem& problem);
    /// Pairs in the order of their places: eight a batch but for the last of a colour.
    std::span<const std::uint32_t> order() const { return order_; }
    /// By batch: its first pair in order().
    std::span<const std::uint32_t> first_pairs() const { return first_pairs_; }

  private:
    std::uint32_t take_colour(const Pair& pair);
    void fill(std::size_t bodies, std::span<const Pair> pairs, Problem& problem);
    static void make_room(Problem& problem);

    std::vector<std::uint64_t> taken_;                // by body: the lowest 64 colours
    std::vector<std::uint32_t> further_, scenery_;    // by body: the first free one beyond, and of scenery
    std::vector<std::uint64_t> places_;               // colour, columns, points, pair
    std::vector<std::uint32_t> colours_;              // by place: the colour, and whether joints take part
    std::vector<std::uint32_t> order_, first_pairs_;  // by place; by batch
};

}  // namespace roboss::soft
