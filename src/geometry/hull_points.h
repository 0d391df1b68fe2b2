// Points that build_hull can work with, for meshes that have none: flat ones, and those with too many
// corners.
#pragma once

#include <span>
#include <vector>

#include "math/vec3.h"

namespace roboss {

/// The points, those of a flat, straight or single point set each twice or more, so that the set is nowhere
/// thinner than `thickness`. As they are where they are thick enough.
std::vector<Vec3> thickened(std::span<const Vec3> points, double thickness);

/// Of the points those that lie furthest along one of about 1500 directions spread over the sphere. Their
/// hull lacks at most a few thousandths of the radius of the whole hull.
std::vector<Vec3> extreme_points(std::span<const Vec3> points);

}  // namespace roboss
