// Rows of one axis of a joint, whether it is a degree of freedom of the tree or a free direction of a loop
// joint: motor, joint friction, limits. Bounded rows: the solver gives exactly the bound when a motor stalls,
// and exactly the target velocity when it does not. A hard motor's row starts from its load, as contacts do:
// it gives way only by what its load changes in a tick. Over T: see rows.h.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "physics/solver/rows.h"

namespace roboss {

/// Everything about one axis that its rows need. In lanes, all motors have the same mode.
template <class T>
struct AxisStateT {
    const Dof& dof;
    const MotorSetpointT<T>& motor;
    T q{}, v{};
    double dt = 0;
    double compliance = 0;  // of a hard row
    bool has_position = true;
};
using AxisState = AxisStateT<double>;

namespace axis {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kLimitShare = 0.2;  // of a violated limit corrected in one tick
inline constexpr double kLimitSlop = 1e-6;  // rad or m beyond a limit that are left alone
inline constexpr double kLimitSpeedMax =
    1.0;  // rad/s or m/s, while correction; it never enters the velocity, so it adds no energy
inline constexpr double kApproachSpeedMax =
    10.0;  // rad/s or m/s, of a position motor without gains whose force and speed have no bound

template <class T>
[[gnu::always_inline]] inline void set_row(const T& target, double compliance, double low, double high,
                                           const T& mend, BoundedRowT<T>& row) {
    row.target = target, row.compliance = compliance;
    row.low = low, row.high = high, row.position_target = target + mend;
}

/// Speed towards a position that the motor's force can still brake: sqrt(2 a e), with half of the force kept
/// in hand.
template <class T>
T braking_speed(const AxisStateT<T>& s, const T& error) {
    using std::sqrt;
    const T acceleration = 0.5 * s.motor.max_effort * s.dof.inverse_inertia;
    return select(acceleration < T(kInfinity), sqrt(2.0 * acceleration * magnitude(error)), T(kInfinity));
}

template <class T>
[[gnu::always_inline]] inline void position_motor(const AxisStateT<T>& s, const T& impulse_max,
                                                  BoundedRowT<T>& row) {
    const T error = s.motor.target - s.q;
    T speed_max = smaller(T(s.dof.max_velocity), braking_speed(s, error));
    speed_max = select(speed_max < T(kInfinity), speed_max, T(kApproachSpeedMax));
    row.target = clamped(error / T(s.dt), -speed_max, speed_max);
    row.compliance = s.compliance;
    row.low = -impulse_max, row.high = impulse_max;
}

/// A position motor with gains is an implicit PD: force = kp (target - q - dt v) - kd v.
template <class T>
[[gnu::always_inline]] inline void servo(const AxisStateT<T>& s, const T& impulse_max, BoundedRowT<T>& row) {
    const double kp = s.dof.position_gain, damping = kp * s.dt + s.dof.velocity_gain;
    row.target = kp * (s.motor.target - s.q) / T(damping);
    row.compliance = 1.0 / (s.dt * damping);
    row.low = -impulse_max, row.high = impulse_max;
}

/// A servo does not drive the joint beyond its maximum velocity: there, this row takes back what it gives.
/// Both together stay within the motor's bound.
template <class T>
void brake_servo(const AxisStateT<T>& s, BoundedRowT<T>& servo, BoundedRowT<T>& row) {
    const T most = s.dof.max_velocity;
    const T beyond = larger(magnitude(servo.target) - most, T(0));
    const T given = smaller(beyond / servo.compliance, servo.high);  // at the maximum velocity
    const MaskOf<T> ahead = servo.target > T(0);
    row.target = select(ahead, most, -most);
    row.compliance = s.compliance;
    row.low = select(ahead, -given, T(0)), row.high = select(ahead, T(0), given);
    row.position_target = row.target;
    servo.low -= row.low, servo.high -= row.high;
}

/// The ordered force, as long as it does not drive the joint beyond its maximum velocity.
template <class T>
[[gnu::always_inline]] inline void effort_motor(const AxisStateT<T>& s, BoundedRowT<T>& row) {
    const T impulse = clamped(s.motor.target, -s.motor.max_effort, s.motor.max_effort) * T(s.dt);
    const double speed = std::isfinite(s.dof.max_velocity) ? s.dof.max_velocity : 1e6;
    row.target = select(impulse < T(0), T(-speed), T(speed));
    row.compliance = s.compliance;
    row.low = smaller(impulse, T(0)), row.high = larger(impulse, T(0));
}

template <class T>
[[gnu::always_inline]] inline void velocity_motor(const AxisStateT<T>& s, const T& impulse_max,
                                                  BoundedRowT<T>& row) {
    row.target = kIsFloat<T>
                     ? s.motor.target  // in bounds, and relative to the present velocity (lane_state.h)
                     : clamped(s.motor.target, T(-s.dof.max_velocity), T(s.dof.max_velocity));
    row.compliance = s.dof.velocity_gain > 0 ? 1.0 / (s.dt * s.dof.velocity_gain) : s.compliance;
    row.low = -impulse_max, row.high = impulse_max;
}

/// Displacement that a limit asks for in this tick, and how hard. `room`: distance left to the limit,
/// negative beyond it.
template <class T>
struct LimitRow {
    T away{};  // speed away from the limit, m/s or rad/s
    double compliance = 0;
    bool hard = true;
};

/// A soft limit pushes with stiffness and dissipation from the moment it is reached, both taken at the end of
/// the tick; where that is stiffer than a hard row, the hard row is taken.
template <class T>
LimitRow<T> limit_row(const AxisStateT<T>& s, const T& room) {
    const double damping = s.dt * s.dof.limit_stiffness + s.dof.limit_dissipation;
    const double compliance = 1.0 / (s.dt * damping);
    const bool soft = std::isfinite(damping) && compliance > s.compliance;
    const T closing = -larger(room, T(0)) / T(s.dt);
    if (!soft) return {closing, s.compliance, true};
    return {select(room >= T(0), closing, -room * s.dof.limit_stiffness / T(damping)), compliance, false};
}

template <class T>
MaskOf<T> near(const T& room, const T& v, double dt) {
    return room < dt * magnitude(v) + 0.05;
}

/// A limit pushes away from itself, and only if this tick could reach it. True if one is violated.
template <class T, class Row>
MaskOf<T> add_limits(const AxisStateT<T>& s, Lockstep<T>& together, std::vector<Row>& rows) {
    const T below = s.q - T(s.dof.lower), above = T(s.dof.upper) - s.q;
    const auto mend = [&](const T& room, bool hard) {
        return hard ? clamped((-room - kLimitSlop) * kLimitShare / T(s.dt), T(0), T(kLimitSpeedMax)) : T(0);
    };
    MaskOf<T> corrects = false;
    if (together(near(below, s.v, s.dt))) {
        const LimitRow<T> limit = limit_row(s, below);
        set_row<T>(limit.away, limit.compliance, 0.0, kInfinity, mend(below, limit.hard),
                   rows.emplace_back());
        if (limit.hard) corrects = corrects | (below < T(-kLimitSlop));
    }
    if (together(near(above, s.v, s.dt))) {
        const LimitRow<T> limit = limit_row(s, above);
        set_row<T>(-limit.away, limit.compliance, -kInfinity, 0.0, -mend(above, limit.hard),
                   rows.emplace_back());
        if (limit.hard) corrects = corrects | (above < T(-kLimitSlop));
    }
    return corrects;
}

}  // namespace axis

/// True if the axis' motor goes to a position with gains.
template <class T>
bool is_servo(const AxisStateT<T>& axis) {
    return axis.motor.mode == MotorMode::kPosition && axis.dof.position_gain > 0;
}

/// True if the axis' motor is hard, one without gains: its row, the first, starts from the motor's load.
template <class T>
bool has_hard_motor(const AxisStateT<T>& axis) {
    const MotorMode mode = axis.motor.mode;
    return (mode == MotorMode::kVelocity && !(axis.dof.velocity_gain > 0)) ||
           (mode == MotorMode::kPosition && !is_servo(axis));
}

/// Rows of the motor, if it drives.
template <class T, class Row>
[[gnu::always_inline]] inline void add_motor(const AxisStateT<T>& s, std::vector<Row>& rows) {
    if (s.motor.mode == MotorMode::kPassive) return;
    const T impulse_max = s.motor.max_effort * T(s.dt);
    BoundedRowT<T>& row = rows.emplace_back();
    if (s.motor.mode == MotorMode::kVelocity)
        axis::velocity_motor(s, impulse_max, row);
    else if (s.motor.mode == MotorMode::kEffort)
        axis::effort_motor(s, row);
    else if (has_hard_motor(s))
        axis::position_motor(s, impulse_max, row);
    else
        axis::servo(s, impulse_max, row);
    if (has_hard_motor(s)) row.target += s.compliance * s.motor.load;
    row.position_target = row.target;
    if (is_servo(s) && std::isfinite(s.dof.max_velocity)) {
        rows.emplace_back();
        axis::brake_servo(s, rows[rows.size() - 2], rows.back());
    }
}

/// Rows of the axis, appended (`Row`: a BoundedRowT<T>). True if a hard limit is violated and so has
/// something to mend.
template <class T, class Row>
MaskOf<T> add_axis_rows(const AxisStateT<T>& axis, Lockstep<T>& together, std::vector<Row>& rows) {
    add_motor(axis, rows);
    const double friction = axis.dof.friction * axis.dt;
    if (friction > 0) axis::set_row<T>(T(0), axis.compliance, -friction, friction, T(0), rows.emplace_back());
    if (!axis.has_position) return false;
    return axis::add_limits(axis, together, rows);
}

/// True for a motor that is not there, or an effort motor at zero.
template <class T>
MaskOf<T> is_switched_off(const MotorSetpointT<T>& motor) {
    if (motor.mode == MotorMode::kEffort) return equal(motor.target, T(0));
    return motor.mode == MotorMode::kPassive;
}

/// True if no row acts on the axis and none will in this tick.
template <class T>
MaskOf<T> is_left_alone(const AxisStateT<T>& axis) {
    const MaskOf<T> off = is_switched_off(axis.motor);
    if (axis.dof.friction > 0 || !any(off)) return false;
    if (!axis.has_position) return off;
    return off & !(axis::near(axis.q - T(axis.dof.lower), axis.v, axis.dt) |
                   axis::near(T(axis.dof.upper) - axis.q, axis.v, axis.dt));
}

/// Springs or damping so stiff that the explicit Runge-Kutta step would not follow them. The limit of
/// Runge-Kutta is 2.8, but the mobility is that of the zero pose. The solver takes them implicitly.
inline bool is_stiff(const Dof& dof, double dt) {
    constexpr double kRateMax = 0.25;  // a tick times the damping's rate or the spring's frequency
    const double damping = dt * dof.damping * dof.inverse_inertia;
    const double spring = dt * dt * dof.spring_stiffness * dof.inverse_inertia;
    return damping > kRateMax || spring > kRateMax * kRateMax;
}

}  // namespace roboss
