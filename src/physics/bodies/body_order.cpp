// See body_island.h.
#include <algorithm>

#include "physics/bodies/body_island.h"

namespace roboss {

void PointEnds::sort(std::size_t bodies, const std::vector<BodyPoint>& points) {
    first.assign(bodies + 1, 0);
    for (const BodyPoint& p : points) {
        ++first[static_cast<std::size_t>(p.a)];
        if (p.b >= 0) ++first[static_cast<std::size_t>(p.b)];
    }
    for (std::size_t b = 0, sum = 0; b <= bodies; ++b) {
        sum += first[b];
        first[b] = static_cast<std::uint32_t>(sum);
    }
    ends.resize(first[bodies]);
    for (std::size_t k = points.size(); k-- > 0;) {
        const BodyPoint& p = points[k];
        if (p.b >= 0) ends[--first[static_cast<std::size_t>(p.b)]] = {static_cast<std::uint32_t>(k), true};
        ends[--first[static_cast<std::size_t>(p.a)]] = {static_cast<std::uint32_t>(k), false};
    }
}

bool BodyOrder::analyse(std::size_t bodies, std::vector<BodyPoint>& points, std::size_t most_updates) {
    elimination_.begin(bodies);
    for (const BodyPoint& point : points)
        if (point.b >= 0) elimination_.join(point.a, point.b);
    if (!elimination_.eliminate(most_updates)) return false;
    for (BodyPoint& point : points) {
        if (point.b < 0) continue;
        point.b_first = goes_first(point.b, point.a);
        point.edge = point.b_first ? edge_of(point.b, point.a) : edge_of(point.a, point.b);
    }
    pivots_.clear(), updates_.clear();
    for (std::size_t k = 0; k < bodies; ++k) {
        const auto [first, last] = elimination_.ends_of(k);
        pivots_.push_back({elimination_.order()[k], first, last, updates_.size()});
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = i + 1; j < last; ++j) {
                const int a = ends()[i], b = ends()[j];
                const bool j_first = goes_first(b, a);
                updates_.push_back({j_first ? edge_of(b, a) : edge_of(a, b), j_first});
            }
    }
    return true;
}

bool BodyOrder::goes_first(int a, int b) const {
    const std::vector<int>& position = elimination_.position();
    return position[static_cast<std::size_t>(a)] < position[static_cast<std::size_t>(b)];
}

/// Of a body to one that is eliminated later.
int BodyOrder::edge_of(int a, int b) const {
    const auto [first, last] =
        elimination_.ends_of(static_cast<std::size_t>(elimination_.position()[static_cast<std::size_t>(a)]));
    const auto begin = ends().begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = ends().begin() + static_cast<std::ptrdiff_t>(last);
    return static_cast<int>(std::lower_bound(begin, end, b) - ends().begin());
}

}  // namespace roboss
