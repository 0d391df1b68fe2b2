// What is measured where a ray meets a shape, in doubles and closed form: distance, normal, place on the
// picture.
#pragma once

#include "render/visual_world.h"

namespace roboss::render {

struct ExactHit {
    double t = 0;           // in lengths of the direction
    Vec3 n_S, flat_S;       // unit, in the shape's frame: to be lit, and of the surface itself
    double u = 0, v = 0;    // on the picture
    double uv_density = 0;  // pictures by metre
};

/// The ray o + t d in the frame of the shape. `hollow`: only its outside is seen.
ExactHit exact_hit(const TraceItem& item, const VisualMesh* mesh, std::uint32_t triangle, const Vec3& o,
                   const Vec3& d, double t_min, bool hollow);

}  // namespace roboss::render
