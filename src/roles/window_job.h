// What the files of WindowStepper share: one call of step(), and islands that go together.
#pragma once

#include <algorithm>

#include "roles/window_stepper.h"

namespace roboss {

inline constexpr std::size_t kSignOfLife = 512;  // robots times ticks, after which there is a sign of life
inline constexpr double kCounted_ns =
    1'200;  // for an effort (step.h) where no time is measured: a car's, about

/// Whether, of so many robots stepped together, something is due after so many ticks.
inline bool is_due(std::size_t robots, Tick ticks, std::size_t each = kSignOfLife) {
    return ticks % static_cast<Tick>(std::max<std::size_t>(each / robots, 1)) == 0;
}

struct WindowStepper::Job {
    const Plan& plan;
    StateStore& store;
    const Between& between;
    Frame frame;

    std::span<const RobotId> robots(std::size_t island) const {
        const std::size_t first = plan.island_offsets[island];
        return std::span(plan.robots).subspan(first, plan.island_offsets[island + 1] - first);
    }
};

struct WindowStepper::Convoy {
    std::vector<std::uint32_t> islands;  // ascending, as their robots are
    std::vector<std::size_t> next;       // by island: its next order
    std::vector<RobotId> robots;
    std::vector<RobotState*> states;
    std::vector<Aabb> bounds;
    std::vector<Order> orders;  // of a tick
};

struct WindowStepper::Abreast {
    std::span<const std::uint32_t> larger;  // islands of several robots
    bool convoy_goes = false;               // of the others
    bool intact = true;                     // nothing has failed
};

}  // namespace roboss
