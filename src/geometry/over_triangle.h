// The part of a convex body that is over a triangle, and the directions in which a body and a triangle are
// furthest apart that need no search: the face's own normal where the body's lowest point is over the face,
// and that from a corner to the closest point of the body where the triangle is below the plane across it.
#pragma once

#include <optional>

#include "geometry/clip_feature.h"
#include "geometry/convex_sum.h"
#include "geometry/triangle_surface.h"

namespace roboss::narrow {

constexpr std::uint32_t kTriangleFace = 6;  // a triangle's part: inside it
constexpr double kShallow = 0.05;           // of the body's size: deeper, a face may not be the way out
constexpr double kLowest = 1e-6;            // of the body's size, above its lowest point

/// The part over the face of the body's feature that is furthest down.
ClippedFeature points_over(const ConvexBody& body, const std::array<Vec3, 3>& corners, const Vec3& n);

/// The separation of the cores, where a corner of the triangle is what is closest to the body.
std::optional<Separation> corner_separation(const ConvexBody& body, const std::array<Vec3, 3>& corners);

/// The separation of the cores, where its direction is known without a search: of balls, of bodies whose
/// lowest point is over the face or closest to a corner, and of those further above the plane than `enough`.
std::optional<Separation> plain_separation(const ConvexBody& body, const SurfaceFace& face, double enough);

}  // namespace roboss::narrow
