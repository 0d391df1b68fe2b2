// Volume, centre and moments of a mesh, in the four ways that MuJoCo knows (<mesh inertia>).
#pragma once

#include <optional>
#include <string>

#include "math/solid.h"
#include "world/world.h"

namespace roboss::mjcf {

enum class MeshInertia {
    kLegacy,  ///< each triangle's pyramid counts as positive, also where the mesh is hollow or wound inward
    kExact,   ///< signed pyramids: right for closed meshes
    kConvex,  ///< the convex hull
    kShell    ///< the surface, with a density in kg/m^2
};

/// nullopt: it has no volume (kShell: no area), or is wound inward.
std::optional<Solid> mesh_solid(const MeshSpec& mesh, MeshInertia kind);

/// The box with the same moments and volume that MuJoCo fits shapes to: half edges, the smallest first, in
/// the frame of the principal axes `q`.
struct InertiaBox {
    Vec3 half;  ///< m
    Quat q;     ///< from the principal axes to the mesh
};
InertiaBox inertia_box(const Solid& solid);

/// The convex hull of its vertices, as triangles; nullopt: they are flat, or fewer than four.
std::optional<MeshSpec> hull_of(const MeshSpec& mesh);

}  // namespace roboss::mjcf
