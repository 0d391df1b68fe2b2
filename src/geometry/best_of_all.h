// Proofs that no direction separates two shapes better than one that was found, which save a search of all
// directions. With the direction n, the points that touch once the first shape has been moved by the gap
// along n show where the sum (convex_sum.h) has its boundary point p along n.
//
// Apart: the two points are a pair at that distance. Overlapping by d: no direction is better if the sum
// holds the ball of radius d round its centre, which touches the boundary at p. Two kinds of features hold
// it:
// - a flat facet: the sum holds a disc round p in the plane across n, and the mirror image of that disc;
// - a line across n and a disc: what the disc sweeps along the line is an oblique cylinder.
#pragma once

#include "geometry/convex_sum.h"

namespace roboss::narrow {

/// Whether the sum holds that ball because its facet along best.n holds a disc of radius `clearance` round p.
bool holds_ball(const ConvexSum& sum, const Separation& best, double clearance);

/// Whether the lines or points of the two shapes furthest along best.n prove it to be the best of all.
bool is_best_of_all(const Posed& a, const Posed& b, const ConvexSum& sum, const Separation& best);

}  // namespace roboss::narrow
