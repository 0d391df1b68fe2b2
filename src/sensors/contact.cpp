// The contact sensor: the contact points of its link, or of some of its collisions, in the tick that begins
// at the observed states, which the probe steps.
#include <algorithm>

#include "physics/probe.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

void append(const Vec3& v, std::vector<double>& list) {
    list.insert(list.end(), {v.x, v.y, v.z});
}

/// Whether the sensor feels a shape of its link.
class FeltShapes {
  public:
    FeltShapes(const ContactSpec& sensor, const SensorQuery& query) : sensor_(sensor), query_(query) {}

    bool has(std::uint32_t shape) const {
        return has_nth_of(query_.type().shapes, shape,
                          [&](const BodyShape& s) { return s.link == query_.info().link; });
    }
    bool has_scenery(std::uint32_t shape) const {
        return has_nth_of(query_.model.statics, shape, [&](const StaticShape& s) {
            return s.robot == query_.robot && s.link == query_.info().link;
        });
    }

  private:
    template <class Shapes, class OfLink>
    bool has_nth_of(const Shapes& shapes, std::uint32_t shape, OfLink&& is_of_link) const {
        if (sensor_.shapes.empty()) return true;
        const auto number = std::count_if(shapes.begin(), shapes.begin() + shape, is_of_link);
        return std::ranges::binary_search(sensor_.shapes, static_cast<double>(number));
    }

    const ContactSpec& sensor_;
    const SensorQuery& query_;
};

/// Whether side B of the contact is the sensor's link: of a robot, or of a static model that carries sensors.
bool is_other_side(const SensorQuery& query, const FeltShapes& felt, const ContactReport& c) {
    if (c.robot_b.valid())
        return c.robot_b == query.robot && c.link_b == query.info().link && felt.has(c.shape_b);
    const StaticShape& scenery = query.model.statics[c.scenery];
    return scenery.robot == query.robot && scenery.link == query.info().link && felt.has_scenery(c.scenery);
}

}  // namespace

Result<ContactReading> read(const ContactSpec& sensor, const SensorQuery& query) {
    const FeltShapes felt(sensor, query);
    const LinkId link = query.info().link;
    ContactReading reading;
    for (const ContactReport& c : query.sources.step_probe().contacts()) {
        const bool is_a = c.robot_a == query.robot && c.link_a == link && felt.has(c.shape_a);
        const bool is_b = !is_a && is_other_side(query, felt, c);
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
