// Moves a robot's coordinates by one tick.
#pragma once

#include "physics/robot_work.h"

namespace roboss {

/// q := q moved by dt * v; rotations exactly by the rotation vector dt * w.
void advance_coordinates(const RobotType& type, std::span<const double> v, double dt, std::span<double> q);

struct FreeBuffer {
    RobotWork work;
    std::vector<double> q, q_rate, q_sum, v, v_rate, v_sum;
};

/// One step of the classical Runge-Kutta method (fourth order) for a robot that nothing touches and no row
/// drives: writes the coordinates and velocities into its state. For contact-free motion it keeps energy and
/// momentum far better than any first-order step. `work` holds the placed robot.
void advance_freely(const Model& model, RobotWork& work, FreeBuffer& buffer);

}  // namespace roboss
