// See trajectory.h.
#include "ros2/trajectory.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace roboss::ros2 {

namespace {

constexpr std::size_t kMostPoints = 100'000;

Error wrong(const std::string& what, const char* code = "bad-points") {
    return {what, "correct the trajectory", code};
}

/// True if there are none, or one finite number for each joint.
bool is_fine(const std::vector<double>& values, std::size_t joints) {
    return values.empty() || (values.size() == joints &&
                              std::ranges::all_of(values, [](double v) { return std::isfinite(v); }));
}

/// Between two points, `s` in 0 to 1, T: the time between them, s.
JointPoint between(const JointPoint& a, const JointPoint& b, int order, double s, double T) {
    const double x0 = a.position, x1 = b.position, v0 = a.velocity * T, v1 = b.velocity * T;
    if (order == 0) return {x0 + (x1 - x0) * s, (x1 - x0) / T, 0};
    // x(s) = c0 + c1 s + c2 s^2 + ...; of a cubic spline the last two are 0.
    double c2 = 3 * (x1 - x0) - 2 * v0 - v1, c3 = 2 * (x0 - x1) + v0 + v1, c4 = 0, c5 = 0;
    if (order == 2) {
        const double a0 = a.acceleration * T * T, a1 = b.acceleration * T * T, d = x1 - x0;
        c2 = a0 / 2;
        c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
        c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
        c5 = 6 * d - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1;
    }
    return {((((c5 * s + c4) * s + c3) * s + c2) * s + v0) * s + x0,
            ((((5 * c5 * s + 4 * c4) * s + 3 * c3) * s + 2 * c2) * s + v0) / T,
            (((20 * c5 * s + 12 * c4) * s + 6 * c3) * s + 2 * c2) / (T * T)};
}

}  // namespace

double seconds_of(const Duration& duration) {
    return duration.sec + 1e-9 * duration.nanosec;
}

Duration duration_of(double seconds) {
    const double whole = std::floor(seconds);
    return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>((seconds - whole) * 1e9)};
}

Result<Trajectory> Trajectory::of(const JointTrajectory& message, const std::vector<JointPoint>& start) {
    const std::size_t joints = message.joint_names.size();
    const std::set<std::string> names(message.joint_names.begin(), message.joint_names.end());
    if (joints == 0 || names.size() != joints)
        return wrong("the trajectory names no joints, or one twice", "bad-joints");
    if (message.points.empty() || message.points.size() > kMostPoints)
        return wrong("the trajectory has no points, or too many");
    Trajectory trajectory;
    trajectory.points_.push_back({0, start, 2});
    for (const JointTrajectoryPoint& from : message.points) {
        const std::string number = "point " + std::to_string(trajectory.points_.size() - 1);
        if (from.positions.empty() || !is_fine(from.positions, joints) || !is_fine(from.velocities, joints) ||
            !is_fine(from.accelerations, joints) || !is_fine(from.effort, joints))
            return wrong(number +
                         " does not have a finite position for each joint, or other values than one "
                         "for each joint");
        const double time_s = seconds_of(from.time_from_start);
        const bool is_first = trajectory.points_.size() == 1;
        const double before_s = trajectory.points_.back().time_s;
        if (time_s < 0 || (is_first ? time_s < before_s : time_s <= before_s))
            return wrong(number + " is not later than the one before it");
        Point point{time_s, {}, from.velocities.empty() ? 0 : from.accelerations.empty() ? 1 : 2};
        for (std::size_t j = 0; j < joints; ++j)
            point.joints.push_back({from.positions[j], point.order >= 1 ? from.velocities[j] : 0,
                                    point.order >= 2 ? from.accelerations[j] : 0});
        trajectory.points_.push_back(std::move(point));
    }
    // A trajectory that ends with a velocity would move on.
    if (std::ranges::any_of(trajectory.points_.back().joints,
                            [](const JointPoint& j) { return j.velocity != 0; }))
        return wrong("the velocities of the last point are not zero");
    return trajectory;
}

std::size_t Trajectory::next(double time_s) const {
    const auto later = std::upper_bound(points_.begin() + 1, points_.end(), time_s,
                                        [](double t, const Point& p) { return t < p.time_s; });
    return std::min(static_cast<std::size_t>(later - points_.begin()), points_.size() - 1) - 1;
}

std::vector<JointPoint> Trajectory::at(double time_s) const {
    if (time_s >= duration_s()) {
        std::vector<JointPoint> end = points_.back().joints;
        for (JointPoint& joint : end) joint.velocity = joint.acceleration = 0;
        return end;
    }
    const Point& b = points_[next(time_s) + 1];
    const Point& a = *(&b - 1);
    const double T = b.time_s - a.time_s;
    if (time_s <= a.time_s || T <= 0) return time_s <= a.time_s ? a.joints : b.joints;
    std::vector<JointPoint> now;
    for (std::size_t j = 0; j < a.joints.size(); ++j)
        now.push_back(
            between(a.joints[j], b.joints[j], std::min(a.order, b.order), (time_s - a.time_s) / T, T));
    return now;
}

}  // namespace roboss::ros2
