// See wheel_slip.h.
#include "physics/contact/wheel_slip.h"

#include <algorithm>
#include <cmath>

namespace roboss {
namespace {

/// A wheel at a contact.
struct Wheel {
    Vec3 axle;                             // unit, in the tangent plane; zero: it stands on that plane
    double lateral = 0, longitudinal = 0;  // m/s per N
    double mu = -1, mu2 = -1;              // along the axle and across it; negative: those of the materials
};

const OnboardInfo* slip_of(const RobotType& type, LinkId link) {
    for (const OnboardInfo& info : type.onboard)
        if (std::holds_alternative<WheelSlipSpec>(info.spec.parameters) && info.links.front() == link)
            return &info;
    return nullptr;
}

/// The last command, nullptr: there was none.
const double* command_of(const RobotWork& robot, const OnboardInfo& info, std::size_t k) {
    const ChannelInfo& channel = robot.type->channels[static_cast<std::size_t>(info.channels[k])];
    const double* at = robot.state->onboard.data() + channel.index;
    return at[0] >= 0 ? at + 1 : nullptr;
}

/// The wheel that the shape belongs to; nullopt: it is none that slips.
std::optional<Wheel> wheel_at(std::span<const RobotWork> robots, int robot, std::uint32_t shape,
                              const Vec3& normal) {
    if (robot < 0) return std::nullopt;
    const RobotWork& work = robots[static_cast<std::size_t>(robot)];
    if (!work.type->has_slip) return std::nullopt;
    const OnboardInfo* info = slip_of(*work.type, work.type->shapes[shape].link);
    if (info == nullptr) return std::nullopt;
    const SlipWheelSpec& spec = std::get<WheelSlipSpec>(info->spec.parameters).wheels.front();
    const auto dof = static_cast<std::size_t>(info->axes.front().v_index);
    const Vec3 axis = work.axes[dof].angular;
    const Vec3 along = axis - normal * dot(normal, axis);
    const double length = norm(along);
    Wheel wheel;
    if (length > 1e-6) wheel.axle = along * (1 / length);
    const double* compliances = command_of(work, *info, WheelSlipSpec::kCompliances);
    const double unit = spec.radius * std::fabs(work.state->v[dof]) / spec.normal_force;
    wheel.lateral = unit * std::max(0.0, compliances != nullptr ? compliances[0] : spec.lateral);
    wheel.longitudinal = unit * std::max(0.0, compliances != nullptr ? compliances[1] : spec.longitudinal);
    if (const double* mu = command_of(work, *info, WheelSlipSpec::kFriction))
        wheel.mu = mu[0], wheel.mu2 = mu[1];
    return wheel;
}

void replace_friction(const Wheel& wheel, const Vec3& normal, FrictionEllipse& friction) {
    if (wheel.mu < 0 || wheel.mu2 < 0) return;
    if (wheel.mu == wheel.mu2 || wheel.axle == Vec3{})
        friction = {wheel.mu2, {}, 1.0};
    else if (wheel.mu > wheel.mu2)
        friction = {wheel.mu, wheel.axle, wheel.mu2 / wheel.mu};
    else
        friction = {wheel.mu2, cross(normal, wheel.axle), wheel.mu / wheel.mu2};
}

/// In the frame of the friction, whose second tangent is shortened (contact_rows.h).
void add_compliance(const Wheel& wheel, const Vec3& normal, SurfacePair& pair) {
    if (wheel.lateral == 0 && wheel.longitudinal == 0) return;
    FrictionEllipse& friction = pair.friction;
    if (wheel.axle == Vec3{}) {  // every tangent is across it
        pair.slip_11 += wheel.longitudinal;
        pair.slip_22 += wheel.longitudinal * friction.across * friction.across;
        return;
    }
    if (friction.axis == Vec3{}) friction.axis = wheel.axle;
    const Vec3 t2 = cross(normal, friction.axis) * friction.across, forward = cross(normal, wheel.axle);
    const auto add = [&](double compliance, const Vec3& direction) {
        const double a = dot(direction, friction.axis), b = dot(direction, t2);
        pair.slip_11 += compliance * a * a, pair.slip_12 += compliance * a * b;
        pair.slip_22 += compliance * b * b;
    };
    add(wheel.lateral, wheel.axle), add(wheel.longitudinal, forward);
}

}  // namespace

void add_slip(std::span<const RobotWork> robots, const Contact& contact, SurfacePair& pair) {
    const auto slips = [&](int robot) {
        return robot >= 0 && robots[static_cast<std::size_t>(robot)].type->has_slip;
    };
    if (!slips(contact.robot_a) && !slips(contact.robot_b)) return;
    const auto a = wheel_at(robots, contact.robot_a, contact.shape_a, contact.normal);
    const auto b = wheel_at(robots, contact.robot_b, contact.shape_b, contact.normal);
    for (const auto& wheel : {a, b})
        if (wheel) replace_friction(*wheel, contact.normal, pair.friction);
    for (const auto& wheel : {a, b})
        if (wheel) add_compliance(*wheel, contact.normal, pair);
}

}  // namespace roboss
