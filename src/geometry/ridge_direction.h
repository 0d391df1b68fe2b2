// The direction in which a convex body is furthest from a triangle that it overhangs: across one of the
// triangle's edges, between its normal and that of the neighbour. One angle is searched, where the general
// search (closest_direction.h) looks in all directions.
#pragma once

#include "geometry/convex_body.h"
#include "geometry/convex_sum.h"
#include "geometry/triangle_surface.h"

namespace roboss::narrow {

constexpr double kRidgeFold = -1e-6;  // fold below which an edge sticks out

enum class Across {
    kApart,  // by more than is enough
    kRidge,  // `best` is between the normals of a ridge, and the body touches there between the edge's ends
    kNeighbour,  // the body touches a neighbour instead: the triangle itself holds it in no direction of its
                 // own
    kUnknown     // at a corner, beside a border
};

struct RidgeDirection {
    Across across = Across::kUnknown;
    Separation best;
};

/// `body` is above the plane of the triangle, and its lowest point is not over it. `enough`: a separation of
/// the cores.
RidgeDirection ridge_direction(const ConvexBody& body, const SurfaceTriangle& triangle, double enough);

}  // namespace roboss::narrow
