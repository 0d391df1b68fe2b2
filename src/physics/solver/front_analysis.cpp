// Fronts before their numbers: who goes when, who is in which front, where entries go.
#include "physics/solver/front_factor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/make_room.h"

namespace roboss {

bool FrontFactor::knows(std::span<const int> group_first, std::span<const int> heads,
                        std::span<const int> unknowns, std::span<const Clique> cliques) const {
    return std::ranges::equal(group_first, group_first_) && std::ranges::equal(heads, heads_) &&
           std::ranges::equal(unknowns, unknowns_) && std::ranges::equal(cliques, cliques_);
}

void FrontFactor::analyse(std::span<const int> group_first, std::span<const int> heads,
                          std::span<const int> unknowns, std::span<const Clique> cliques) {
    if (knows(group_first, heads, unknowns, cliques)) return;
    groups_ = group_first.size() - 1;
    unknowns_.assign(unknowns.begin(), unknowns.end());
    cliques_.assign(cliques.begin(), cliques.end());
    group_first_.assign(group_first.begin(), group_first.end());
    heads_.assign(heads.begin(), heads.end());
    const auto n = static_cast<std::size_t>(group_first.back());
    group_of_.resize(n);
    for (std::size_t g = 0; g < groups_; ++g)
        for (int i = group_first[g]; i < group_first[g + 1]; ++i)
            group_of_[static_cast<std::size_t>(i)] = static_cast<int>(g);
    order_groups(unknowns, cliques);
    rank_unknowns();
    assign_cliques(unknowns, cliques);
    fronts_.assign(groups_, {});
    index_.clear();
    mark_.assign(n, -1);
    for (int g : order_) gather_front(static_cast<std::size_t>(g), unknowns, cliques);
    where_.resize(n);
    map_to_parents();
    localise(unknowns, cliques);
}

/// Minimum degree on the graph of groups; ties go to the lowest group.
void FrontFactor::order_groups(std::span<const int> unknowns, std::span<const Clique> cliques) {
    links_.clear();
    for (const Clique& c : cliques) {
        if (c.first == c.last) continue;
        const int a = group_of_[static_cast<std::size_t>(unknowns[c.first])];
        const int b = group_of_[static_cast<std::size_t>(unknowns[c.last - 1])];
        if (a != b) links_.push_back(std::minmax(a, b));
    }
    order_.clear();
    position_.assign(groups_, -1);
    if (groups_ <= kSmall) {
        order_small();
    } else {
        order_large();
    }
}

/// Neighbours as bits of a word.
void FrontFactor::order_small() {
    std::array<std::uint64_t, kSmall> near{};
    for (const auto& [a, b] : links_) {
        near[static_cast<std::size_t>(a)] |= std::uint64_t{1} << b;
        near[static_cast<std::size_t>(b)] |= std::uint64_t{1} << a;
    }
    for (std::size_t k = 0; k < groups_; ++k) {
        std::size_t best = groups_;
        for (std::size_t g = 0; g < groups_; ++g)
            if (position_[g] < 0 && (best == groups_ || std::popcount(near[g]) < std::popcount(near[best])))
                best = g;
        take_group(best);
        const std::uint64_t front = near[best];
        for (std::uint64_t left = front; left != 0;
             left &= left - 1) {  // they become neighbours of each other
            const auto u = static_cast<std::size_t>(std::countr_zero(left));
            near[u] = (near[u] | front) & ~(std::uint64_t{1} << u) & ~(std::uint64_t{1} << best);
        }
    }
}

/// The same for any number of groups.
void FrontFactor::order_large() {
    large_.begin(groups_);
    for (const auto& [a, b] : links_) large_.join(a, b);
    large_.eliminate();
    for (const int g : large_.order()) take_group(static_cast<std::size_t>(g));
}

void FrontFactor::take_group(std::size_t group) {
    position_[group] = static_cast<int>(order_.size());
    order_.push_back(static_cast<int>(group));
}

/// Inside a group the last unknown goes first: a tree's leaves before its root, so that zeros stay zeros. Its
/// head, which has no zeros, comes last, in its own order.
std::size_t FrontFactor::own_place(std::size_t group, int unknown) const {
    const int i = unknown - group_first_[group], head = heads_[group];
    const int count = group_first_[group + 1] - group_first_[group];
    return static_cast<std::size_t>(i < head ? count - head + i : count - 1 - i);
}

void FrontFactor::rank_unknowns() {
    rank_.resize(group_of_.size());
    std::size_t next = 0;
    for (int g : order_) {
        const auto group = static_cast<std::size_t>(g);
        for (int i = group_first_[group]; i < group_first_[group + 1]; ++i)
            rank_[static_cast<std::size_t>(i)] = static_cast<int>(next + own_place(group, i));
        next += static_cast<std::size_t>(group_first_[group + 1] - group_first_[group]);
    }
}

/// A clique belongs to the front of whichever of its groups goes first.
void FrontFactor::assign_cliques(std::span<const int> unknowns, std::span<const Clique> cliques) {
    clique_front_.resize(cliques.size());
    clique_start_.assign(groups_ + 1, 0);
    for (std::size_t c = 0; c < cliques.size(); ++c) {
        clique_front_[c] = -1;
        if (cliques[c].first == cliques[c].last) continue;
        const int a = group_of_[static_cast<std::size_t>(unknowns[cliques[c].first])];
        const int b = group_of_[static_cast<std::size_t>(unknowns[cliques[c].last - 1])];
        const bool a_first = position_[static_cast<std::size_t>(a)] <= position_[static_cast<std::size_t>(b)];
        clique_front_[c] = a_first ? a : b;
        ++clique_start_[static_cast<std::size_t>(clique_front_[c]) + 1];
    }
    for (std::size_t g = 0; g < groups_; ++g) clique_start_[g + 1] += clique_start_[g];
    cliques_by_front_.resize(clique_start_[groups_]);
    for (std::size_t c = cliques.size(); c-- > 0;) {
        if (clique_front_[c] < 0) continue;
        cliques_by_front_[--clique_start_[static_cast<std::size_t>(clique_front_[c]) + 1]] = c;
    }
    // Filling moved each start down to where its list begins: shift the starts back by one.
    for (std::size_t g = 0; g < groups_; ++g) clique_start_[g] = clique_start_[g + 1];
    clique_start_[groups_] = cliques_by_front_.size();
}

/// The unknowns of one front: its own, then those of later groups that its cliques and its children reach.
void FrontFactor::gather_front(std::size_t group, std::span<const int> unknowns,
                               std::span<const Clique> cliques) {
    Front& front = fronts_[group];
    front.index_at = index_.size();
    const int stamp = static_cast<int>(group);
    front.own = static_cast<std::size_t>(group_first_[group + 1] - group_first_[group]);
    index_.resize(front.index_at + front.own);
    for (int i = group_first_[group]; i < group_first_[group + 1]; ++i) {
        index_[front.index_at + own_place(group, i)] = i;
        mark_[static_cast<std::size_t>(i)] = stamp;
    }
    const auto add = [&](int i) {
        if (mark_[static_cast<std::size_t>(i)] == stamp) return;
        mark_[static_cast<std::size_t>(i)] = stamp;
        index_.push_back(i);
    };
    for (std::size_t k = clique_start_[group]; k < clique_start_[group + 1]; ++k) {
        const Clique& c = cliques[cliques_by_front_[k]];
        for (std::size_t i = c.first; i < c.last; ++i) add(unknowns[i]);
    }
    for (int child = front.first_child; child >= 0;
         child = fronts_[static_cast<std::size_t>(child)].sibling) {
        const Front& f = fronts_[static_cast<std::size_t>(child)];
        for (std::size_t i = f.own; i < f.size; ++i) add(index_[f.index_at + i]);
    }
    front.size = index_.size() - front.index_at;
    const auto begin = index_.begin() + static_cast<std::ptrdiff_t>(front.index_at);
    std::sort(begin + static_cast<std::ptrdiff_t>(front.own), index_.end(), [&](int i, int j) {
        return rank_[static_cast<std::size_t>(i)] < rank_[static_cast<std::size_t>(j)];
    });
    if (front.size == front.own) return;
    front.parent = group_of_[static_cast<std::size_t>(index_[front.index_at + front.own])];
    Front& parent = fronts_[static_cast<std::size_t>(front.parent)];
    front.sibling = parent.first_child;
    parent.first_child = stamp;
}

void FrontFactor::map_to_parents() {
    to_parent_.clear();
    std::size_t size = 0, largest = 0;
    for (int g : order_) {
        Front& front = fronts_[static_cast<std::size_t>(g)];
        front.stride = (front.size + 2) / 2 * 2;
        front.matrix_at = size;
        size += front.size * front.stride;
        largest = std::max(largest, front.size);
    }
    make_room(a_, size), make_room(kept_, size);
    a_.resize(size), x_.resize(largest);
    for (int g : order_) {  // g as a parent: where its unknowns stand, told to its children
        const Front& parent = fronts_[static_cast<std::size_t>(g)];
        if (parent.first_child < 0) continue;
        for (std::size_t i = 0; i < parent.size; ++i)
            where_[static_cast<std::size_t>(index_[parent.index_at + i])] = static_cast<int>(i);
        for (int child = parent.first_child; child >= 0;
             child = fronts_[static_cast<std::size_t>(child)].sibling) {
            Front& f = fronts_[static_cast<std::size_t>(child)];
            f.update_at = to_parent_.size();
            for (std::size_t i = f.own; i < f.size; ++i)
                to_parent_.push_back(where_[static_cast<std::size_t>(index_[f.index_at + i])]);
        }
    }
}

/// Positions of all cliques' unknowns in their fronts, one by one and in runs.
void FrontFactor::localise(std::span<const int> unknowns, std::span<const Clique> cliques) {
    local_.resize(unknowns.size());
    for (std::size_t g = 0; g < groups_; ++g) {
        const Front& front = fronts_[g];
        if (clique_start_[g] == clique_start_[g + 1]) continue;
        for (std::size_t i = 0; i < front.size; ++i)
            where_[static_cast<std::size_t>(index_[front.index_at + i])] = static_cast<int>(i);
        for (std::size_t k = clique_start_[g]; k < clique_start_[g + 1]; ++k) {
            const Clique& c = cliques[cliques_by_front_[k]];
            for (std::size_t i = c.first; i < c.last; ++i)
                local_[i] = where_[static_cast<std::size_t>(unknowns[i])];
        }
    }
    clique_first_.resize(cliques.size());
    runs_.clear(), run_first_.clear();
    for (std::size_t c = 0; c < cliques.size(); ++c) {
        clique_first_[c] = cliques[c].first;
        run_first_.push_back(runs_.size());
        find_runs(cliques[c]);
    }
    run_first_.push_back(runs_.size());
}

void FrontFactor::find_runs(const Clique& clique) {
    const std::size_t begin = runs_.size();
    for (std::size_t i = clique.first; i < clique.last; ++i) {
        const auto place = static_cast<std::size_t>(local_[i]);
        if (i > clique.first && place == runs_.back().place + runs_.back().count)
            ++runs_.back().count;
        else
            runs_.push_back({i - clique.first, place, 1});
    }
    for (std::size_t k = begin + 1; k < runs_.size(); ++k)  // there are few
        for (std::size_t m = k; m > begin && runs_[m].place < runs_[m - 1].place; --m)
            std::swap(runs_[m], runs_[m - 1]);
}

}  // namespace roboss
