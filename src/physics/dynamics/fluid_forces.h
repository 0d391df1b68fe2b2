// What air and water do to a robot's links: lift and drag of wings, damping, added mass, buoyancy. These are
// force laws of the pose and the velocity, evaluated wherever the dynamics are: at each stage of a
// Runge-Kutta step, and implicitly where the solver takes the tick as a whole.
#pragma once

#include <span>

#include "physics/dynamics/robot_work.h"

namespace roboss {

/// Adds the impulses to those of the bodies, and sets `flows`: the added mass and, with a weight (then the
/// tick is taken implicitly), dt times the damping. For use inside compute_impulse, after the bodies'
/// impulses are set; `work` has poses, velocities and biases at the coordinates q.
void add_fluid_forces(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                      RobotWork& work);

/// Sets `flows` to the added masses alone. `work` has poses.
void set_added_masses(const RobotType& type, Mechanics<double>& work);

/// Adds `flows` to the mass matrix.
void add_flow_inertia(const RobotType& type, Mechanics<double>& work);

/// True if all that the fluids do to the robot takes energy from its motion: wings in still air, without
/// moments of their own. Lift is normal to the velocity, drag is against it.
bool flow_takes_energy(const Model& model, const RobotWork& work);

/// Damping so large that the explicit Runge-Kutta step would not follow it.
bool flow_is_stiff(const Model& model, const RobotWork& work);

/// Adds what the fluids do to each link to `forces` (N m about O, N), with the added mass's share of the
/// accelerations: those of the bodies without their bias.
void sum_fluid_forces(const Model& model, const RobotWork& work, std::span<const Spatial> accelerations,
                      std::span<Spatial> forces);

}  // namespace roboss
