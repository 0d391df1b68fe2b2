// See onboard_kinds/actor.h. The splines are those of Gazebo: positions by cubic Hermite curves whose
// tangents are half the chords between the neighbours, whatever the times are; orientations by squad
// (Shoemake, Animating rotation with quaternion curves, 1985).
#include <algorithm>
#include <cmath>

#include "onboard/controllers.h"

namespace roboss {
namespace {

using Waypoints = std::span<const ActorWaypoint>;

/// The waypoints of each trajectory in turn, until visit returns true.
template <class Visit>
void for_each_trajectory(Waypoints all, Visit&& visit) {
    for (std::size_t first = 0; first < all.size();) {
        std::size_t last = first + 1;
        while (last < all.size() && all[last].trajectory == all[first].trajectory) ++last;
        if (visit(all.subspan(first, last - first))) return;
        first = last;
    }
}

double duration_of(Waypoints points) {
    return points.back().time - points.front().time;
}

/// Where it is in its script.
struct Place {
    Waypoints points;  // of the trajectory
    double time = 0;   // s, since its start
};

Place place_at(const ActorSpec& spec, double time) {
    double total = 0;
    for_each_trajectory(spec.waypoints, [&](Waypoints points) {
        total += duration_of(points);
        return false;
    });
    if (spec.loop && total > 0) time -= std::floor(time / total) * total;
    Place place;
    for_each_trajectory(spec.waypoints, [&](Waypoints points) {
        const double duration = duration_of(points);
        const bool is_last = points.data() + points.size() == spec.waypoints.data() + spec.waypoints.size();
        place = {points, std::clamp(time, 0.0, duration)};
        if (time < duration || is_last) return true;
        time -= duration;
        return false;
    });
    return place;
}

bool is_closed(Waypoints points) {
    return points.size() > 2 && points.front().pose.p == points.back().pose.p;
}

/// The neighbours of point i for the slope there: at the ends of an open curve the point itself.
std::pair<std::size_t, std::size_t> neighbours_of(std::size_t i, std::size_t count, bool closed) {
    const std::size_t last = count - 1;
    if (i == 0) return {closed ? last - 1 : 0, std::min<std::size_t>(1, last)};
    if (i == last) return {last - 1, closed ? 1 : last};
    return {i - 1, i + 1};
}

Vec3 tangent_at(Waypoints points, std::size_t i) {
    const auto [before, after] = neighbours_of(i, points.size(), is_closed(points));
    const double tension = std::clamp(points.front().tension, 0.0, 1.0);
    return (points[after].pose.p - points[before].pose.p) * (0.5 * (1.0 - tension));
}

Quat slerp(const Quat& a, const Quat& b, double u) {
    return a * exponential(logarithm(conjugate(a) * b) * u);
}

Quat control_at(Waypoints points, std::size_t i) {
    const bool closed = points.size() > 2 && points.front().pose.q == points.back().pose.q;
    const auto [before, after] = neighbours_of(i, points.size(), closed);
    const Quat& q = points[i].pose.q;
    const Quat back = conjugate(q);
    const Vec3 bend = logarithm(back * points[after].pose.q) + logarithm(back * points[before].pose.q);
    return q * exponential(bend * -0.25);
}

Pose pose_on(Waypoints points, std::size_t i, double u) {
    const ActorWaypoint &a = points[i], &b = points[i + 1];
    const double u2 = u * u, u3 = u2 * u;
    const Vec3 p = a.pose.p * (2 * u3 - 3 * u2 + 1) + tangent_at(points, i) * (u3 - 2 * u2 + u) +
                   b.pose.p * (3 * u2 - 2 * u3) + tangent_at(points, i + 1) * (u3 - u2);
    const Quat q = slerp(slerp(a.pose.q, b.pose.q, u),
                         slerp(control_at(points, i), control_at(points, i + 1), u), 2 * u * (1 - u));
    return {p, normalized(q)};
}

Pose pose_at(const Place& place) {
    const Waypoints points = place.points;
    const double time = points.front().time + place.time;
    std::size_t i = 0;
    while (i + 2 < points.size() && points[i + 1].time <= time) ++i;
    if (points.size() < 2) return points[0].pose;
    const double span = points[i + 1].time - points[i].time;
    return pose_on(points, i, std::clamp((time - points[i].time) / span, 0.0, 1.0));
}

/// Whether the way from one place to the other jumps: at the end of a trajectory that ends elsewhere.
bool jumps(const Place& from, const Place& to) {
    const bool stays = from.points.data() == to.points.data() && from.time <= to.time;
    return !stays && from.points.back().pose.p != to.points.front().pose.p;
}

/// Whether it follows a model in place of its script.
bool follows(const RobotType& type) {
    return std::ranges::any_of(type.onboard, [](const OnboardInfo& info) {
        return std::holds_alternative<FollowActorSpec>(info.spec.parameters);
    });
}

}  // namespace

void run(const ActorSpec& spec, OnboardContext& c) {
    if (!c.type().kinematic || spec.waypoints.empty() || follows(c.type())) return;
    const double time = c.time() - spec.delay_start;
    const Place now = place_at(spec, std::max(time, 0.0));
    const Place next = place_at(spec, std::max(time + c.dt(), 0.0));
    const Pose& X_WA = c.model().robots[c.robot().index()].X_WR;
    const Pose X = X_WA * pose_at(now), X_next = X_WA * pose_at(next);
    set_base_pose(c.state(), {X.p, normalized(X.q)});
    const bool stands =
        time + c.dt() <= 0 || (now.points.data() == next.points.data() && now.time == next.time);
    if (stands) return c.state().surfaces.clear();
    // It counts as moving all the time, so that nothing falls asleep at what may be gone in the next tick.
    if (jumps(now, next)) return c.move_base({}, {});
    const double rate = 1.0 / c.dt();
    c.move_base(logarithm(X_next.q * conjugate(X.q)) * rate, (X_next.p - X.p) * rate);
}

}  // namespace roboss
