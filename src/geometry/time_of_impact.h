// When two moving shapes meet within a tick, by conservative advancement (Mirtich, Impulse-based Dynamic
// Simulation of Rigid Body Systems, 1996, section 2.3): along the normal n of the closest points two convex
// shapes come nearer by at most
//     closing = -n . (velocity of centre A - velocity of centre B) + turning A + turning B + bend / 2 * rest
// a second, `bend` being the accelerations of the centres and `rest` the rest of the tick. So after gap /
// closing seconds they are still apart. The plane through the closest points separates convex shapes as a
// whole: where `closing` is not positive the search ends, they pass each other.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/collide.h"
#include "geometry/course.h"
#include "geometry/triangle_surface.h"

namespace roboss {

constexpr double kImpactGap = 1e-5;  // m: what is nearer touches

/// The least gap of a manifold's points; infinite if it has none.
double least_gap(const Manifold& manifold);

/// How deep the points of a manifold at time t sink into each other until `dt`, at most, m.
double sinking(const Course& a, const Course& b, const Manifold& manifold, double t, double dt);

/// The first time before `dt` at which the shapes touch and go on to sink into each other by more than
/// `deep` m. `manifold` is collide()'s at the beginning, with points, and becomes that of the impact;
/// `margin` must cover all that the shapes may approach each other in the tick.
std::optional<double> time_of_impact(const Course& a, const Course& b, double dt, double deep, double margin,
                                     Manifold& manifold);

/// True if two bounded convex shapes are easily proven not to sink into each other by more than `deep` before
/// `dt`: then time_of_impact has nothing to find, and the manifold that it asks for is not needed. `n`: a
/// unit vector from b to a, where the search for a separating one begins.
bool surely_pass(const Course& a, const Course& b, double dt, const Vec3& n, double deep);

/// A plane of a surface, in W.
struct TouchedPlane {
    Vec3 n, p;
};

/// The same against the triangles of a surface at rest at X_WS, the first that is met. Triangles that the
/// shape touches at the beginning do not count, nor do those in one of the planes `held`.
std::optional<double> time_of_impact(const Course& course, const TriangleSurface& surface,
                                     const Transform& X_WS, double dt, double deep, double margin,
                                     std::span<const TouchedPlane> held,
                                     std::vector<std::uint32_t>& triangles);

}  // namespace roboss
