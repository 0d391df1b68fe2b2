// See minimum_degree.h.
#include "core/minimum_degree.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace roboss {
namespace {

void insert(std::vector<int>& sorted, int value) {
    const auto at = std::ranges::lower_bound(sorted, value);
    if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

}  // namespace

void MinimumDegree::begin(std::size_t count) {
    order_.clear(), ends_.clear(), queue_.clear();
    first_.assign(1, 0);
    position_.assign(count, static_cast<int>(count));
    degree_.resize(count);
    if (near_.size() < count) near_.resize(count);
    for (std::size_t i = 0; i < count; ++i) near_[i].clear();
}

void MinimumDegree::join(int a, int b) {
    insert(near_[static_cast<std::size_t>(a)], b);
    insert(near_[static_cast<std::size_t>(b)], a);
}

bool MinimumDegree::eliminate(std::size_t most_pairs) {
    const std::size_t count = position_.size();
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < count; ++i) {
        degree_[i] = static_cast<int>(near_[i].size());
        queue_.emplace_back(degree_[i], static_cast<int>(i));
    }
    std::ranges::make_heap(queue_, std::greater<>{});
    while (order_.size() < count) {
        std::ranges::pop_heap(queue_, std::greater<>{});
        const int degree = queue_.back().first, node = queue_.back().second;
        queue_.pop_back();
        const auto k = static_cast<std::size_t>(node);
        if (position_[k] < static_cast<int>(count) || degree != degree_[k]) continue;
        const auto ends = static_cast<std::size_t>(degree);
        pairs += ends * (ends - std::min<std::size_t>(ends, 1)) / 2;
        if (pairs > most_pairs) return false;
        position_[k] = static_cast<int>(order_.size());
        order_.push_back(node);
        ends_.insert(ends_.end(), near_[k].begin(), near_[k].end());
        first_.push_back(ends_.size());
        for (const int neighbour : near_[k]) {
            const auto u = static_cast<std::size_t>(neighbour);
            merged_.clear();
            std::ranges::set_union(near_[u], near_[k], std::back_inserter(merged_));
            std::erase_if(merged_, [&](int x) { return x == neighbour || x == node; });
            near_[u].assign(merged_.begin(), merged_.end());
            degree_[u] = static_cast<int>(near_[u].size());
            queue_.emplace_back(degree_[u], neighbour);
            std::ranges::push_heap(queue_, std::greater<>{});
        }
    }
    return true;
}

}  // namespace roboss
