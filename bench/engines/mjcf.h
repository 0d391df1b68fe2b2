// A World as MuJoCo's XML, and where its bodies and joints stand in the compiled model.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engines/assembly.h"

namespace roboss::bench {

/// How MuJoCo is set up.
struct MjcfOptions {
    double dt_s = 0.002;
    std::string solver = "CG", cone = "elliptic", jacobian = "sparse";
    int iterations = 100;
    double tolerance = 1e-8, impratio = 1;
    double contact_time_s = 0.004;  // solref's time constant; MuJoCo wants at least two steps
    // Before version 3 the first three, since then the last: what its buffers hold.
    long rows_max = 100, contacts_max = 100, stack_numbers = 1000000, memory_bytes = 0;
    std::string integrator = "Euler";
    bool sleep = false;        // trees at rest; since version 4
    bool speculative = false;  // contacts of bodies that would pass through each other; since version 4
};

/// The XML; bodies and joints are numbered as in `MjcfPlaces`.
struct MjcfPlaces {
    struct Instance {
        Assembly assembly;
        int first_body = 0;                    // MuJoCo's id of bodies[0]
        std::vector<std::vector<int>> joints;  // MuJoCo's id by ModelSpec::joints and axis; -1: none
        std::vector<int> free_joints;          // by body; -1: none
    };
    std::vector<Instance> instances;
    std::vector<std::shared_ptr<const HeightGridSpec>>
        heights;  // by MuJoCo's id of the height field: its data
    std::string xml;
};

/// Nothing where MuJoCo cannot express the World.
std::optional<MjcfPlaces> write_mjcf(const World& world, const MjcfOptions& options);

/// Solver time constant and damping ratio with which a contact of stiffness 1 / (time * ratio)^2 bounces
/// back with `restitution`.
struct SolverReference {
    double time_s = 0, ratio = 1;
};
SolverReference bouncing_reference(double restitution, double dt_s);

}  // namespace roboss::bench
