// Wind and air resistance of links (LinkDrag). Fast and light things make drag stiff, so the step takes it
// implicitly: the factor between force and velocity is that of the start of the tick, the velocity that of
// its end. It then only ever slows down, and comes to rest in the air, however large it is.
#pragma once

#include "physics/dynamics/robot_work.h"

namespace roboss {

/// The wind that a robot feels in this tick, m/s, world axes.
inline Vec3 wind_of(const Model& model, const RobotWork& work) {
    const int at = work.type->wind_index;
    if (at < 0) return wind_of(model, *work.type);
    const double* wind = work.state->onboard.data() + at;
    return {wind[0], wind[1], wind[2]};
}

/// Adds the drag's impulses to the bodies' impulses; with `implicit` also what it adds to their inertias. For
/// use inside compute_impulse, after the bodies' inertias and impulses are set.
void add_drag(const Model& model, double dt, bool implicit, RobotWork& work);

/// What the air does to the drag's link at the velocities of `work`: N m about O, N.
Spatial drag_force(const Model& model, const RobotWork& work, const LinkDrag& drag);

/// Drag so large that the explicit Runge-Kutta step would not follow it.
bool drag_is_stiff(const Model& model, const RobotWork& work);

}  // namespace roboss
