// Moves a robot's coordinates by one tick.
#pragma once

#include "model/coordinates.h"
#include "physics/dynamics/equality.h"

namespace roboss {

/// What acts on a robot evenly during a tick, besides the forces of its own motion.
struct SteadyRows {
    std::span<const double> force;  // generalised, N m or N, the base's part about its moving origin
    std::span<const char> locked;   // by degree of freedom: its velocity stays
    bool has_stiff = false;         // the force holds what stiff springs and dampings do
};

/// Joints that a kick-drift step holds, and where it begins.
struct HeldJoints {
    std::vector<char> locked;      // by degree of freedom
    std::vector<double> velocity;  // of the locked ones
    std::vector<double> q_start, v_start;
};

struct FreeBuffer {
    /// Whose threads may share the work.
    void share_with(const Team& team) {
        solver.share_with(team), projection.share_with(team), walk.share_with(team);
    }

    RobotWork work;
    Equalities equalities;
    EqualitySolver solver;
    EqualityProjection projection;
    BodyWalk walk;
    std::vector<double> wanted, change, factor;
    std::vector<double> q, q_sum, v, v_sum;
    std::vector<double> q_start, v_start,
        open_velocity;                     // of a robot with loops; the last with its loops open
    double kinetic_start = 0;              // J; of a net
    double kinetic_open = 0;               // J; of a net: at most its energy with its loops open
    std::vector<double> q_rates, v_rates;  // of all stages, one after the other
    std::vector<double> force;             // of SteadyRows
    HeldJoints held;
};

/// One tick of a Runge-Kutta method: of fourth order for a lone body, of sixth for bodies on joints. Writes
/// the coordinates and velocities into the robot's state. Loops and couplings are met at each stage and put
/// back exactly at the end; locked degrees of freedom keep their velocities. A tick in which something turns
/// far is cut into several steps; `fastest`: the square of the largest angular velocity of a body, (rad/s)^2.
/// For contact-free motion it keeps energy and momentum far better than any first-order step.
void advance_steadily(const Model& model, RobotWork& work, const SteadyRows& rows, double fastest,
                      FreeBuffer& buffer);

/// The number of steps that a tick is cut into: no body turns further in one than the methods follow to a
/// millionth. `fastest`: as above.
int parts_of_tick(const RobotType& type, double fastest, double dt);

/// The square of the largest angular velocity of a moved robot's bodies, (rad/s)^2.
double fastest_turn(const Mechanics<double>& work);

}  // namespace roboss
