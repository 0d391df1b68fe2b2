// Collision shapes, in their own frame, centred at their own origin (a plane: the half-space z <= 0 of its
// frame). Hulls and surfaces point to shared constant data that the Model owns.
#pragma once

#include "math/aabb.h"
#include "math/pose.h"

namespace roboss {

enum class ShapeKind : unsigned char {
    kPlane,
    kSphere,
    kBox,
    kCylinder,
    kCapsule,
    kEllipsoid,
    kHull,    // convex polytope
    kSurface  // triangles of a mesh or a height field: scenery only
};

struct ConvexHull;
class TriangleSurface;

struct Shape {
    ShapeKind kind = ShapeKind::kSphere;
    Vec3 half;               // box: half edges; ellipsoid: radii, m
    double radius = 0;       // sphere, cylinder, capsule, m
    double half_length = 0;  // cylinder, capsule (straight part), along the shape's z, m
    const ConvexHull* hull = nullptr;
    const TriangleSurface* surface = nullptr;
};

/// Tight box in W of a shape at X_WS. A plane's is infinite.
Aabb bounds(const Shape& shape, const Transform& X_WS);

/// Radius of the smallest origin-centred sphere that holds the shape; infinite for a plane.
double bounding_radius(const Shape& shape);

}  // namespace roboss
