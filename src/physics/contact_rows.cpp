// A contact point becomes rows: Jacobian columns along both robots' paths, and targets for velocity and way.
#include <algorithm>
#include <cmath>

#include "physics/rows.h"

namespace roboss {
namespace {

constexpr double kSlop = 1e-5;      // m, penetration that is left alone
constexpr double kMendShare = 0.3;  // of the penetration beyond it mended in one tick
constexpr double kMendSpeedMax =
    2.0;  // m/s, while mending; it never enters the velocity, so it adds no energy

struct Frame {
    Vec3 n, t1, t2;
};

void add_columns(const RobotWork& robot, int body, int offset, double sign, const Vec3& p_W,
                 const Frame& frame, std::vector<ContactColumn>& columns) {
    if (body < 0) return;
    const Vec3 p = p_W - robot.origin;
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    for (int i = info.v_index + info.nv - 1; i >= 0;
         i = robot.type->dof_parent[static_cast<std::size_t>(i)]) {
        const Spatial& axis = robot.axes[static_cast<std::size_t>(i)];
        const Vec3 u = (axis.linear + cross(axis.angular, p)) * sign;
        columns.push_back({offset + i, dot(frame.n, u), dot(frame.t1, u), dot(frame.t2, u)});
    }
}

double mobility(const RobotWork& robot, int body) {
    return body < 0 ? 0.0 : robot.type->bodies[static_cast<std::size_t>(body)].inverse_mass_linear;
}

/// Gravity along the normal as the body feels it.
double gravity_along(const Model& model, const RobotWork& robot, int body, const Vec3& n) {
    if (body < 0) return 0.0;
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    return info.mass > 0 ? dot(model.gravity, n) * (info.gravity_mass / info.mass) : 0.0;
}

/// Normal velocity before the step, from the states' velocities.
double normal_velocity(const RobotWork& robot, int body, const Vec3& p_W, const Vec3& n) {
    if (body < 0) return 0.0;
    const Spatial& v = robot.bodies[static_cast<std::size_t>(body)].velocity;
    return dot(n, v.linear + cross(v.angular, p_W - robot.origin));
}

/// An impact inside the tick: flies `to_hit` seconds, bounces, flies the rest; gravity counted in both parts.
bool set_impact(const Contact& c, double approach, double gravity_n, double dt, ContactRow& row) {
    if (c.restitution <= 0 || approach <= 0) return false;
    const double to_hit = c.gap > 0 ? c.gap / approach : 0.0;
    if (to_hit > dt) return false;
    const double impact = approach - gravity_n * to_hit;
    if (impact <= c.bounce_threshold) return false;
    const double rest = dt - to_hit;
    const double away = c.restitution * impact;
    row.target = away + gravity_n * rest;
    const double gap_after = away * rest + 0.5 * gravity_n * rest * rest;
    row.position_target = (gap_after - std::max(c.gap, 0.0)) / dt;
    return row.target > 0;
}

}  // namespace

bool add_contact_row(const Model& model, const Contact& c, std::span<const RobotWork> robots,
                     std::span<const int> offsets, std::vector<ContactColumn>& columns,
                     std::vector<ContactRow>& rows) {
    const RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
    const double dt = model.dt_s;
    Frame frame{c.normal, {}, {}};
    tangents(c.normal, frame.t1, frame.t2);
    ContactRow row;
    row.first = columns.size();
    add_columns(a, c.body_a, offsets[static_cast<std::size_t>(c.robot_a)], 1.0, c.p_W, frame, columns);
    double ease = mobility(a, c.body_a);
    double approach = -normal_velocity(a, c.body_a, c.p_W, c.normal);
    double gravity_n = gravity_along(model, a, c.body_a, c.normal);
    if (c.robot_b >= 0) {
        const RobotWork& b = robots[static_cast<std::size_t>(c.robot_b)];
        add_columns(b, c.body_b, offsets[static_cast<std::size_t>(c.robot_b)], -1.0, c.p_W, frame, columns);
        ease += mobility(b, c.body_b);
        approach += normal_velocity(b, c.body_b, c.p_W, c.normal);
        gravity_n -= gravity_along(model, b, c.body_b, c.normal);
    }
    row.last = columns.size();
    row.mu = c.mu;
    row.bound = c.mu * c.impulse;
    row.impulse_n = c.impulse;
    row.compliance_n = row.compliance_t = model.accuracy.compliance * ease;
    bool split = set_impact(c, approach, gravity_n, dt, row);
    if (!split) {
        row.target = row.position_target = c.gap > 0 ? -c.gap / dt : 0.0;
        if (c.gap < -kSlop) {
            row.position_target = std::min(kMendShare * (-c.gap - kSlop) / dt, kMendSpeedMax);
            split = true;
        }
    }
    rows.push_back(row);
    return split;
}

}  // namespace roboss
