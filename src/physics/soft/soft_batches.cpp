// See soft_batches.h.
#include "physics/soft/soft_batches.h"

#include <algorithm>
#include <bit>

namespace roboss::soft {
namespace {

constexpr std::uint32_t kMasked = 64;         // colours that a bit stands for
constexpr std::uint32_t kScenery = 1U << 21;  // added to the colours of scenery

}  // namespace

std::uint32_t Batches::take_colour(const Pair& pair) {
    const auto a = static_cast<std::size_t>(pair.a);
    if (pair.b < 0) return kScenery + scenery_[a]++;
    const auto b = static_cast<std::size_t>(pair.b);
    const std::uint64_t taken = taken_[a] | taken_[b];
    if (taken != ~std::uint64_t{0}) {
        const auto colour = static_cast<std::uint32_t>(std::countr_one(taken));
        taken_[a] |= std::uint64_t{1} << colour, taken_[b] |= std::uint64_t{1} << colour;
        return colour;
    }
    const std::uint32_t colour = std::max(further_[a], further_[b]);
    further_[a] = further_[b] = colour + 1;
    return colour;
}

void Batches::arrange(std::size_t bodies, std::span<const Pair> pairs, Problem& problem) {
    taken_.assign(bodies, 0), further_.assign(bodies, kMasked), scenery_.assign(bodies, 0);
    places_.clear();
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
        const Pair& pair = pairs[k];
        const auto columns = pair.jointed ? 1 + static_cast<std::uint64_t>(pair.further()) : 0;
        places_.push_back(std::uint64_t{take_colour(pair)} << 42 | columns << 36 |
                          std::uint64_t{8 - pair.points} << 32 | k);
    }
    std::ranges::sort(places_);
    order_.clear(), colours_.clear();
    for (const std::uint64_t place : places_) {
        order_.push_back(static_cast<std::uint32_t>(place));
        colours_.push_back(static_cast<std::uint32_t>(place >> 42));
    }
    fill(bodies, pairs, problem);
    make_room(problem);
}

void Batches::fill(std::size_t bodies, std::span<const Pair> pairs, Problem& problem) {
    const int still = static_cast<int>(bodies);
    problem.batches.clear(), problem.colours.clear(), first_pairs_.clear();
    for (std::uint32_t k = 0; k < order_.size(); ++k) {
        const Pair& pair = pairs[order_[k]];
        const bool begins = k == 0 || colours_[k] != colours_[k - 1];
        if (begins) problem.colours.push_back(problem.batches.size());
        if (begins || problem.batches.back().patches == 8 || problem.batches.back().jointed != pair.jointed) {
            Batch& batch = problem.batches.emplace_back();
            std::ranges::fill(batch.a, still), std::ranges::fill(batch.b, still);
            batch.scenery = pair.b < 0, batch.jointed = pair.jointed;
            first_pairs_.push_back(k);
        }
        Batch& batch = problem.batches.back();
        const auto lane = static_cast<std::size_t>(batch.patches++);
        batch.a[lane] = pair.a;
        if (pair.b >= 0) batch.b[lane] = pair.b;
        batch.points = std::max(batch.points, static_cast<int>(pair.points));
        if (!pair.jointed) continue;
        batch.path_a.further = std::max({1, batch.path_a.further, pair.further_a});
        batch.path_b.further = std::max({1, batch.path_b.further, pair.further_b});
    }
    problem.colours.push_back(problem.batches.size());
}

/// Rows one after the other.
void Batches::make_room(Problem& problem) {
    std::size_t points = 0, columns = 0, places = 0;
    for (Batch& batch : problem.batches) {
        batch.first = points, points += static_cast<std::size_t>(batch.points);
        if (!batch.jointed) continue;
        batch.first_column = columns;
        columns += (static_cast<std::size_t>(batch.points) + 3) * batch.columns();
        for (Path* path : {&batch.path_a, &batch.path_b})
            path->first = places, places += static_cast<std::size_t>(path->further) * 8;
    }
    problem.points.resize(points), problem.patches.resize(problem.batches.size());
    problem.columns.resize(columns), problem.places.resize(places);
}

}  // namespace roboss::soft
