// The narrow phase's pairs, for the files of this folder only. Each function gets its shapes in the order of
// their kinds, writes points with gap <= margin into an empty manifold, and lets the normal point from its
// second shape to its first.
#pragma once

#include "geometry/collide.h"

namespace roboss::narrow {

struct Posed {
    const Shape& shape;
    const Transform& X;  // X_WS

    Vec3 axis(std::size_t i) const { return X.R.col(i); }
};

/// The radius of the ball that rounds a sphere or capsule; 0 for other shapes.
inline double ball_of(const Shape& shape) {
    return shape.kind == ShapeKind::kSphere || shape.kind == ShapeKind::kCapsule ? shape.radius : 0.0;
}

using PairFunction = void (*)(const Posed& a, const Posed& b, double margin, Manifold& out);

void plane_sphere(const Posed& plane, const Posed& sphere, double margin, Manifold& out);
void plane_box(const Posed& plane, const Posed& box, double margin, Manifold& out);
void plane_cylinder(const Posed& plane, const Posed& cylinder, double margin, Manifold& out);
void plane_capsule(const Posed& plane, const Posed& capsule, double margin, Manifold& out);
void sphere_sphere(const Posed& a, const Posed& b, double margin, Manifold& out);
void sphere_box(const Posed& sphere, const Posed& box, double margin, Manifold& out);
void sphere_cylinder(const Posed& sphere, const Posed& cylinder, double margin, Manifold& out);
void sphere_capsule(const Posed& sphere, const Posed& capsule, double margin, Manifold& out);
void box_box(const Posed& a, const Posed& b, double margin, Manifold& out);
void capsule_capsule(const Posed& a, const Posed& b, double margin, Manifold& out);

/// Any two of box, cylinder and capsule but two capsules, exact and slower than the functions for one pair.
void convex_convex(const Posed& a, const Posed& b, double margin, Manifold& out);

void plane_ellipsoid(const Posed& plane, const Posed& ellipsoid, double margin, Manifold& out);
void plane_hull(const Posed& plane, const Posed& hull, double margin, Manifold& out);

/// Any two bounded convex shapes; features of 32 bits, see wide_feature.
void general_general(const Posed& a, const Posed& b, double margin, Manifold& out);

}  // namespace roboss::narrow
