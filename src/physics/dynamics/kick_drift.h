// The kick-drift step of a robot that rows act on: the impulses of its rows are split into a kick at the
// beginning of the tick, which changes velocities at once (impacts, what stops at a limit or sticks), and a
// steady load, which balances forces (weight on a contact, centrifugal force at a limit). Between kicks the
// robot drifts: it moves by the Runge-Kutta method of free robots, with held joints locked. A kick by passive
// rows takes energy, a drift keeps it, so a passive robot gains none, whatever the time step (splitting
// methods: Hairer, Lubich, Wanner 2006, II.5). The explicit step keeps velocities as numbers while the mass
// matrix changes and takes velocity-dependent forces at the beginning of the tick: both add energy of
// relative size (turn in a tick)^2. docs/decisions/0015-kick-drift.md.
#pragma once

#include <span>

#include "physics/dynamics/integrate.h"
#include "physics/dynamics/robot_energy.h"

namespace roboss {

/// True if no motor, wrench, wind or spring of a loop joint can give the robot energy that BodySums does not
/// count.
bool is_passive(const Model& model, const RobotWork& work);
/// The same of all but motors.
bool only_motors_drive(const Model& model, const RobotWork& work);

/// What the solver found for one robot; all spans have its nv entries, or none where no row acts.
struct SolvedTick {
    std::span<const double> velocity;      // at the end of the tick
    std::span<const double> displacement;  // of the tick, over dt
    std::span<const double> kick,
        load;                      // generalised impulses of rows, N s; those of locked joints are left out
    std::span<const char> locked;  // held at `held`
    std::span<const double> held;
    bool isolated = false;         // nothing from outside pushes
    bool passive = false;          // and is_passive
    bool flies_displaced = false;  // a lone body that turns far, pushed by what does not move freely
};

/// Moves the placed robot by one tick. Its momentum changes by the contacts' impulses and gravity alone, and
/// by what is returned: angular momentum, N m s, about any fixed point, that comes of a displacement other
/// than that of the velocity. A velocity that flies_displaced turns with the body. Where it is isolated and
/// passive, the sum of kinetic and potential energy grows by no more than 2e-5 of the kinetic a second.
Vec3 advance_kick_drift(const Model& model, RobotWork& work, const SolvedTick& solved, FreeBuffer& buffer);

/// Moves the placed robot, which nothing pushes and no row acts on, by one tick of the Runge-Kutta method
/// (advance_steadily; a lone body: lone_body.h). Where it turns fast, or a joint of a free robot changes its
/// velocity suddenly, momentum and energy are guarded as in advance_kick_drift.
void advance_freely(const Model& model, RobotWork& work, FreeBuffer& buffer);

}  // namespace roboss
