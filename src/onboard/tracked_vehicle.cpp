// See onboard_kinds/tracked_vehicle.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/speed_limiter.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

constexpr double kSmall = 1e-6;  // m/s, rad/s: less is no speed, and no change, as in Gazebo
constexpr double kFar = 1e9;     // m: a centre of rotation that is none

/// Centre of rotation in the world, m: to the left of the body by speed / turn.
Vec3 centre_of_rotation(const TrackedVehicleSpec& spec, OnboardContext& c, double speed, double turn) {
    const LinkId body = spec.body.empty() ? c.info().base : c.link(c.link_count() - 1);
    const Transform X_WL = c.pose(body);
    const double radius = std::fabs(turn) < kSmall ? kFar : std::fabs(speed) < kSmall ? 0.0 : speed / turn;
    return X_WL.p + X_WL.R * Vec3{0, fixed_max(fixed_min(radius, kFar), -kFar), 0};
}

/// Whether a command came since it was asked last; notes that it was seen.
bool is_new(OnboardContext& c, std::size_t command, double& seen) {
    const auto at = static_cast<double>(c.commanded_at(command));
    const bool fresh = at > seen;
    seen = at;
    return fresh;
}

}  // namespace

void run(const TrackedVehicleSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    const std::span<const double> twist = c.command(0);
    const double last_speed = memory[TrackedVehicleSpec::kSpeed],
                 last_turn = memory[TrackedVehicleSpec::kTurnRate];
    const double speed =
        limit_speed(spec.linear, twist[Twist6::kLinearX], c.dt(), memory[TrackedVehicleSpec::kSpeed],
                    memory[TrackedVehicleSpec::kSpeed + 1]);
    const double turn =
        limit_speed(spec.angular, twist[Twist6::kAngularZ], c.dt(), memory[TrackedVehicleSpec::kTurnRate],
                    memory[TrackedVehicleSpec::kTurnRate + 1]);
    double efficiency = spec.steering_efficiency;
    if (c.is_commanded(1) && c.command(1)[0] > 0) efficiency = c.command(1)[0];
    const double across = 0.5 * turn * spec.tracks_separation / efficiency;
    const double left = speed - across, right = speed + across;
    // As in Gazebo, odometry believes the tracks' speeds and knows nothing of the steering efficiency.
    move_odometry(memory.first<5>(),
                  {0.5 * (left + right) * c.dt(), 0, (right - left) / spec.tracks_separation * c.dt()},
                  c.dt());
    const bool has_new_twist = is_new(c, 0, memory[TrackedVehicleSpec::kSeenCommand]);
    const bool has_new_efficiency = is_new(c, 1, memory[TrackedVehicleSpec::kSeenEfficiency]);
    const bool gives_speed = has_new_twist || has_new_efficiency || std::fabs(speed - last_speed) > kSmall ||
                             std::fabs(turn - last_turn) > kSmall;
    const bool gives_centre = gives_speed || (std::fabs(turn) >= kSmall && std::fabs(speed) >= kSmall);
    if (!gives_centre) return;
    const Vec3 centre = centre_of_rotation(spec, c, speed, turn);
    const double point[] = {centre.x, centre.y, centre.z};
    const std::size_t lefts = spec.left.size(), tracks = lefts + spec.right.size();
    for (std::size_t track = 0; track < tracks; ++track) {
        const double u = track < lefts ? left : right;
        if (gives_speed) c.give_command(2 * track, {&u, 1});
        c.give_command(2 * track + 1, point);
    }
}

}  // namespace roboss
