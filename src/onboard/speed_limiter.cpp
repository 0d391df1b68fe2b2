// See speed_limiter.h.
#include "onboard/speed_limiter.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

/// As Gazebo has it: if the bounds cross, the lower one counts.
double clamped(double x, double low, double high) {
    return fixed_max(fixed_min(x, high), low);
}

/// The largest acceleration towards a speed that is `gap` away (m/s) from which a jerk of size `jerk` brings
/// the acceleration to zero in time. Let E = gap / (jerk dt^2). An acceleration of x jerk dt with x = n + f
/// (n whole, 0 <= f < 1) falls by jerk dt a tick and moves the speed by (n + 1) (f + n / 2) jerk dt^2 in all;
/// this solves (n + 1) (f + n / 2) = E.
double most_acceleration(double gap, double jerk, double dt) {
    if (std::isinf(jerk)) return gap / dt;
    if (jerk <= 0) return 0;
    const double reach = gap / (jerk * dt * dt);
    const double whole = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * reach) - 1.0));
    const double part = (reach - 0.5 * whole * (whole + 1.0)) / (whole + 1.0);
    return (whole + part) * jerk * dt;
}

}  // namespace

double limit_speed(const SpeedLimits& limits, double wanted, double dt, double& last, double& before) {
    const double target = clamped(wanted, limits.min_velocity, limits.max_velocity);
    double next = target;
    if (std::isfinite(limits.min_jerk) || std::isfinite(limits.max_jerk)) {
        const double gap = target - last, now = (last - before) / dt;
        const double fastest = gap >= 0 ? most_acceleration(gap, -limits.min_jerk, dt)
                                        : -most_acceleration(-gap, limits.max_jerk, dt);
        const double allowed = clamped(fastest, limits.min_acceleration, limits.max_acceleration);
        const double jerk = clamped((allowed - now) / dt, limits.min_jerk, limits.max_jerk);
        next = clamped(last + (now + jerk * dt) * dt, limits.min_velocity, limits.max_velocity);
        if (std::fabs(next - target) <= 1e-15 * std::fabs(target)) next = target;
    } else {
        const double change = target - last;
        if (change > limits.max_acceleration * dt || change < limits.min_acceleration * dt)
            next = last + clamped(change, limits.min_acceleration * dt, limits.max_acceleration * dt);
    }
    before = last, last = next;
    return next;
}

}  // namespace roboss
