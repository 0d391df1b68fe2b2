// Assignment of islands to Simulators: the most expensive island first, each to the Simulator that would
// finish it first (longest processing time, Graham 1969), by measured costs and speeds. But an island stays
// where most of it is as long as that Simulator's share allows, because moving a robot costs a hand-off: of
// several allowances the one with the earliest end is taken. Assignments are sent one after the other, so the
// first Simulator can get most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "schedule/islands.h"

namespace roboss {

inline constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;

struct AssignRequest {
    const Islands& islands;
    std::span<const float> robot_cost;  // by RobotId, any common unit, > 0
    std::span<const std::uint32_t>
        simulator_of_robot;         // by RobotId: index of the Simulator that has it, or kNowhere
    std::span<const double> speed;  // by Simulator index: work per second, relative; > 0
    double move = 0;                // how much later a Simulator that has to fetch an island is done
    double send_interval = 0;       // how much later a Simulator can begin than the one before it
};

/// For each island the index of its Simulator. `speed` must not be empty.
std::vector<std::uint32_t> assign(const AssignRequest& request);

}  // namespace roboss
