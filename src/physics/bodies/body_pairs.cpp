// See body_pairs.h.
#include "physics/bodies/body_pairs.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "physics/bodies/body_island.h"

namespace roboss {
namespace {

constexpr std::uint32_t kMasked = 64;  // colours that a bit stands for

}  // namespace

std::uint32_t PairBatches::take_colour(int a, int b) {
    const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b < 0 ? a : b);
    const std::uint64_t taken = taken_[i] | taken_[k];
    if (taken != ~std::uint64_t{0}) {
        const auto colour = static_cast<std::uint32_t>(std::countr_one(taken));
        taken_[i] |= std::uint64_t{1} << colour;
        if (b >= 0) taken_[k] |= std::uint64_t{1} << colour;
        return colour;
    }
    const std::uint32_t colour = std::max(further_[i], further_[k]);
    further_[i] = colour + 1;
    if (b >= 0) further_[k] = colour + 1;
    return colour;
}

void PairBatches::arrange(std::size_t bodies, const std::vector<BodyPoint>& points) {
    taken_.assign(bodies, 0), further_.assign(bodies, kMasked);
    pairs_.clear();
    for (std::uint32_t first = 0, last = 0; first < points.size(); first = last) {
        const BodyPoint& p = points[first];
        while (last < points.size() && points[last].a == p.a && points[last].b == p.b) ++last;
        pairs_.push_back({take_colour(p.a, p.b), p.b < 0, first, last - first});
    }
    std::ranges::sort(pairs_, [](const Pair& x, const Pair& y) {
        return std::tuple(x.colour, x.scenery, y.points, x.first) <
               std::tuple(y.colour, y.scenery, x.points, y.first);
    });
    places_.resize(points.size());
    fill_batches(points, static_cast<int>(bodies));
}

void PairBatches::fill_batches(const std::vector<BodyPoint>& points, int bodies) {
    batches_.clear(), colours_.clear();
    std::size_t slots = 0;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const Pair& pair = pairs_[k];
        if (k == 0 || pairs_[k - 1].colour != pair.colour) colours_.push_back(batches_.size());
        if (k == 0 || pairs_[k - 1].colour != pair.colour || pairs_[k - 1].scenery != pair.scenery ||
            batches_.back().pairs == 8) {
            PairBatch& batch = batches_.emplace_back();
            const int unused_body = pair.scenery ? bodies + 1 : bodies;
            std::ranges::fill(batch.a, unused_body), std::ranges::fill(batch.b, unused_body);
            batch.first = slots, batch.last = slots + pair.points;
            batch.scenery = pair.scenery;
            slots = batch.last;
        }
        PairBatch& batch = batches_.back();
        const auto lane = static_cast<std::size_t>(batch.pairs++);
        const BodyPoint& p = points[pair.first];
        batch.a[lane] = p.a;
        if (p.b >= 0) batch.b[lane] = p.b;
        for (std::uint32_t i = 0; i < pair.points; ++i)
            places_[pair.first + i] = (batch.first + i) * 8 + lane;
    }
    colours_.push_back(batches_.size());
}

void PairBatches::sort_by_bodies() {
    by_bodies_.resize(batches_.size());
    std::iota(by_bodies_.begin(), by_bodies_.end(), 0U);
    for (std::size_t c = 0; c + 1 < colours_.size(); ++c)
        std::ranges::sort(std::span(by_bodies_).subspan(colours_[c], colours_[c + 1] - colours_[c]), {},
                          [&](std::uint32_t batch) { return std::pair(batches_[batch].a[0], batch); });
}

void make_room_for_sweeps(BodyIsland& island) {
    const std::size_t bodies = island.bodies.size();
    island.pairs.arrange(bodies, island.points);
    island.whitening.resize(bodies), island.swept_before.resize(bodies);
    island.swept.assign(bodies + 2, {}), island.swept_direction.assign(bodies, {});
    island.slots.resize(island.pairs.slots());
    std::memset(static_cast<void*>(island.slots.data()), 0, island.slots.size() * sizeof(PointSlot));
    if (island.team.size() == 1) return;
    island.pairs.sort_by_bodies();
    island.slot_terms.resize(island.slots.size());
}

}  // namespace roboss
