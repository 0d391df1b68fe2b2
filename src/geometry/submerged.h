// How much of a solid shape lies below a horizontal plane, and where: what floats in layers of fluid. Closed
// forms, in any attitude.
#pragma once

#include "geometry/shape.h"

namespace roboss {

struct Submerged {
    double volume = 0;  // m^3
    Vec3 moment;        // m^4, world axes: volume times the place of its centre from the shape's origin
};

/// Volume of the whole shape, whose centre is the shape's origin; 0 for planes and surfaces.
double solid_volume(const Shape& shape);

/// The part of the shape at X_WS with z < height in the world.
Submerged submerged_part(const Shape& shape, const Transform& X_WS, double height);

}  // namespace roboss
