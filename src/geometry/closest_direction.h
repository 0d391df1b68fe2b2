// The global part of the search for the deepest or closest direction: GJK while the shapes are apart, a
// polytope expanded from inside (EPA) when they overlap, then polishing. `Sum` is ConvexSum or GeneralSum,
// for closest_apart also SweptSum.
#pragma once

#include "geometry/convex_sum.h"
#include "geometry/general_sum.h"
#include "geometry/swept_sum.h"

namespace roboss::narrow {

/// The largest separation of the sum, found from any start. When it is above `enough`, any separation above
/// it is returned.
template <class Sum>
Separation closest_direction(const Sum& sum, const Separation& start, double enough);

struct ClosestApart {
    Separation best;       // the better of `start` and what was found
    bool overlap = false;  // the shapes overlap or nearly touch
    Vec3 first;            // the first shape's share of the sum's closest point, when they do not
};

/// Gilbert, Johnson and Keerthi, "A Fast Procedure for Computing the Distance between Complex Objects in
/// Three-Dimensional Space", 1988. The search ends early once it knows that the separation is at most
/// `too_little`.
template <class Sum>
ClosestApart closest_apart(const Sum& sum, const Separation& start, double enough, double too_little = 0);

/// After van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", 2001. The
/// polytope starts round the centre of the sum, so it needs no simplex from GJK, and works for a slight
/// separation too.
template <class Sum>
Separation closest_overlapping(const Sum& sum, const Separation& start);

}  // namespace roboss::narrow
