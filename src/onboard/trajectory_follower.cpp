// See onboard_kinds/trajectory_follower.h.
#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

struct Point {
    double x = 0, y = 0;  // m, in the world
};

/// Notes where the link stands, once: circles and lines begin there.
void start(const TrajectoryFollowerSpec& spec, const Transform& X_WL, std::span<double> memory) {
    if (memory[TrajectoryFollowerSpec::kStarted] != 0) return;
    const SinCos direction = fixed_sincos(spec.line_direction);
    const Vec3 line = X_WL.R * Vec3{spec.line_length * direction.cos, spec.line_length * direction.sin, 0};
    memory[TrajectoryFollowerSpec::kStart] = X_WL.p.x, memory[TrajectoryFollowerSpec::kStart + 1] = X_WL.p.y;
    memory[TrajectoryFollowerSpec::kEnd] = X_WL.p.x + line.x,
    memory[TrajectoryFollowerSpec::kEnd + 1] = X_WL.p.y + line.y;
    memory[TrajectoryFollowerSpec::kStarted] = 1;
}

Point waypoint(const TrajectoryFollowerSpec& spec, std::span<const double> memory) {
    const auto k = static_cast<std::size_t>(memory[TrajectoryFollowerSpec::kGoal]);
    if (!spec.waypoints.empty()) return {spec.waypoints[2 * k], spec.waypoints[2 * k + 1]};
    const Point first{memory[TrajectoryFollowerSpec::kStart], memory[TrajectoryFollowerSpec::kStart + 1]};
    if (spec.circle_radius != 0) {
        const SinCos at = fixed_sincos(0.25 * kPi * static_cast<double>(k));
        return {first.x + spec.circle_radius * at.cos, first.y + spec.circle_radius * at.sin};
    }
    return k == 0 ? first
                  : Point{memory[TrajectoryFollowerSpec::kEnd], memory[TrajectoryFollowerSpec::kEnd + 1]};
}

/// The waypoint is reached: to the next one; false: it was the last.
bool advance(const TrajectoryFollowerSpec& spec, std::span<double> memory) {
    const auto count = static_cast<double>(spec.count());
    if (memory[TrajectoryFollowerSpec::kGoal] + 1 < count)
        memory[TrajectoryFollowerSpec::kGoal] += 1;
    else if (spec.loop && count > 1)
        memory[TrajectoryFollowerSpec::kGoal] = 0;
    else
        return false;
    return true;
}

void push(const TrajectoryFollowerSpec& spec, double bearing, const Transform& X_WL, OnboardContext& c) {
    const double degrees = bearing * (180.0 / kPi);
    if (std::fabs(degrees) > spec.bearing_tolerance) {
        c.push(c.link(0), {}, X_WL.R * Vec3{0, 0, std::copysign(spec.torque, bearing)});
        return;
    }
    c.push_at(c.link(0), X_WL.R * Vec3{spec.force, 0, 0}, X_WL.p);
    RobotState& state = c.state();
    if (spec.stops_turning && c.type().free_base && std::fabs(degrees) <= 0.5 * spec.bearing_tolerance)
        std::fill(state.v.begin(), state.v.begin() + 3, 0.0);
}

}  // namespace

void run(const TrajectoryFollowerSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    memory[TrajectoryFollowerSpec::kIdle] = 1;
    if (spec.count() == 0 || c.command(0)[0] != 0) return;
    const Transform X_WL = c.pose(c.link(0));
    start(spec, X_WL, memory);
    const Point goal = waypoint(spec, memory);
    // The goal in the link's axes, as if the link stood at height 0 like it.
    const Vec3 way = transpose_times(X_WL.R, Vec3{goal.x - X_WL.p.x, goal.y - X_WL.p.y, 0});
    const bool is_reached = norm(way) <= spec.range_tolerance;
    if (is_reached && !advance(spec, memory)) return;
    memory[TrajectoryFollowerSpec::kIdle] = 0;
    if (!is_reached) push(spec, fixed_atan2(way.y, way.x), X_WL, c);
}

}  // namespace roboss
