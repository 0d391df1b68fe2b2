// See body_island.h.
#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "physics/bodies/body_island.h"

namespace roboss {
namespace {

void insert(std::vector<int>& sorted, int value) {
    const auto at = std::ranges::lower_bound(sorted, value);
    if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

}  // namespace

void BodyOrder::analyse(std::size_t bodies, std::vector<BodyPoint>& points) {
    if (near_.size() < bodies) near_.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i) near_[i].clear();
    for (const BodyPoint& point : points) {
        if (point.b < 0) continue;
        insert(near_[static_cast<std::size_t>(point.a)], point.b);
        insert(near_[static_cast<std::size_t>(point.b)], point.a);
    }
    eliminate(bodies);
    for (BodyPoint& point : points) {
        if (point.b < 0) continue;
        point.b_first =
            position_[static_cast<std::size_t>(point.b)] < position_[static_cast<std::size_t>(point.a)];
        point.edge = point.b_first ? edge_of(point.b, point.a) : edge_of(point.a, point.b);
    }
    updates_.clear();
    for (Pivot& pivot : pivots_) {
        pivot.updates = updates_.size();
        for (std::size_t i = pivot.first; i < pivot.last; ++i)
            for (std::size_t j = i + 1; j < pivot.last; ++j) {
                const int a = ends_[i], b = ends_[j];
                const bool j_first =
                    position_[static_cast<std::size_t>(b)] < position_[static_cast<std::size_t>(a)];
                updates_.push_back({j_first ? edge_of(b, a) : edge_of(a, b), j_first});
            }
    }
}

/// Pivot by pivot: its neighbours left become each other's.
void BodyOrder::eliminate(std::size_t bodies) {
    pivots_.clear(), ends_.clear(), queue_.clear();
    position_.assign(bodies, static_cast<int>(bodies));
    degree_.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i) {
        degree_[i] = static_cast<int>(near_[i].size());
        queue_.emplace_back(degree_[i], static_cast<int>(i));
    }
    std::ranges::make_heap(queue_, std::greater<>{});
    while (pivots_.size() < bodies) {
        std::ranges::pop_heap(queue_, std::greater<>{});
        const int degree = queue_.back().first, body = queue_.back().second;
        queue_.pop_back();
        const auto k = static_cast<std::size_t>(body);
        if (position_[k] < static_cast<int>(bodies) || degree != degree_[k]) continue;
        position_[k] = static_cast<int>(pivots_.size());
        const std::size_t first = ends_.size();
        ends_.insert(ends_.end(), near_[k].begin(), near_[k].end());
        pivots_.push_back({body, first, ends_.size(), 0});
        for (const int neighbour : near_[k]) {
            const auto u = static_cast<std::size_t>(neighbour);
            merged_.clear();
            std::ranges::set_union(near_[u], near_[k], std::back_inserter(merged_));
            std::erase_if(merged_, [&](int x) { return x == neighbour || x == body; });
            near_[u].assign(merged_.begin(), merged_.end());
            degree_[u] = static_cast<int>(near_[u].size());
            queue_.emplace_back(degree_[u], neighbour);
            std::ranges::push_heap(queue_, std::greater<>{});
        }
    }
}

/// Of a body to one that is eliminated later.
int BodyOrder::edge_of(int a, int b) const {
    const Pivot& pivot = pivots_[static_cast<std::size_t>(position_[static_cast<std::size_t>(a)])];
    const auto begin = ends_.begin() + static_cast<std::ptrdiff_t>(pivot.first);
    const auto end = ends_.begin() + static_cast<std::ptrdiff_t>(pivot.last);
    return static_cast<int>(std::lower_bound(begin, end, b) - ends_.begin());
}

}  // namespace roboss
