// See onboard_kinds/track_controller.h.
#include <algorithm>
#include <cmath>

#include "onboard/controllers.h"

namespace roboss {
namespace {

/// The speed that the limits allow: of jerk, of acceleration and of velocity, in this order.
double limited(const TrackControllerSpec& spec, double wanted, double before, double before_that, double dt) {
    const double rate = (before - before_that) / dt;
    double v = wanted;
    const double jerk = ((v - before) / dt - rate) / dt;
    if (jerk < spec.min_jerk || jerk > spec.max_jerk)
        v = before + (rate + std::clamp(jerk, spec.min_jerk, spec.max_jerk) * dt) * dt;
    const double acceleration = (v - before) / dt;
    if (acceleration < spec.min_acceleration || acceleration > spec.max_acceleration)
        v = before + std::clamp(acceleration, spec.min_acceleration, spec.max_acceleration) * dt;
    return std::clamp(v, spec.min_velocity, spec.max_velocity);
}

}  // namespace

void run(const TrackControllerSpec& spec, OnboardContext& c) {
    const double age = static_cast<double>(c.tick() - c.commanded_at(0)) * c.dt();
    const double wanted = c.is_commanded(0) && age <= spec.max_command_age ? c.command(0)[0] : 0.0;
    const std::span<double> memory = c.memory();
    const double speed = limited(spec, wanted, memory[TrackControllerSpec::kSpeed],
                                 memory[TrackControllerSpec::kSpeedBefore], c.dt());
    memory[TrackControllerSpec::kSpeedBefore] = memory[TrackControllerSpec::kSpeed];
    memory[TrackControllerSpec::kSpeed] = speed;
    memory[TrackControllerSpec::kWay] += speed * c.dt();
    const Vec3& rpy = spec.orientation;
    const Vec3 axis = rpy == Vec3{} ? Vec3{0, 1, 0} : to_matrix(from_rpy(rpy.x, rpy.y, rpy.z)).col(1);
    SurfaceMotion motion;
    motion.link = c.link(0);
    motion.belt_L = axis * speed;
    if (c.is_commanded(1)) {
        const std::span<const double> p = c.command(1);
        motion.centre_W = {p[0], p[1], p[2]};
        motion.turns =
            std::ranges::all_of(p, [](double x) { return std::fabs(x) < TrackControllerSpec::kStraight; });
    }
    c.move_surface(motion);
}

}  // namespace roboss
