// Longest processing time first, with a preference for staying.
#include "plan/assign.h"

#include <algorithm>
#include <numeric>

#include "core/check.h"

namespace roboss {

namespace {

/// Where most of the island's cost is now, or kNowhere.
std::uint32_t home_of(const AssignRequest& r, std::size_t island, std::vector<double>& weight) {
    std::uint32_t home = kNowhere;
    for (const RobotId robot : r.islands.of(island)) {
        const std::uint32_t place = r.robot_place[robot.index()];
        if (place == kNowhere) continue;
        weight[place] += static_cast<double>(r.robot_cost[robot.index()]);
        if (home == kNowhere || weight[place] > weight[home]) home = place;
    }
    for (const RobotId robot : r.islands.of(island))
        if (r.robot_place[robot.index()] != kNowhere) weight[r.robot_place[robot.index()]] = 0;
    return home;
}

std::uint32_t soonest_done(std::span<const double> load, std::span<const double> speed, double cost) {
    std::uint32_t best = 0;
    for (std::uint32_t s = 1; s < load.size(); ++s)
        if ((load[s] + cost) / speed[s] < (load[best] + cost) / speed[best]) best = s;
    return best;
}

}  // namespace

std::vector<std::uint32_t> assign(const AssignRequest& r) {
    ROBOSS_CHECK(!r.speed.empty(), "assignment without a Simulator");
    const std::size_t count = r.islands.count();
    if (r.speed.size() == 1) return std::vector<std::uint32_t>(count, 0);
    std::vector<double> cost(count, 0.0);
    for (std::size_t i = 0; i < count; ++i)
        for (const RobotId robot : r.islands.of(i)) cost[i] += static_cast<double>(r.robot_cost[robot.index()]);
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return cost[a] != cost[b] ? cost[a] > cost[b] : a < b; });

    const double total = std::accumulate(cost.begin(), cost.end(), 0.0);
    const double speeds = std::accumulate(r.speed.begin(), r.speed.end(), 0.0);
    std::vector<double> load(r.speed.size(), 0.0), weight(r.speed.size(), 0.0);
    std::vector<std::uint32_t> place(count);
    for (const std::uint32_t island : order) {
        const std::uint32_t home = home_of(r, island, weight);
        const bool stays = home != kNowhere && load[home] + cost[island] <= (1 + r.slack) * total * r.speed[home] / speeds;
        place[island] = stays ? home : soonest_done(load, r.speed, cost[island]);
        load[place[island]] += cost[island];
    }
    return place;
}

}  // namespace roboss
