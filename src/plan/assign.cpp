// Longest processing time first, with a preference for staying.
#include "plan/assign.h"

#include <algorithm>

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

namespace {

struct Placing {
    std::vector<std::uint32_t> place;
    double done = 0;  // when the last Simulator would be
};

/// Islands in `order`; each stays at home while home's load with it is within `bound` (a time), else it goes
/// where it is soonest done.
Placing place_all(const AssignRequest& r, std::span<const double> cost, std::span<const std::uint32_t> order,
                  std::span<const std::uint32_t> home, double bound) {
    Placing result{std::vector<std::uint32_t>(cost.size()), 0};
    std::vector<double> load(r.speed.size(), 0.0);
    for (const std::uint32_t island : order) {
        const std::uint32_t at = home[island];
        const bool stays = at != kNowhere && (load[at] + cost[island]) / r.speed[at] <= bound;
        result.place[island] = stays ? at : soonest_done(load, r.speed, cost[island]);
        load[result.place[island]] += cost[island];
    }
    for (std::size_t s = 0; s < load.size(); ++s) result.done = std::max(result.done, load[s] / r.speed[s]);
    return result;
}

}  // namespace

std::vector<std::uint32_t> assign(const AssignRequest& r) {
    ROBOSS_CHECK(!r.speed.empty(), "assignment without a Simulator");
    const std::size_t count = r.islands.count();
    if (r.speed.size() == 1) return std::vector<std::uint32_t>(count, 0);
    std::vector<double> cost(count, 0.0), weight(r.speed.size(), 0.0);
    std::vector<std::uint32_t> order(count), home(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const RobotId robot : r.islands.of(i))
            cost[i] += static_cast<double>(r.robot_cost[robot.index()]);
        home[i] = home_of(r, i, weight);
        order[i] = i;
    }
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return cost[a] != cost[b] ? cost[a] > cost[b] : a < b; });

    // How soon all could be done if moving were free; nobody moves as long as staying is not much worse than
    // that, measurements being what they are.
    constexpr double kLittle = 0.01;
    const Placing free = place_all(r, cost, order, home, -1);
    return place_all(r, cost, order, home, free.done + r.patience + kLittle * free.done).place;
}

}  // namespace roboss
