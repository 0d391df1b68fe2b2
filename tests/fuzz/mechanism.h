// Random mechanisms by seed, for property tests: nobody has tuned the engine to them. Every quantity comes
// from one Random, so a seed names a mechanism on every machine.
#pragma once

#include <vector>

#include <support/random.h>

#include "world/joint_type.h"
#include "world/world.h"

namespace roboss::fuzz {

using test::Random;

struct MechanismOptions {
    int links_least = 1, links_most = 5;
    bool fixed_base = false;
    bool bare = false;   // joints without limits, damping, friction, springs and rotors: no row ever acts
    bool stores = true;  // springs, soft limits and rotors, which hold energy besides the links
    std::vector<JointSpecKind> kinds{JointSpecKind::kRevolute, JointSpecKind::kPrismatic,
                                     JointSpecKind::kBall, JointSpecKind::kUniversal, JointSpecKind::kScrew};
    bool planar = true;           // besides `kinds`, planar joints in one mechanism of eight
    bool shapes = false;          // a collision on every link
    double restitution_most = 0;  // of 40 % of the shapes
};

/// A tree of revolute, prismatic, ball, universal, screw and planar joints with random frames, inertias,
/// limits, damping, friction, springs and rotor inertias. No motor drives it. A free base is one of its
/// links.
ModelSpec random_tree(Random& random, const MechanismOptions& options);

/// A mechanism with one kinematic loop and at least one internal degree of freedom: a chain of random joints
/// back to its base, or a planar four-bar linkage.
ModelSpec random_loop(Random& random, const MechanismOptions& options);

/// A mechanism with six loops and more, closed by ball joints between random links, and at least as many
/// internal degrees of freedom as loops. No rotors, so that its loops are solved joint by joint.
ModelSpec random_net(Random& random, MechanismOptions options);

/// A tree with a mimic joint, or two wheels with a gearbox.
ModelSpec random_coupled(Random& random, const MechanismOptions& options);

/// One link with one random shape: box, ball, cylinder, capsule or ellipsoid.
ModelSpec random_solid(Random& random, double restitution_most);

/// Robots of tests/support name joints as their links, which a file may not.
ModelSpec with_own_joint_names(ModelSpec model);

/// Radius of the sphere about the model's origin that holds all links at the start.
double start_radius(const ModelSpec& model);

}  // namespace roboss::fuzz
