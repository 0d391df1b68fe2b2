// See onboard_kinds/motor_model.h.
#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

/// The rotor's angular velocity that is asked for, rad/s.
double wanted(const MotorModelSpec& spec, const OnboardContext& c) {
    const std::span<const double> all = c.list(0);
    const auto i = static_cast<std::size_t>(spec.index());
    return i < all.size() ? std::min(all[i], spec.max_velocity) : 0.0;
}

void push_rotor(const MotorModelSpec& spec, double speed, OnboardContext& c) {
    const LinkId rotor = c.link(0);
    const Transform X_WL = c.pose(rotor);
    const double thrust = spec.sign() * speed * std::fabs(speed) * spec.motor_constant;
    const Vec3 up{X_WL.R.r0.z, X_WL.R.r1.z, X_WL.R.r2.z}, axis = c.axis(0).direction;
    const Vec3 flow = c.twist(rotor).linear - c.wind();
    const Vec3 across = (flow - axis * dot(flow, axis)) * std::fabs(speed);
    c.push(rotor, up * thrust - across * spec.rotor_drag, {});
    c.push(c.parent_of(0), {},
           up * (-spec.sign() * thrust * spec.moment_constant) - across * spec.rolling_moment);
}

}  // namespace

void run(const MotorModelSpec& spec, OnboardContext& c) {
    constexpr double kStopped = 1e-6;  // rad/s
    const double speed = c.velocity(0) * spec.slowdown;
    if (speed != 0) push_rotor(spec, speed, c);
    double& lagged = c.memory()[0];
    const double aim = wanted(spec, c);
    const double kept = fixed_exp(-c.dt() / (aim > lagged ? spec.time_up : spec.time_down));
    lagged = kept * lagged + (1 - kept) * aim;
    if (aim == 0 && std::fabs(lagged) < kStopped) lagged = 0;
    c.drive(0, MotorMode::kVelocity, spec.sign() * lagged / spec.slowdown);
}

}  // namespace roboss
