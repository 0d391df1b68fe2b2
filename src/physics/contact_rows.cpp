// A contact point becomes rows: Jacobian columns along both robots' paths, and targets for velocity and way.
#include <algorithm>
#include <cmath>
#include <limits>

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
bool set_impact(const Contact& c, double approach, double gravity_n, double dt, BoundedRow& row) {
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

/// Targets of the normal. The load of the last tick is where the row starts from (a proximal step): a contact
/// at rest carries it without any velocity, however compliant the row. True if velocity and way differ.
bool set_normal(const Contact& c, double approach, double gravity_n, double dt, double compliance,
                BoundedRow& row) {
    row.compliance = compliance;
    row.low = 0, row.high = std::numeric_limits<double>::infinity();
    if (set_impact(c, approach, gravity_n, dt, row)) return true;
    row.target = row.position_target = c.gap > 0 ? -c.gap / dt : 0.0;
    const bool mends = c.gap < -kSlop;
    if (mends) row.position_target = std::min(kMendShare * (-c.gap - kSlop) / dt, kMendSpeedMax);
    row.target += compliance * c.load;
    row.position_target += compliance * c.load;
    return mends;
}

}  // namespace

bool add_contact_row(const Model& model, const Contact& c, std::span<const RobotWork> robots,
                     std::span<const int> offsets, IslandRows& rows) {
    const RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
    const double dt = model.dt_s;
    Frame frame{c.normal, {}, {}};
    tangents(c.normal, frame.t1, frame.t2);
    ContactRow row;
    row.first = rows.columns.size();
    add_columns(a, c.body_a, offsets[static_cast<std::size_t>(c.robot_a)], 1.0, c.p_W, frame, rows.columns);
    double ease = mobility(a, c.body_a);
    double approach = -normal_velocity(a, c.body_a, c.p_W, c.normal);
    double gravity_n = gravity_along(model, a, c.body_a, c.normal);
    if (c.robot_b >= 0) {
        const RobotWork& b = robots[static_cast<std::size_t>(c.robot_b)];
        add_columns(b, c.body_b, offsets[static_cast<std::size_t>(c.robot_b)], -1.0, c.p_W, frame,
                    rows.columns);
        ease += mobility(b, c.body_b);
        approach += normal_velocity(b, c.body_b, c.p_W, c.normal);
        gravity_n -= gravity_along(model, b, c.body_b, c.normal);
    }
    row.last = rows.columns.size();
    const bool loaded = c.load > 0;
    const double compliance = ease * (loaded ? model.accuracy.contact_compliance : model.accuracy.compliance);
    const bool split = set_normal(c, approach, gravity_n, dt, compliance, row.normal);
    row.slip.coefficient = c.mu;
    row.slip.bound = c.mu * c.impulse;
    row.slip.compliance = compliance;
    if (loaded) {
        const double share = compliance * (c.load / c.impulse);
        row.slip.target_1 = share * dot(frame.t1, c.friction);
        row.slip.target_2 = share * dot(frame.t2, c.friction);
    }
    rows.contacts.push_back(row);
    return split;
}

}  // namespace roboss
