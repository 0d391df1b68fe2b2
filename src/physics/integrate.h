// Moves a robot's coordinates by one tick.
#pragma once

#include "model/coordinates.h"
#include "physics/equality.h"

namespace roboss {

struct FreeBuffer {
    RobotWork work;
    Equalities equalities;
    EqualitySolver solver;
    EqualityProjection projection;
    std::vector<double> wanted, change, factor;
    std::vector<double> q, q_sum, v, v_sum;
    std::vector<double> q_rates, v_rates;  // of all stages, one after the other
};

/// One step of a Runge-Kutta method for a robot that nothing touches and no row drives: of fourth order for a
/// lone body, of sixth for bodies on joints. Writes the coordinates and velocities into its state. Loops and
/// couplings are met at each stage and put back exactly at the end. A tick in which something turns far is
/// cut into several steps. For contact-free motion it keeps energy and momentum far better than any
/// first-order step. `work` holds the placed robot.
void advance_freely(const Model& model, RobotWork& work, FreeBuffer& buffer);

}  // namespace roboss
