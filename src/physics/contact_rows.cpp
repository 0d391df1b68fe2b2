// A contact point becomes rows: Jacobian columns along both robots' paths, and targets for velocity and way.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/rows.h"

namespace roboss {
namespace {

constexpr double kWeights = 10;  // a load that a contact may take up at once, in weights of what it moves

constexpr double kSticking = 0.99;  // of the friction bound; beyond, a contact is taken for sliding

constexpr double kSoftBlow = 10;  // m/s

constexpr double kMendShare = 0.3;  // of the penetration beyond the slop mended in one tick

/// Along `direction`, the velocity of point p of a free base per unit of its turning and moving.
void put_base_columns(const Vec3& direction, const Vec3& p, double* columns) {
    const Vec3 turning = cross(p, direction);
    columns[0] = turning.x, columns[1] = turning.y, columns[2] = turning.z;
    columns[3] = direction.x, columns[4] = direction.y, columns[5] = direction.z;
}

void add_columns(const RobotWork& robot, int body, int offset, double sign, const Vec3& p_W,
                 const ContactFrame& frame, ContactColumns& columns) {
    if (body < 0) return;
    const Vec3 p = p_W - robot.origin;
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    const auto last = static_cast<std::size_t>(info.v_index + info.nv - 1);
    const int* path = robot.type->paths.path(last);
    const std::size_t begin = columns.size(), length = robot.type->paths.length(last);
    columns.extend(length);
    const Spatial* axes = robot.axes.data();
    int* dof = columns.dof.data() + begin;
    double *n = columns.n.data() + begin, *t1 = columns.t1.data() + begin, *t2 = columns.t2.data() + begin;
    for (std::size_t k = 0; k < length; ++k) dof[k] = offset + path[k];
    std::size_t k = 0;
    if (robot.type->free_base) {
        k = 6;
        put_base_columns(frame.n * sign, p, n);
        put_base_columns(frame.t1 * sign, p, t1);
        put_base_columns(frame.t2 * sign, p, t2);
    }
    for (; k < length; ++k) {
        const Spatial& axis = axes[path[k]];
        const Vec3 u = (axis.linear + cross(axis.angular, p)) * sign;
        n[k] = dot(frame.n, u), t1[k] = dot(frame.t1, u), t2[k] = dot(frame.t2, u);
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

/// A spring and damper taken implicitly: force = stiffness * depth - damping * u with the depth and the
/// velocity at the end of the tick, never pulling. A gap is closed first, and damps for its share of the
/// tick. The spring counts as compressed no deeper than a body of mobility `ease` could have come by a blow
/// of kSoftBlow: shapes that start deep in each other are not shot apart. False if the contact is as hard as
/// rigid ones, of compliance `rigid`.
bool set_softness(const Contact& c, double dt, double ease, double rigid, BoundedRow& row) {
    if (c.stiffness <= 0) return false;
    const double compliance = 1.0 / (dt * dt * c.stiffness + dt * c.damping);
    if (compliance < rigid) return false;
    row.compliance = compliance;
    row.target = -c.gap / dt;
    if (c.gap <= 0) {
        const double depth = std::min(-c.gap, kSoftBlow / std::sqrt(c.stiffness * ease));
        row.target = depth * c.stiffness / (dt * c.stiffness + c.damping);
    }
    row.position_target = row.target;
    return true;
}

/// Targets of the normal. The load of the last tick is where the row starts from (a proximal step): a contact
/// at rest carries it without any velocity, however compliant the row. True if velocity and way differ.
bool set_normal(const Contact& c, double approach, double gravity_n, double dt, double compliance,
                BoundedRow& row) {
    row.compliance = compliance;
    if (set_impact(c, approach, gravity_n, dt, row)) return true;
    row.target = row.position_target = c.gap > 0 ? -c.gap / dt : 0.0;
    const bool mends = c.gap < -c.slop;
    if (mends) row.position_target = std::min(kMendShare * (-c.gap - c.slop) / dt, c.mend_speed);
    row.target += compliance * c.load;
    row.position_target += compliance * c.load;
    return mends;
}

/// Friction starts from that of the last tick, as the normal does; `share` makes velocities of its impulses.
void set_friction_targets(const Contact& c, const ContactFrame& frame, double share, FrictionDisc& slip) {
    slip.target_1 = share * dot(frame.t1, c.friction);
    slip.target_2 = share * dot(frame.t2, c.friction);
    if (c.mu_across == 1) return;
    const double short2 = c.mu_across * c.mu_across;
    slip.target_2 = short2 > 0 ? slip.target_2 / short2 : 0.0;
}

}  // namespace

void ContactColumns::merge(std::size_t first, std::size_t middle) {
    const auto for_each = [&](auto&& f) { f(dof), f(n), f(t1), f(t2); };
    const auto place = [](auto& x, std::size_t at) { return x.begin() + static_cast<std::ptrdiff_t>(at); };
    for (std::size_t c = middle; c < size();) {
        const auto found = std::lower_bound(place(dof, first), place(dof, middle), dof[c]);
        const auto k = static_cast<std::size_t>(found - dof.begin());
        if (k < middle && dof[k] == dof[c]) {
            n[k] += n[c], t1[k] += t1[c], t2[k] += t2[c];
            for_each([&](auto& x) { std::copy(place(x, c + 1), place(x, count_), place(x, c)); });
            --count_;
        } else {
            for_each([&](auto& x) { std::rotate(place(x, k), place(x, c), place(x, c + 1)); });
            ++middle, ++c;
        }
    }
}

ContactFrame frame_of(const Contact& c) {
    ContactFrame frame{c.normal, {}, {}};
    if (c.friction_axis == Vec3{}) {
        tangents(c.normal, frame.t1, frame.t2);
    } else {
        frame.t1 = c.friction_axis;
        frame.t2 = cross(c.normal, c.friction_axis) * c.mu_across;
    }
    return frame;
}

bool add_contact_row(const Model& model, const Contact& c, std::span<const RobotWork> robots,
                     std::span<const int> offsets, IslandRows& rows) {
    const RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
    const double dt = model.dt_s;
    const ContactFrame frame = frame_of(c);
    ContactRow& row = rows.contacts.emplace_back();
    row.first = rows.columns.size();
    add_columns(a, c.body_a, offsets[static_cast<std::size_t>(c.robot_a)], 1.0, c.p_W, frame, rows.columns);
    const std::size_t middle = rows.columns.size();
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
    if (c.robot_b == c.robot_a) rows.columns.merge(row.first, middle);
    row.last = rows.columns.size();
    const bool loaded = c.load > 0;
    const double compliance = ease * (loaded ? model.accuracy.contact_compliance : model.accuracy.compliance);
    row.normal.low = 0, row.normal.high = std::numeric_limits<double>::infinity();
    row.soft = set_softness(c, dt, ease, ease * model.accuracy.compliance, row.normal);
    const bool split = !row.soft && set_normal(c, approach, gravity_n, dt, compliance, row.normal);
    row.slip.coefficient = c.mu;
    row.slip.bound = c.mu * c.impulse;
    row.slip.compliance = compliance;
    row.ease = ease;
    row.load_max = std::max(4 * c.load, kWeights * norm(model.gravity) * dt / ease);
    if (loaded) {
        set_friction_targets(c, frame, compliance * (c.load / c.impulse), row.slip);
        const double t1 = row.slip.target_1, t2 = row.slip.target_2,
                     end = kSticking * compliance * c.mu * c.load;
        row.sticks = t1 * t1 + t2 * t2 < end * end;
    }
    return split;
}

}  // namespace roboss
