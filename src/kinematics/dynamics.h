// Inverse and forward dynamics of a robot for many configurations, apart from any simulation: rows are those
// of robot_model.h. The equation of motion is
//
//     M(q) a + C(q, v) v + g(q) = forces
//
// where M has the rotor inertias (<armature>) and g is minus the force of gravity. Not in it: contacts,
// motors, limits, friction and loops, air and water; springs and dampers of joints are passive_forces().
// Links without gravity have none here, too. Sources: Featherstone, Rigid Body Dynamics Algorithms, 2008,
// chapters 5 to 7; for the matrix C, Echeandia and Wensing, Numerical methods to compute the Coriolis matrix
// and Christoffel symbols for rigid-body systems, 2021.
#pragma once

#include <span>

#include "kinematics/robot_model.h"

namespace roboss {

/// Forces that give the accelerations `a` (recursive Newton-Euler), rows x v_columns(). Empty v or a: zeros.
/// gravity: m/s^2, world axes, as Model::gravity.
void inverse_dynamics(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                      std::span<const double> a, const Vec3& gravity, std::span<double> out);

/// g(q): forces that hold the robot at rest, rows x v_columns(), in the gravity of its world.
void gravity_forces(const RobotModel& robot, std::span<const double> q, std::span<double> out);

/// C(q, v) v, the Coriolis, centrifugal and gyroscopic forces, rows x v_columns().
void coriolis_forces(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                     std::span<double> out);

/// M(q), rows x v_columns() x v_columns(), symmetric and positive definite (composite rigid bodies).
void mass_matrices(const RobotModel& robot, std::span<const double> q, std::span<double> out);

/// C(q, v), rows x v_columns() x v_columns(): the factor for which dM/dt - 2 C is skew-symmetric; of joints
/// with one coordinate, that of the Christoffel symbols.
void coriolis_matrices(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                       std::span<double> out);

/// Accelerations that the forces give, rows x v_columns(): M^-1 (forces - C v - g). Empty v or forces: zeros.
void forward_dynamics(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                      std::span<const double> forces, const Vec3& gravity, std::span<double> out);

/// Forces of the springs and dampers of the joints on them, rows x v_columns(): -stiffness * (position -
/// reference) - damping * velocity, zero on a free base. Empty v: at rest.
void passive_forces(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                    std::span<double> out);

}  // namespace roboss
