// What the comparisons of accelerations with oracles share: the mechanisms, random states of them, and our
// accelerations, made of the pieces of the free step.
#pragma once

#include <string>
#include <vector>

#include <support/random.h>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss::test {

struct Mechanism {
    std::string name;
    ModelSpec model;
    double spread = 0.3;  // of the random coordinates before the loops are closed
};
inline void PrintTo(const Mechanism& mechanism, std::ostream* out) {
    *out << mechanism.name;
}

/// Eight trees of every joint kind that MuJoCo has.
std::vector<Mechanism> trees();
/// Twelve mechanisms: loops closed by each joint kind, screws, a gearbox, a mimic joint, parallel robots.
std::vector<Mechanism> constrained_mechanisms();

/// Explicit damping, as in a continuous-time model; `joint_force` one a Dof.
std::vector<double> free_acceleration(const Model& model, RobotState& state,
                                      const std::vector<double>& joint_force);

/// Anywhere, with wrenches on all links.
RobotState random_tree_state(const Model& model, Random& random);
/// Near the start, on the loops, with velocities along them.
RobotState random_state_on_loops(const Model& model, Random& random, double spread);
std::vector<double> random_forces(const RobotType& type, Random& random);

/// Largest difference over largest size; infinite if something is no number.
double relative_error(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace roboss::test
