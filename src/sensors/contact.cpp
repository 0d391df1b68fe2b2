// The contact sensor: the contact points of its link in the tick that begins at the observed states, which
// the probe steps.
#include "physics/probe.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

void append(const Vec3& v, std::vector<double>& list) {
    list.insert(list.end(), {v.x, v.y, v.z});
}

/// Whether side B of the contact is the sensor's link: of a robot, or of a static model that carries sensors.
bool is_other_side(const SensorQuery& query, const ContactReport& c) {
    if (c.robot_b.valid()) return c.robot_b == query.robot && c.link_b == query.info().link;
    const StaticShape& scenery = query.model.statics[c.scenery];
    return scenery.robot == query.robot && scenery.link == query.info().link;
}

}  // namespace

Result<ContactReading> read(const ContactSpec&, const SensorQuery& query) {
    const LinkId link = query.info().link;
    ContactReading reading;
    for (const ContactReport& c : query.sources.step_probe().contacts()) {
        const bool is_a = c.robot_a == query.robot && c.link_a == link;
        const bool is_b = !is_a && is_other_side(query, c);
        if (!is_a && !is_b) continue;
        const double sign = is_a ? 1.0 : -1.0;
        const RobotId other = is_a ? c.robot_b : c.robot_a;  // not valid: scenery
        append(is_a ? c.p_W : c.p_W + c.shift_b, reading.positions);
        append(c.normal * sign, reading.normals);
        append((c.normal * c.impulse + c.friction) * (sign / query.model.dt_s), reading.forces);
        reading.others.push_back(other.valid() ? static_cast<double>(other.value) : -1.0);
    }
    return reading;
}

}  // namespace roboss
