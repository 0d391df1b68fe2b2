// Torsional and rolling friction of a contact point become a row: relative angular velocity about the normal
// and the tangents, with moments bounded by levers times the point's normal impulse.
#include "physics/contact_rows.h"

namespace roboss {
namespace {

void add_columns(const RobotWork& robot, int body, int offset, double sign, const ContactFrame& frame,
                 ContactColumns& columns) {
    if (body < 0) return;
    const Body& info = robot.type->bodies[static_cast<std::size_t>(body)];
    const auto last = static_cast<std::size_t>(info.v_index + info.nv - 1);
    const int* path = robot.type->paths.path(last);
    const std::size_t begin = columns.size(), length = robot.type->paths.length(last);
    columns.extend(length);
    const Spatial* axes = robot.axes.data();
    int* dof = columns.dof.data() + begin;
    double *n = columns.n.data() + begin, *t1 = columns.t1.data() + begin, *t2 = columns.t2.data() + begin;
    for (std::size_t k = 0; k < length; ++k) {
        const Vec3 w = axes[path[k]].angular * sign;
        dof[k] = offset + path[k];
        n[k] = dot(frame.n, w), t1[k] = dot(frame.t1, w), t2[k] = dot(frame.t2, w);
    }
}

double mobility(const RobotWork& robot, int body) {
    return body < 0 ? 0.0 : robot.type->bodies[static_cast<std::size_t>(body)].inverse_inertia_angular;
}

}  // namespace

void add_angular_row(const Model& model, const Contact& c, std::span<const RobotWork> robots,
                     std::span<const int> offsets, IslandRows& rows) {
    if (c.torsional <= 0 && c.rolling <= 0) return;
    ContactFrame frame{c.normal, {}, {}};
    tangents(c.normal, frame.t1, frame.t2);
    AngularRow row;
    row.contact = rows.contacts.size() - 1;
    row.first = rows.columns.size();
    const RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
    add_columns(a, c.body_a, offsets[static_cast<std::size_t>(c.robot_a)], 1.0, frame, rows.columns);
    const std::size_t middle = rows.columns.size();
    double ease = mobility(a, c.body_a);
    if (c.robot_b >= 0) {
        const RobotWork& b = robots[static_cast<std::size_t>(c.robot_b)];
        add_columns(b, c.body_b, offsets[static_cast<std::size_t>(c.robot_b)], -1.0, frame, rows.columns);
        ease += mobility(b, c.body_b);
    }
    if (c.robot_b == c.robot_a) rows.columns.merge(row.first, middle);
    row.last = rows.columns.size();
    row.torsional = c.torsional;
    row.spin.compliance = row.roll.compliance = model.accuracy.compliance * ease;
    row.spin.high = c.torsional * c.impulse;
    row.spin.low = -row.spin.high;
    row.roll.coefficient = c.rolling;
    row.roll.bound = c.rolling * c.impulse;
    rows.angulars.push_back(row);
}

}  // namespace roboss
