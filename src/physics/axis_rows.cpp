// Motors, joint friction and limits as bounded rows: the solver gives exactly the bound when a motor stalls,
// and exactly the target velocity when it does not. A hard motor's row starts from its load, as
// contacts do: it gives way only by what its load changes in a tick.
#include "physics/axis_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLimitShare = 0.2;  // of a violated limit mended in one tick
constexpr double kLimitSlop = 1e-6;  // rad or m beyond a limit that are left alone
constexpr double kLimitSpeedMax =
    1.0;  // rad/s or m/s, while mending; it never enters the velocity, so it adds no energy

constexpr double kApproachSpeedMax =
    10.0;  // rad/s or m/s, of a position motor whose force and speed have no bound: else one tick is enough

BoundedRow bounded_row(double target, double compliance, double low, double high, double mend = 0) {
    BoundedRow row;
    row.target = target, row.compliance = compliance;
    row.low = low, row.high = high, row.position_target = target + mend;
    return row;
}

/// Speed towards a position that the motor's force can still brake: sqrt(2 a e), with half of the force kept
/// in hand.
double braking_speed(const AxisState& s, double error) {
    const double acceleration = 0.5 * s.motor.max_effort * s.dof.inverse_inertia;
    return std::isfinite(acceleration) ? std::sqrt(2.0 * acceleration * std::fabs(error)) : kInfinity;
}

BoundedRow position_motor(const AxisState& s, double impulse_max) {
    const double error = s.motor.target - s.q;
    const double kp = s.dof.position_gain, kd = s.dof.velocity_gain;
    BoundedRow row;
    row.low = -impulse_max, row.high = impulse_max;
    double speed_max = s.dof.max_velocity;
    if (kp > 0) {  // implicit PD: force = kp (target - q - dt v) - kd v
        const double damping = kp * s.dt + kd;
        row.target = kp * error / damping;
        row.compliance = 1.0 / (s.dt * damping);
    } else {
        row.target = error / s.dt;
        row.compliance = s.compliance;
        speed_max = std::min(speed_max, braking_speed(s, error));
    }
    if (!std::isfinite(speed_max)) speed_max = kApproachSpeedMax;
    row.target = std::clamp(row.target, -speed_max, speed_max);
    return row;
}

void add_motor(const AxisState& s, std::vector<BoundedRow>& rows) {
    const double impulse_max = s.motor.max_effort * s.dt;
    BoundedRow row;
    switch (s.motor.mode) {
        case MotorMode::kPassive:
            return;
        case MotorMode::kVelocity:
            row.target = std::clamp(s.motor.target, -s.dof.max_velocity, s.dof.max_velocity);
            row.compliance = s.dof.velocity_gain > 0 ? 1.0 / (s.dt * s.dof.velocity_gain) : s.compliance;
            row.low = -impulse_max, row.high = impulse_max;
            break;
        case MotorMode::kPosition:
            row = position_motor(s, impulse_max);
            break;
        case MotorMode::kEffort: {
            // The ordered force, as long as it does not drive the joint beyond its maximum velocity.
            const double impulse = std::clamp(s.motor.target, -s.motor.max_effort, s.motor.max_effort) * s.dt;
            const double speed = std::isfinite(s.dof.max_velocity) ? s.dof.max_velocity : 1e6;
            row.target = impulse < 0 ? -speed : speed;
            row.compliance = s.compliance;
            row.low = std::min(impulse, 0.0), row.high = std::max(impulse, 0.0);
            break;
        }
    }
    if (has_hard_motor(s)) row.target += s.compliance * s.motor.load;
    row.position_target = row.target;
    rows.push_back(row);
}

/// Way that a limit asks for in this tick, and how hard. `room`: way left to the limit, negative beyond it.
struct LimitRow {
    double away = 0, compliance = 0;  // speed away from the limit, m/s or rad/s
    bool hard = true;
};

/// A soft limit pushes with stiffness and dissipation from the moment it is reached, both taken at the end of
/// the tick; where that is stiffer than a hard row, the hard row is taken.
LimitRow limit_row(const AxisState& s, double room) {
    const double damping = s.dt * s.dof.limit_stiffness + s.dof.limit_dissipation;
    const double compliance = 1.0 / (s.dt * damping);
    const bool soft = std::isfinite(damping) && compliance > s.compliance;
    if (room >= 0 || !soft) return {-std::max(room, 0.0) / s.dt, soft ? compliance : s.compliance, !soft};
    return {-room * s.dof.limit_stiffness / damping, compliance, false};
}

/// A limit pushes away from itself, and only if this tick could reach it. True if one is violated.
bool add_limits(const AxisState& s, std::vector<BoundedRow>& rows) {
    const double reach = s.dt * std::fabs(s.v) + 0.05;
    const double below = s.q - s.dof.lower, above = s.dof.upper - s.q;
    const auto mend = [&](double room, bool hard) {
        return hard ? std::clamp((-room - kLimitSlop) * kLimitShare / s.dt, 0.0, kLimitSpeedMax) : 0.0;
    };
    bool mends = false;
    if (below < reach) {
        const LimitRow limit = limit_row(s, below);
        rows.push_back(bounded_row(limit.away, limit.compliance, 0.0, kInfinity, mend(below, limit.hard)));
        mends |= limit.hard && below < -kLimitSlop;
    }
    if (above < reach) {
        const LimitRow limit = limit_row(s, above);
        rows.push_back(bounded_row(-limit.away, limit.compliance, -kInfinity, 0.0, -mend(above, limit.hard)));
        mends |= limit.hard && above < -kLimitSlop;
    }
    return mends;
}

bool near_limit(const Dof& dof, double q, double v, double dt) {
    const double reach = dt * std::fabs(v) + 0.05;
    return q - dof.lower < reach || dof.upper - q < reach;
}

}  // namespace

bool add_axis_rows(const AxisState& axis, std::vector<BoundedRow>& rows) {
    add_motor(axis, rows);
    const double friction = axis.dof.friction * axis.dt;
    if (friction > 0) rows.push_back(bounded_row(0.0, axis.compliance, -friction, friction));
    return axis.has_position && add_limits(axis, rows);
}

bool has_hard_motor(const AxisState& axis) {
    const MotorMode mode = axis.motor.mode;
    return (mode == MotorMode::kVelocity && !(axis.dof.velocity_gain > 0)) ||
           (mode == MotorMode::kPosition && !(axis.dof.position_gain > 0));
}

bool is_left_alone(const AxisState& axis) {
    if (axis.motor.mode != MotorMode::kPassive || axis.dof.friction > 0) return false;
    return !axis.has_position || !near_limit(axis.dof, axis.q, axis.v, axis.dt);
}

/// The limit of Runge-Kutta is 2.8, but the mobility is that of the zero pose. The solver takes them
/// implicitly.
bool is_stiff(const Dof& dof, double dt) {
    constexpr double kRateMax = 0.25;  // a tick times the damping's rate or the spring's frequency
    const double damping = dt * dof.damping * dof.inverse_inertia;
    const double spring = dt * dt * dof.spring_stiffness * dof.inverse_inertia;
    return damping > kRateMax || spring > kRateMax * kRateMax;
}

}  // namespace roboss
