// Keeps a commanded speed within its limits (SpeedLimits) at every tick.
#pragma once

#include "onboard_kinds/speed_limits.h"

namespace roboss {

/// The next speed on the way to `wanted`: `last` and `before` are the speeds of the last two ticks, which are
/// updated. Velocity, acceleration (last to next) and jerk (change of the acceleration) stay within the
/// limits. With a limited jerk the acceleration falls in time, so that the speed does not overshoot.
double limit_speed(const SpeedLimits& limits, double wanted, double dt, double& last, double& before);

}  // namespace roboss
