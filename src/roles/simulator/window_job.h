// Shared by the files of WindowStepper: one call of step(), and islands that are stepped together.
#pragma once

#include <algorithm>

#include "roles/simulator/window_stepper.h"

namespace roboss {

inline constexpr std::size_t kHeartbeatWork = 512;  // robots times ticks between two heartbeats
inline constexpr double kCounted_ns =
    1'200;  // for a unit of effort (step.h) where no time is measured: about a car's

/// Whether something is due after `ticks` ticks of `robots` robots that are stepped together.
inline bool is_due(std::size_t robots, Tick ticks, std::size_t each = kHeartbeatWork) {
    return ticks % static_cast<Tick>(std::max<std::size_t>(each / robots, 1)) == 0;
}

struct WindowStepper::Job {
    const Assignment& assignment;
    StateStore& store;
    const Between& between;
    WindowResult result;

    std::span<const RobotId> robots(std::size_t island) const {
        const std::size_t first = assignment.island_offsets[island];
        return std::span(assignment.robots).subspan(first, assignment.island_offsets[island + 1] - first);
    }
};

struct WindowStepper::LaneGroup {
    std::vector<std::uint32_t> islands;  // ascending, as their robots are
    std::vector<std::size_t> next;       // by island: its next order
    std::vector<RobotId> robots;
    std::vector<RobotState*> states;
    std::vector<Aabb> bounds;
    std::vector<Order> orders;  // of a tick
};

struct WindowStepper::Lockstep {
    std::span<const std::uint32_t> larger;  // islands of several robots
    bool lane_group_goes = false;           // of the others; false: it failed
    bool intact = true;                     // nothing has failed
};

}  // namespace roboss
