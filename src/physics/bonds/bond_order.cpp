// See bond_order.h.
#include "physics/bonds/bond_order.h"

#include <algorithm>
#include <numeric>

namespace roboss {
namespace {

constexpr std::size_t kNotYet = static_cast<std::size_t>(-1);

}  // namespace

/// Robot r's neighbours: neighbours_[first_[r]] to neighbours_[first_[r + 1]].
void BondOrder::gather_neighbours(std::span<const HeldBond> bonds, std::size_t robots) {
    first_.assign(robots + 2, 0);
    const auto visit_ends = [&](auto&& visit) {
        for (const HeldBond& bond : bonds) {
            if (bond.other == HeldBond::kScenery) continue;
            visit(std::size_t{bond.holder}, std::size_t{bond.other});
            visit(std::size_t{bond.other}, std::size_t{bond.holder});
        }
    };
    visit_ends([&](std::size_t from, std::size_t) { ++first_[from + 2]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    neighbours_.resize(first_.back());
    visit_ends([&](std::size_t from, std::size_t to) { neighbours_[first_[from + 1]++] = to; });
    first_.pop_back();
}

void BondOrder::find(std::span<const HeldBond> bonds, std::size_t robots) {
    gather_neighbours(bonds, robots);
    by_degree_.resize(robots);
    std::iota(by_degree_.begin(), by_degree_.end(), std::size_t{0});
    const auto degree = [&](std::size_t robot) { return first_[robot + 1] - first_[robot]; };
    std::ranges::sort(by_degree_, [&](std::size_t a, std::size_t b) {
        return degree(a) != degree(b) ? degree(a) < degree(b) : a < b;
    });
    place_.assign(robots, kNotYet);
    queue_.clear();
    const auto add = [&](std::size_t robot) {
        if (place_[robot] != kNotYet) return;
        place_[robot] = queue_.size();
        queue_.push_back(robot);
    };
    for (const std::size_t start : by_degree_) {
        std::size_t next = queue_.size();
        add(start);
        for (; next < queue_.size(); ++next)
            for (std::size_t n = first_[queue_[next]]; n < first_[queue_[next] + 1]; ++n) add(neighbours_[n]);
    }
}

}  // namespace roboss
