// <actor> of SDFormat: a kinematic body that follows waypoints through time, whatever stands in its way.
#pragma once

#include <string>
#include <vector>

#include "math/pose.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A pose on a trajectory of an actor.
struct ActorWaypoint {
    int trajectory = 0;  ///< that it belongs to; they are walked one after the other
    double time = 0,     ///< s; of a trajectory, the first one's time is its start
        tension = 0;     ///< 0..1 of its trajectory: 1 stops at each waypoint
    Pose pose;           ///< m, in the actor's frame at the start

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"trajectory", "trajectory"}, s.trajectory);
        visit({"time", "time", "s"}, s.time);
        visit({"tension", "tension"}, s.tension);
        visit({"pose", "pose"}, s.pose);
    }
    /// Compares all members.
    friend bool operator==(const ActorWaypoint&, const ActorWaypoint&) = default;
};

/// Where it is at a time: cubic splines through the positions, and through the orientations (as Gazebo's).
struct ActorSpec {
    bool loop = true;                      ///< starts again at the end; else it stays there
    double delay_start = 0;                ///< s, until it starts
    std::vector<ActorWaypoint> waypoints;  ///< by (trajectory, time); none: it stands still

    /// What this kind states about itself. No plugin has its names: SDF has an element for it.
    static constexpr OnboardKind kKind{
        .number = 42, .name = "actor", .phrase = "an actor", .classes = "", .files = ""};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"loop", "loop"}, s.loop);
        visit({"delay_start", "delay_start", "s"}, s.delay_start);
        visit({"waypoints", "waypoint"}, s.waypoints);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const { return {}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        for (std::size_t i = 1; i < waypoints.size(); ++i) {
            const ActorWaypoint &a = waypoints[i - 1], &b = waypoints[i];
            if (a.trajectory < b.trajectory || (a.trajectory == b.trajectory && a.time < b.time)) continue;
            problems.push_back({"has waypoints that do not follow each other in time",
                                "Give each waypoint of a trajectory a later time than the one before."});
            break;
        }
    }
    /// Compares all members.
    friend bool operator==(const ActorSpec&, const ActorSpec&) = default;
};

}  // namespace roboss
