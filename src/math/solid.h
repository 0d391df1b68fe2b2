// Volume, centre of mass and moments of inertia of simple solids of uniform density, from any table.
#pragma once

#include "math/vec3.h"

namespace roboss {

/// About the shape's own centre of mass, which lies at `centre` in its frame, per unit of density.
struct Solid {
    double volume = 0;  ///< m^3
    Vec3 centre;        ///< m
    Mat3 inertia;       ///< m^5
};

Solid solid_box(const Vec3& edges);                  ///< full edge lengths
Solid solid_ellipsoid(const Vec3& radii);            ///< axes along x, y, z
Solid solid_cylinder(double radius, double length);  ///< axis along z
Solid solid_cone(double radius, double length);      ///< axis along z, tip up, centred on its height
Solid solid_capsule(double radius, double length);   ///< axis along z; length of the straight part

}  // namespace roboss
