// Motors, joint friction and limits as bounded rows: the solver gives exactly the bound when a motor stalls,
// and exactly the target velocity when it does not.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/drag.h"
#include "physics/rows.h"

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLimitShare = 0.2;  // of a violated limit mended in one tick
constexpr double kLimitSlop = 1e-6;  // rad or m beyond a limit that are left alone
constexpr double kLimitSpeedMax =
    1.0;  // rad/s or m/s, while mending; it never enters the velocity, so it adds no energy

/// Everything about one degree of freedom that its rows need.
struct DofState {
    const Dof& dof;
    const MotorSetpoint& motor;
    double q, v, dt;
    double compliance;  // of a hard row
};

JointRow bounded_row(int dof, double target, double compliance, double low, double high, double mend) {
    JointRow row;
    row.dof = dof, row.target = target, row.compliance = compliance;
    row.low = low, row.high = high, row.position_target = target + mend;
    return row;
}

/// Speed towards a position that the motor's force can still brake: sqrt(2 a e), with half of the force kept
/// in hand.
double braking_speed(const DofState& s, double error) {
    const double acceleration = 0.5 * s.motor.max_effort * s.dof.inverse_inertia;
    return std::isfinite(acceleration) ? std::sqrt(2.0 * acceleration * std::fabs(error)) : kInfinity;
}

JointRow position_motor(const DofState& s, double impulse_max) {
    const double error = s.motor.target - s.q;
    const double kp = s.dof.position_gain, kd = s.dof.velocity_gain;
    JointRow row;
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
    row.target = std::clamp(row.target, -speed_max, speed_max);
    return row;
}

void add_motor(const DofState& s, int dof, std::vector<JointRow>& rows) {
    const double impulse_max = s.motor.max_effort * s.dt;
    JointRow row;
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
    row.position_target = row.target;
    row.dof = dof;
    rows.push_back(row);
}

/// A limit pushes away from itself, and only if this tick could reach it. Returns true if it is violated.
bool add_limits(const DofState& s, int dof, std::vector<JointRow>& rows) {
    const double reach = s.dt * std::fabs(s.v) + 0.05;
    const double below = s.q - s.dof.lower, above = s.dof.upper - s.q;  // way left, negative when violated
    const auto target = [&](double room) { return std::max(room, 0.0) / s.dt; };
    const auto mend = [&](double room) {
        return std::clamp((-room - kLimitSlop) * kLimitShare / s.dt, 0.0, kLimitSpeedMax);
    };
    if (below < reach)
        rows.push_back(bounded_row(dof, -target(below), s.compliance, 0.0, kInfinity, mend(below)));
    if (above < reach)
        rows.push_back(bounded_row(dof, target(above), s.compliance, -kInfinity, 0.0, -mend(above)));
    return std::min(below, above) < -kLimitSlop;
}

/// Springs or damping so stiff that the explicit Runge-Kutta step would not follow them; its limit is 2.8,
/// but the mobility is that of the zero pose. The solver takes them implicitly.
bool is_stiff(const Dof& dof, double dt) {
    constexpr double kRateMax = 0.25;  // a tick times the damping's rate or the spring's frequency
    const double damping = dt * dof.damping * dof.inverse_inertia;
    const double spring = dt * dt * dof.spring_stiffness * dof.inverse_inertia;
    return damping > kRateMax || spring > kRateMax * kRateMax;
}

bool near_limit(const Dof& dof, double q, double v, double dt) {
    const double reach = dt * std::fabs(v) + 0.05;
    return q - dof.lower < reach || dof.upper - q < reach;
}

/// True if the free directions of a loop joint are not all left to themselves.
bool needs_rows(const LoopJoint& loop, const RobotState& state) {
    for (std::size_t d = 0; d < loop.dofs.size(); ++d) {
        const Dof& dof = loop.dofs[d];
        if (state.motors[static_cast<std::size_t>(loop.motor_index) + d].mode != MotorMode::kPassive)
            return true;
        if (dof.friction > 0 || dof.damping > 0 || dof.spring_stiffness > 0) return true;
        if (std::isfinite(dof.lower) || std::isfinite(dof.upper)) return true;
    }
    return false;
}

}  // namespace

bool add_joint_rows(const Model& model, const RobotWork& robot, int offset, std::vector<JointRow>& rows) {
    const RobotType& type = *robot.type;
    const RobotState& state = *robot.state;
    bool mends = false;
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const Dof& dof = type.dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
        const double q =
            body.joint == JointKind::kBall ? 0.0 : state.q[static_cast<std::size_t>(body.q_index)];
        const DofState s{dof,        state.motors[d], q,
                         state.v[i], model.dt_s,      model.accuracy.compliance * dof.inverse_inertia};
        const int island_dof = offset + static_cast<int>(i);
        add_motor(s, island_dof, rows);
        if (dof.friction > 0)
            rows.push_back(bounded_row(island_dof, 0.0, s.compliance, -dof.friction * model.dt_s,
                                       dof.friction * model.dt_s, 0.0));
        if (body.joint != JointKind::kBall) mends |= add_limits(s, island_dof, rows);
    }
    return mends;
}

bool moves_freely(const Model& model, const RobotWork& robot) {
    const RobotType& type = *robot.type;
    const RobotState& state = *robot.state;
    for (const LoopJoint& loop : type.loops)
        if (needs_rows(loop, state)) return false;
    if (drag_is_stiff(model, robot)) return false;
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const Dof& dof = type.dofs[d];
        if (state.motors[d].mode != MotorMode::kPassive || dof.friction > 0 || is_stiff(dof, model.dt_s))
            return false;
        const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
        if (body.joint == JointKind::kBall) continue;
        const double v = state.v[d + static_cast<std::size_t>(type.base_nv())];
        if (near_limit(dof, state.q[static_cast<std::size_t>(body.q_index)], v, model.dt_s)) return false;
    }
    return true;
}

}  // namespace roboss
