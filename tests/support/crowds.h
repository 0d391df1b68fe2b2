// Robots whose links are cut into many convex hulls, as tools that decompose meshes leave them.
#pragma once

#include <support/meshes.h>
#include <support/random.h>

namespace roboss::test {

/// The model with so many small hulls on each of its links, at most `spread` metres from the link's frame.
inline ModelSpec with_hulls(ModelSpec model, int hulls, double spread, std::uint64_t seed = 1) {
    Random random(seed);
    for (LinkSpec& link : model.links)
        for (int i = 0; i < hulls; ++i) {
            const Vec3 size{random.uniform(0.01, 0.05), random.uniform(0.01, 0.05),
                            random.uniform(0.01, 0.05)};
            link.collisions.push_back(
                mesh_shape(box_mesh(size), SurfaceSpec{}, {random.vector(spread), random.rotation()}));
        }
    return model;
}

}  // namespace roboss::test
