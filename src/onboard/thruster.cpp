// See onboard_kinds/thruster.h.
#include <algorithm>
#include <cmath>

#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr double kStill = 1e-9;  // rad/s

/// Thrust coefficient at the propeller's advance ratio.
double coefficient(const ThrusterSpec& spec, double turning, double speed) {
    if (spec.coefficient != ThrusterSpec::kFollows) return spec.coefficient;
    if (!(std::fabs(turning) > kStill)) return 1;
    return spec.alpha_1 + spec.alpha_2 * ((1 - spec.wake_fraction) * speed) / (turning * spec.diameter);
}

double turning_of(double thrust, double factor) {
    if (thrust == 0 || factor == 0) return 0;
    return std::sqrt(std::fabs(thrust / factor)) * (thrust * factor > 0 ? 1.0 : -1.0);
}

/// Torque towards the angular velocity, which does not pass it within the tick.
double servo_torque(const ThrusterSpec& spec, double factor, double turning, const OnboardContext& c) {
    constexpr double kNear = 0.1;  // rad/s
    const double error = turning - c.velocity(0);
    if (!(std::fabs(error) > kNear)) return 0;
    const double a = turning_of(spec.min_command, factor), b = turning_of(spec.max_command, factor);
    const double low = spec.by_velocity ? spec.min_command : std::min(a, b);
    const double high = spec.by_velocity ? spec.max_command : std::max(a, b);
    const double most = std::fabs(error) / (c.dt() * std::max(c.dof(0).inverse_inertia, 1e-300));
    return std::clamp(std::clamp(spec.p_gain * error, low, high), -most, most);
}

}  // namespace

void run(const ThrusterSpec& spec, OnboardContext& c) {
    if (is_out_of_power(c)) return;
    const AxisPlace axis = c.axis(0);
    const LinkId propeller = c.child_of(0);
    double& turning = c.memory()[0];
    const double d = spec.diameter, speed = norm(c.twist(propeller).linear);
    const double factor = spec.density * d * d * d * d * coefficient(spec, turning, speed);
    const double command = std::clamp(c.command(0)[0], spec.min_command, spec.max_command);
    double thrust = spec.by_velocity ? factor * command * std::fabs(command) : command;
    turning = spec.by_velocity ? command : turning_of(command, factor);
    const bool switched_off = c.is_commanded(1) && c.command(1)[0] == 0;
    const bool has_deadband = spec.deadband >= 0 ? !switched_off : false;
    if (has_deadband && std::fabs(thrust) < spec.deadband) thrust = turning = 0;
    if (spec.servo)
        c.drive(0, MotorMode::kVelocity, turning);
    else
        c.drive(0, MotorMode::kEffort, servo_torque(spec, factor, turning, c));
    if (thrust != 0) c.push_at(propeller, axis.direction * thrust, c.pose(propeller).p);
}

}  // namespace roboss
