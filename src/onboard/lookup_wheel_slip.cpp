// See onboard_kinds/lookup_wheel_slip.h.
#include <algorithm>
#include <cmath>

#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr int kNeutral = 128;  // a sample that changes nothing

/// The WheelSlip of a link of the same robot; nullptr: it has none.
const SlipWheelSpec* slip_of(const RobotType& type, LinkId link) {
    for (const OnboardInfo& info : type.onboard)
        if (const auto* slip = std::get_if<WheelSlipSpec>(&info.spec.parameters))
            for (std::size_t k = 0; k < info.links.size(); ++k)
                if (info.links[k] == link) return &slip->wheels[k];
    return nullptr;
}

/// Coefficients of friction of the link's shapes, along the axle and across it.
Vec3 friction_of(const RobotType& type, LinkId link) {
    for (const BodyShape& shape : type.shapes)
        if (shape.link == link) return {shape.material.mu, shape.material.mu2, 0};
    return {1, 1, 0};
}

/// Pixel number of a distance from the map's edge; false: beyond the map.
bool pixel(double distance, double size, int count, int& at) {
    const double x = std::floor(distance * count / size + 0.5);
    if (!(x >= 0 && x < count)) return false;
    at = static_cast<int>(x);
    return true;
}

}  // namespace

void run(const LookupWheelSlipSpec& spec, OnboardContext& c) {
    for (std::size_t k = 0; k < c.link_count(); ++k) {
        const SlipWheelSpec* wheel = slip_of(c.type(), c.link(k));
        int column = 0, row = 0;
        const Vec3 p = c.pose(c.link(k)).p;
        if (wheel == nullptr || !pixel(p.x + 0.5 * spec.size_x, spec.size_x, spec.map.columns, column) ||
            !pixel(0.5 * spec.size_y - p.y, spec.size_y, spec.map.rows, row))
            continue;
        const std::uint32_t colour = spec.map.at(column, row);
        if (c.memory()[k] == colour) continue;
        c.memory()[k] = colour;
        const auto steps = [&](int shift) { return static_cast<int>(colour >> shift & 255u) - kNeutral; };
        const double slip[] = {std::max(0.0, wheel->lateral + steps(16) * spec.lateral_delta),
                               std::max(0.0, wheel->longitudinal + steps(8) * spec.longitudinal_delta)};
        c.give_command(2 * k + WheelSlipSpec::kCompliances, slip);
        const Vec3 mu = friction_of(c.type(), c.link(k));
        const double more = steps(0) * spec.friction_delta;
        const double friction[] = {more == 0 ? -1.0 : std::max(0.0, mu.x + more),
                                   more == 0 ? -1.0 : std::max(0.0, mu.y + more)};
        c.give_command(2 * k + WheelSlipSpec::kFriction, friction);
    }
}

}  // namespace roboss
