// A robot with four passive legs, and piles of many: rows of joints and contacts in one part.
#pragma once

#include <string>

#include <support/bodies.h>
#include <support/random.h>

namespace roboss::test {

/// A trunk of .5 kg with four legs of 50 g on hinges with limits and damping, without motors.
inline ModelSpec legged(double mu = 0.6) {
    constexpr double kLeg = 0.09, kRadius = 0.012, kMass = 0.05;
    const Vec3 trunk{0.14, 0.09, 0.04};
    ModelSpec model;
    model.name = "legged";
    model.canonical_link = "trunk";
    model.links.push_back(link("trunk", 0.5, box_inertia(0.5, trunk)));
    model.links[0].collisions.push_back(box_shape(trunk, surface(mu)));
    for (int leg = 0; leg < 4; ++leg) {
        const double x = leg < 2 ? 0.06 : -0.06, y = leg % 2 == 0 ? 0.05 : -0.05;
        const std::string name = "leg_" + std::to_string(leg);
        const Pose X_hip{{x, y, 0}, from_rpy(y > 0 ? -0.7 : 0.7, 0, 0)};
        LinkSpec l =
            link(name, kMass, cylinder_inertia(kMass, kRadius, kLeg), X_hip * Pose{{0, 0, -0.5 * kLeg}, {}});
        l.collisions.push_back(collision(GeometryKind::kCapsule, surface(mu)));
        l.collisions.back().geometry.radius = kRadius;
        l.collisions.back().geometry.length = kLeg - 2 * kRadius;
        model.links.push_back(l);
        model.joints.push_back(
            joint(JointSpecKind::kRevolute, "hip_" + std::to_string(leg), "trunk", name, X_hip, {0, 1, 0}));
        AxisSpec& axis = model.joints.back().axes[0];
        axis.lower = -0.6, axis.upper = 0.6, axis.damping = 2e-3;
    }
    return model;
}

/// Layers of them, turned at random, .17 m apart.
inline void place_legged(World& world, int per_side, int layers, double bottom, Random& random) {
    world.prototypes.push_back(legged());
    const std::size_t prototype = world.prototypes.size() - 1;
    for (int i = 0; i < per_side * per_side * layers; ++i) {
        const Vec3 p{0.17 * (i % per_side), 0.17 * (i / per_side % per_side),
                     bottom + 0.17 * (i / per_side / per_side)};
        const double roll = random.uniform(-3, 3), pitch = random.uniform(-1.5, 1.5);
        const Quat q = from_rpy(roll, pitch, random.uniform(-3, 3));
        world.instances.push_back({"robot_" + std::to_string(i), prototype, {p, q}, {}});
    }
}

}  // namespace roboss::test
