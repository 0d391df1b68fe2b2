// Mass properties of geoms and bodies, as MuJoCo's compiler works them out.
#pragma once

#include <optional>
#include <span>

#include "math/pose.h"
#include "math/solid.h"
#include "mjcf/settings.h"

namespace roboss::mjcf {

struct Mass {
    double mass = 0;  ///< kg
    Vec3 centre;      ///< m
    Mat3 inertia;     ///< kg m^2, about the centre
};

/// Of a geom, in the frame of its body.
struct GeomMass {
    Mass mass;
    int group = 0;
};

/// Area, centre and moments of the surface of a shape (`shellinertia`): volume is the area in m^2. nullopt:
/// the shape has none.
std::optional<Solid> shell_of(const GeometrySpec& shape);

/// The same of the volume; of meshes: none.
std::optional<Solid> solid_of(const GeometrySpec& shape);

/// `solid` per unit of density, placed by X, with this density.
Mass placed(const Solid& solid, const Pose& X, double density);

/// The sum of those whose group counts; nullopt: none has mass.
std::optional<Mass> sum_of(std::span<const GeomMass> geoms, const Settings& settings);

/// With <compiler>'s boundmass, boundinertia and balanceinertia.
Mass bounded(const Mass& mass, const Settings& settings);

}  // namespace roboss::mjcf
