// See contact_rows.h.
#include "physics/contact/contact_rows.h"

namespace roboss {

bool add_contact_row(const Model& model, const Contact& c, const SurfacePair& surface,
                     std::span<const RobotWork> robots, std::span<const int> offsets, IslandRows& rows) {
    const ContactSide<double> a = side_of(robots, offsets, c.robot_a, c.body_a);
    if (c.robot_b < 0) return add_contact_row<double>(model, c, surface, a, nullptr, rows);
    const ContactSide<double> b = side_of(robots, offsets, c.robot_b, c.body_b);
    return add_contact_row<double>(model, c, surface, a, &b, rows);
}

}  // namespace roboss
