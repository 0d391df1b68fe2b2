// Where a ray first meets the surface of a shape, in closed form and in double: the distance that a laser
// reads depends on no tree, no triangle mesh and no instruction set.
#pragma once

#include "geometry/shape.h"

namespace roboss {

/// Distance in m from `origin_W` along the unit vector `direction_W` to the first crossing of the shape's
/// surface, from outside or from inside; +infinity: none.
double ray_distance(const Shape& shape, const Transform& X_WS, const Vec3& origin_W, const Vec3& direction_W);

}  // namespace roboss
