// Torsional and rolling friction of a contact point become a row: relative angular velocity about the normal
// and the tangents, with moments bounded by levers times the point's normal impulse.
#include "physics/contact/contact_rows.h"

namespace roboss {
namespace {

void add_columns(const ContactSide<double>& side, double sign, const ContactFrame& frame,
                 ContactColumns& columns) {
    if (side.info() == nullptr) return;
    const auto [path, length, n, t1, t2] = contact::add_path(side, columns);
    for (std::size_t k = 0; k < length; ++k) {
        const Vec3 w = side.robot->axes[static_cast<std::size_t>(path[k])].angular * sign;
        n[k] = dot(frame.n, w), t1[k] = dot(frame.t1, w), t2[k] = dot(frame.t2, w);
    }
}

double mobility(const ContactSide<double>& side) {
    const Body* info = side.info();
    return info == nullptr ? 0.0 : info->inverse_inertia_angular;
}

}  // namespace

void add_angular_row(const Model& model, const Contact& c, const SurfacePair& surface,
                     std::span<const RobotWork> robots, std::span<const int> offsets, IslandRows& rows) {
    if (surface.torsional <= 0 && surface.rolling <= 0) return;
    const ContactSide<double> a = side_of(robots, offsets, c.robot_a, c.body_a);
    const ContactSide<double> b =
        c.robot_b >= 0 ? side_of(robots, offsets, c.robot_b, c.body_b) : ContactSide<double>{};
    const double inverse_effective_mass = mobility(a) + mobility(b);
    if (inverse_effective_mass <= 0) return;  // on slides alone, neither body can turn
    ContactFrame frame{c.normal, {}, {}};
    tangents(c.normal, frame.t1, frame.t2);
    AngularRow row;
    row.contact = rows.contacts.size() - 1;
    row.first = rows.columns.size();
    add_columns(a, 1.0, frame, rows.columns);
    const std::size_t middle = rows.columns.size();
    add_columns(b, -1.0, frame, rows.columns);
    if (c.robot_b == c.robot_a) rows.columns.merge(row.first, middle);
    row.last = rows.columns.size();
    row.torsional = surface.torsional;
    row.spin.compliance = row.roll.compliance = model.accuracy.compliance * inverse_effective_mass;
    row.spin.high = surface.torsional * c.impulse;
    row.spin.low = -row.spin.high;
    row.roll.coefficient = surface.rolling;
    row.roll.bound = surface.rolling * c.impulse;
    // Turning about the normal counts; where a surface runs on, only its body can roll against it.
    row.spin.target = row.spin.position_target = -dot(frame.n, surface.turning);
    rows.angulars.push_back(row);
}

}  // namespace roboss
