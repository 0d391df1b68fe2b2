// Assignment of islands to Simulators: the dearest island first, each to the Simulator that would be done
// with it first (longest processing time, Graham 1969), by measured cost and measured speed; but an island
// stays where most of it is as long as that Simulator's share allows, because moving a robot costs a
// hand-off: of several allowances the one is taken with which all are done first. Simulators are told one
// after the other; who is told first can be given most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/islands.h"

namespace roboss {

inline constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;

struct AssignRequest {
    const Islands& islands;
    std::span<const float> robot_cost;  // by RobotId, any common unit, > 0
    std::span<const std::uint32_t>
        robot_place;                // by RobotId: index of the Simulator that has it, or kNowhere
    std::span<const double> speed;  // by Simulator index: work a second, relative; > 0
    double move = 0;                // how much later a Simulator is done that is sent an island
    double told_apart = 0;          // how much later a Simulator can begin than the one before it
};

/// For each island the index of its Simulator. `speed` must not be empty.
std::vector<std::uint32_t> assign(const AssignRequest& request);

}  // namespace roboss
