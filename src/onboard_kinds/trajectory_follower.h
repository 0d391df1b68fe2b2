// TrajectoryFollower of Gazebo: pushes a link from waypoint to waypoint.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// A torque turns the link towards the waypoint, a force along its x axis pushes it there; never both at
/// once. Of waypoints, circle and line the first that is given counts.
struct TrajectoryFollowerSpec {
    LinkNames link;                 ///< one: that is pushed
    bool loop = false;              ///< after the last waypoint comes the first
    std::vector<double> waypoints;  ///< m: x, y of each, in the world
    double circle_radius = 0,       ///< m: 8 waypoints about where the link is at the start; 0: no circle
        line_direction = 0,         ///< rad, from the link's x axis at the start
        line_length = 0;            ///< m: from where the link is at the start to the end; 0: no line
    double range_tolerance = 0.5,   ///< m: nearer is there
        bearing_tolerance = 2,      ///< degrees: less is straight ahead
        force = 60,                 ///< N
        torque = 50;                ///< N m
    bool stops_turning = false;     ///< the turn stops at half the bearing tolerance
    std::string topic;              ///< of the command; empty: /model/NAME/trajectory_follower/pause

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 31,
                                       .name = "trajectory-follower",
                                       .phrase = "a trajectory follower",
                                       .classes = "TrajectoryFollower",
                                       .files = "trajectory-follower-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"loop", "loop"}, s.loop);
        visit({"waypoints", "waypoints/waypoint", "m"}, s.waypoints);
        visit({"circle_radius", "circle/radius", "m"}, s.circle_radius);
        visit({"line_direction", "line/direction", "rad"}, s.line_direction);
        visit({"line_length", "line/length", "m"}, s.line_length);
        visit({"range_tolerance", "range_tolerance", "m"}, s.range_tolerance);
        visit({"bearing_tolerance", "bearing_tolerance"}, s.bearing_tolerance);
        visit({"force", "force", "N"}, s.force);
        visit({"torque", "torque", "N m"}, s.torque);
        visit({"stops_turning", "zero_vel_on_bearing_reached"}, s.stops_turning);
        visit({"topic", "topic"}, s.topic);
    }
    /// The commands that it takes: 1 pauses it, 0 lets it go on.
    std::vector<Channel> channels() const {
        return {channel_of(topic, "trajectory_follower/pause", {{"pause", ""}})};
    }
    /// Number of waypoints.
    std::size_t count() const {
        if (!waypoints.empty()) return waypoints.size() / 2;
        if (circle_radius != 0) return 8;
        return line_length != 0 ? 2 : 0;
    }
    /// Places in its memory.
    enum Memory : std::size_t {
        kStarted = 0,  ///< 1: the start below is known
        kStart = 1,    ///< m: x, y of the link at the start
        kEnd = 3,      ///< m: x, y of the end of the line
        kGoal = 5,     ///< number of the waypoint that it goes to
        kIdle = 6,     ///< 1: paused, or at its last waypoint
        kMemorySize = 7
    };
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const { return m[kIdle] == 1; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (link.size() != 1) problems.push_back({"names no link", "Name one in <link_name>."});
        if (waypoints.size() % 2 != 0)
            problems.push_back({"has a waypoint that is not two numbers", "Write x and y of each."});
    }
    /// Compares all members.
    friend bool operator==(const TrajectoryFollowerSpec&, const TrajectoryFollowerSpec&) = default;
};

}  // namespace roboss
