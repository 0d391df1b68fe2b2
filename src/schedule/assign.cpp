// Longest processing time first, with a preference for staying.
#include "schedule/assign.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/check.h"

namespace roboss {

namespace {

/// Where most of the island's cost is now, or kNowhere.
std::uint32_t home_of(const AssignRequest& r, std::size_t island, std::vector<double>& weight) {
    std::uint32_t home = kNowhere;
    if (r.islands.size_of(island) == 1) return r.simulator_of_robot[r.islands.of(island)[0].index()];
    for (const RobotId robot : r.islands.of(island)) {
        const std::uint32_t simulator = r.simulator_of_robot[robot.index()];
        if (simulator == kNowhere) continue;
        weight[simulator] += static_cast<double>(r.robot_cost[robot.index()]);
        if (home == kNowhere || weight[simulator] > weight[home]) home = simulator;
    }
    for (const RobotId robot : r.islands.of(island))
        if (r.simulator_of_robot[robot.index()] != kNowhere) weight[r.simulator_of_robot[robot.index()]] = 0;
    return home;
}

constexpr double kLittle = 0.003;  // a relative difference below the measurement error

/// When each Simulator would be done with its islands so far.
class Clocks {
  public:
    explicit Clocks(const AssignRequest& r) {
        for (const double speed : r.speed) {
            done_.push_back(r.send_interval * static_cast<double>(per_cost_.size()));
            per_cost_.push_back(1 / speed);
        }
    }
    double with(std::uint32_t at, double cost) const { return done_[at] + cost * per_cost_[at]; }
    void give(std::uint32_t at, double cost, double later) { done_[at] = with(at, cost) + later; }
    std::uint32_t soonest(double cost) const {
        std::uint32_t best = 0;
        double best_done = with(0, cost);
        for (std::uint32_t s = 1; s < done_.size(); ++s) {
            const double done = with(s, cost);
            if (done < best_done) best = s, best_done = done;
        }
        return best;
    }
    double last() const { return *std::max_element(done_.begin(), done_.end()); }

  private:
    std::vector<double> done_, per_cost_;
};

/// Islands by descending cost; those that cost the same within 3 %, ascending. A counting sort: comparisons
/// would take longer than everything else here.
std::vector<std::uint32_t> dearest_first(std::span<const float> cost) {
    constexpr std::uint32_t kKeys =
        1024;  // of 1 / 32 of a doubling: islands below 2^-32 of the greatest cost are last
    constexpr int kDropped = 23 - 5;  // bits of a float's fraction
    std::uint32_t top = 0;
    for (const float c : cost) top = std::max(top, std::bit_cast<std::uint32_t>(c) >> kDropped);
    const auto key = [top](float c) {
        return std::min(top - (std::bit_cast<std::uint32_t>(c) >> kDropped), kKeys - 1);
    };
    std::vector<std::uint32_t> next(kKeys + 1, 0), order(cost.size());
    for (const float c : cost) ++next[key(c) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (std::uint32_t i = 0; i < cost.size(); ++i) order[next[key(cost[i])]++] = i;
    return order;
}

struct Attempt {
    std::vector<std::uint32_t> simulator_of;  // by island
    double done = 0;                          // by everybody, moves counted
};

/// An island stays at home if home finishes it in time, else it goes where it is finished first.
Attempt attempt(const AssignRequest& r, std::span<const float> cost, std::span<const std::uint32_t> home,
                std::span<const std::uint32_t> order, double in_time) {
    Attempt result{{home.begin(), home.end()}, 0};
    Clocks clocks(r);
    for (const std::uint32_t island : order) {
        const auto c = static_cast<double>(cost[island]);
        std::uint32_t& at = result.simulator_of[island];
        if (at == kNowhere || clocks.with(at, c) > in_time) at = clocks.soonest(c);
        clocks.give(at, c, home[island] != kNowhere && at != home[island] ? r.move : 0);
    }
    result.done = clocks.last();
    return result;
}

}  // namespace

std::vector<std::uint32_t> assign(const AssignRequest& r) {
    ROBOSS_CHECK(!r.speed.empty(), "assignment without a Simulator");
    const std::size_t count = r.islands.count();
    if (r.speed.size() == 1) return std::vector<std::uint32_t>(count, 0);
    std::vector<double> weight(r.speed.size(), 0.0);
    std::vector<float> cost(count);
    std::vector<std::uint32_t> home(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        double sum = 0;
        for (const RobotId robot : r.islands.of(i)) sum += static_cast<double>(r.robot_cost[robot.index()]);
        cost[i] = static_cast<float>(sum);
        home[i] = home_of(r, i, weight);
    }
    const std::vector<std::uint32_t> order = dearest_first(cost);

    AssignRequest free = r;
    free.move = 0;
    constexpr double kNobodyStays = 0;
    const double soonest = attempt(free, cost, home, order, kNobodyStays).done;
    // The more patience, the fewer moves.
    Attempt best;
    for (const double moves : {1.0, 0.5, 0.25, 0.0}) {
        Attempt next = attempt(r, cost, home, order, (1 + kLittle) * soonest + moves * r.move);
        if (best.simulator_of.empty() || next.done < (1 - kLittle) * best.done) best = std::move(next);
    }
    return std::move(best.simulator_of);
}

}  // namespace roboss
