// See overlaps.h.
#include "fuzz/overlaps.h"

#include <cmath>
#include <string>

#include <support/bodies.h>
#include <support/meshes.h>

namespace roboss::fuzz {
namespace {

bool chance(Random& random, double probability) {
    return random.uniform(0, 1) < probability;
}

double magnitude(Random& random, double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
}

constexpr double kSide = 8;  // m, of the ground where it is not a plane

/// Up to z = 0, or a few centimetres above.
CollisionSpec random_ground(Random& random) {
    const SurfaceSpec s = test::surface(random.uniform(0.3, 1));
    const Pose below{{0, 0, -1}, {}};
    switch (random.integer(0, 3)) {
        case 0: {
            CollisionSpec c = test::mesh_shape(test::box_mesh({kSide, kSide, 2}), s);
            c.X_LS = below;
            return c;
        }
        case 1: {
            std::vector<double> heights(21 * 21);
            for (double& h : heights) h = random.uniform(0, 0.05);
            return test::heightmap_shape(21, 21, heights, kSide, kSide, s);
        }
        case 2:
            return test::box_shape({kSide, kSide, 2}, s, below);
        default:
            return test::collision(GeometryKind::kPlane, s);
    }
}

/// A robot whose surfaces recover at any speed, rigid or soft.
ModelSpec random_robot(Random& random) {
    MechanismOptions options;
    options.shapes = true, options.stores = false;
    options.links_most = 4;
    ModelSpec model = chance(random, 0.5) ? random_solid(random, 0) : random_tree(random, options);
    const bool soft = chance(random, 0.5), limited = chance(random, 0.6);
    const double stiffness = magnitude(random, 1e3, 1e7), damping = magnitude(random, 0.1, 1e3),
                 speed = magnitude(random, 3e-4, 1), depth = random.uniform(0, 1e-3);
    for (LinkSpec& link : model.links)
        for (CollisionSpec& c : link.collisions) {
            if (soft) c.surface.stiffness = stiffness, c.surface.damping = damping;
            if (limited) c.surface.max_vel = speed, c.surface.min_depth = depth;
        }
    return model;
}

Scene overlapping(Random& random, const Setting& setting, int robots) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s);
    scene.world.sleep = true;
    scene.base_speed = 0;
    test::place(scene.world, test::scenery(random_ground(random)), "ground");
    for (int i = 0; i < robots; ++i) {
        const ModelSpec model = random_robot(random);
        const double radius = start_radius(model);
        const Vec3 p{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), radius * random.uniform(-1, 0.7)};
        test::place(scene.world, model, "robot_" + std::to_string(i), {p, random.rotation()});
    }
    return scene;
}

}  // namespace

Scene sunk(Random& random, const Setting& setting) {
    return overlapping(random, setting, 1);
}

Scene jammed(Random& random, const Setting& setting) {
    return overlapping(random, setting, random.integer(2, 4));
}

}  // namespace roboss::fuzz
