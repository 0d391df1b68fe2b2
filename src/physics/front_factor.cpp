// See front_factor.h.
#include "physics/front_factor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace roboss {

void FrontFactor::analyse(std::span<const int> group_first, std::span<const int> unknowns,
                          std::span<const Clique> cliques) {
    groups_ = group_first.size() - 1;
    group_first_.assign(group_first.begin(), group_first.end());
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

/// The same with sorted lists.
void FrontFactor::order_large() {
    if (neighbours_.size() < groups_) neighbours_.resize(groups_);
    for (std::size_t g = 0; g < groups_; ++g) neighbours_[g].clear();
    for (const auto& [a, b] : links_) {
        neighbours_[static_cast<std::size_t>(a)].push_back(b);
        neighbours_[static_cast<std::size_t>(b)].push_back(a);
    }
    for (std::size_t g = 0; g < groups_; ++g) {
        std::vector<int>& list = neighbours_[g];
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    for (std::size_t k = 0; k < groups_; ++k) {
        std::size_t best = groups_;
        for (std::size_t g = 0; g < groups_; ++g)
            if (position_[g] < 0 && (best == groups_ || neighbours_[g].size() < neighbours_[best].size()))
                best = g;
        take_group(best);
        const std::vector<int>& front = neighbours_[best];
        for (int u : front) {
            std::vector<int>& list = neighbours_[static_cast<std::size_t>(u)];
            merged_.clear();
            std::set_union(list.begin(), list.end(), front.begin(), front.end(), std::back_inserter(merged_));
            std::erase_if(merged_, [&](int x) { return x == u || x == static_cast<int>(best); });
            list.swap(merged_);
        }
    }
}

void FrontFactor::take_group(std::size_t group) {
    position_[group] = static_cast<int>(order_.size());
    order_.push_back(static_cast<int>(group));
}

/// Inside a group the last unknown goes first: a tree's leaves before its root, so that zeros stay zeros.
void FrontFactor::rank_unknowns() {
    rank_.resize(group_of_.size());
    int next = 0;
    for (int g : order_) {
        const auto group = static_cast<std::size_t>(g);
        for (int i = group_first_[group + 1]; i-- > group_first_[group];)
            rank_[static_cast<std::size_t>(i)] = next++;
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
    for (int i = group_first_[group + 1]; i-- > group_first_[group];) {
        index_.push_back(i);
        mark_[static_cast<std::size_t>(i)] = stamp;
    }
    front.own = index_.size() - front.index_at;
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
    std::size_t size = 0;
    for (int g : order_) {
        Front& front = fronts_[static_cast<std::size_t>(g)];
        front.matrix_at = size;
        size += front.size * front.size;
    }
    a_.resize(size);
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

/// Positions of all cliques' unknowns in their fronts.
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
    for (std::size_t c = 0; c < cliques.size(); ++c) clique_first_[c] = cliques[c].first;
}

void FrontFactor::clear() {
    kept_.assign(a_.size(), 0.0);
}

FrontFactor::Place FrontFactor::place(std::size_t clique) {
    const Front& front = fronts_[static_cast<std::size_t>(clique_front_[clique])];
    return {kept_.data() + front.matrix_at, front.size, local_.data() + clique_first_[clique]};
}

FrontFactor::Place FrontFactor::unsymmetric_place(std::size_t clique) {
    const Front& front = fronts_[static_cast<std::size_t>(clique_front_[clique])];
    return {a_.data() + front.matrix_at, front.size, local_.data() + clique_first_[clique]};
}

void FrontFactor::add(std::size_t group, int i, int j, double value) {
    const Front& front = fronts_[group];
    const int last = group_first_[group + 1] - 1;
    const auto a = static_cast<std::size_t>(last - i), b = static_cast<std::size_t>(last - j);  // a <= b
    kept_[front.matrix_at + a * front.size + b] += value;
}

void FrontFactor::begin_factor(bool symmetric) {
    symmetric_ = symmetric;
    std::copy(kept_.begin(), kept_.end(), a_.begin());
    if (symmetric) return;
    for (const Front& front : fronts_) {
        double* a = a_.data() + front.matrix_at;
        for (std::size_t r = 1; r < front.size; ++r)
            for (std::size_t c = 0; c < r; ++c) a[r * front.size + c] = a[c * front.size + r];
    }
}

/// The first `own` rows of the factor U, its diagonal kept as reciprocals; what remains is the Schur
/// complement of the others.
bool FrontFactor::eliminate(double* a, std::size_t own, std::size_t size) {
    for (std::size_t c = 0; c < own; ++c) {
        double* pivot = a + c * size;
        const double inverse = 1.0 / std::sqrt(pivot[c]);
        pivot[c] = inverse;
        for (std::size_t j = c + 1; j < size; ++j) pivot[j] *= inverse;
        for (std::size_t r = c + 1; r < size; ++r) {
            const double f = pivot[r];
            if (f == 0) continue;
            double* row = a + r * size;
            for (std::size_t j = r; j < size; ++j) row[j] -= f * pivot[j];
        }
    }
    return true;
}

/// The same for L U: L has a unit diagonal and stands below.
bool FrontFactor::eliminate_general(double* a, std::size_t own, std::size_t size) {
    for (std::size_t c = 0; c < own; ++c) {
        double* pivot = a + c * size;
        if (!(pivot[c] > 0)) return false;
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (std::size_t r = c + 1; r < size; ++r) {
            double* row = a + r * size;
            if (row[c] == 0) continue;
            const double l = row[c] * inverse;
            row[c] = l;
            for (std::size_t j = c + 1; j < size; ++j) row[j] -= l * pivot[j];
        }
    }
    return true;
}

void FrontFactor::add_to_parent(const Front& front) {
    const Front& parent = fronts_[static_cast<std::size_t>(front.parent)];
    const double* a = a_.data() + front.matrix_at;
    double* to = a_.data() + parent.matrix_at;
    const int* map = to_parent_.data() + front.update_at;
    for (std::size_t i = front.own; i < front.size; ++i) {
        double* row = to + static_cast<std::size_t>(map[i - front.own]) * parent.size;
        for (std::size_t j = symmetric_ ? i : front.own; j < front.size; ++j)
            row[map[j - front.own]] += a[i * front.size + j];
    }
}

bool FrontFactor::factor() {
    for (int g : order_) {
        const Front& front = fronts_[static_cast<std::size_t>(g)];
        double* a = a_.data() + front.matrix_at;
        if (!(symmetric_ ? eliminate(a, front.own, front.size) : eliminate_general(a, front.own, front.size)))
            return false;
        if (front.parent >= 0) add_to_parent(front);
    }
    return true;
}

void FrontFactor::solve(std::span<double> x) {
    const auto at = [&](int i) -> double& { return x[static_cast<std::size_t>(i)]; };
    for (int g : order_) {
        const Front& front = fronts_[static_cast<std::size_t>(g)];
        const double* a = a_.data() + front.matrix_at;
        const int* index = index_.data() + front.index_at;
        for (std::size_t c = 0; c < front.own; ++c) {
            if (symmetric_) at(index[c]) *= a[c * front.size + c];
            const double value = at(index[c]);
            if (value == 0) continue;
            for (std::size_t j = c + 1; j < front.size; ++j)
                at(index[j]) -= (symmetric_ ? a[c * front.size + j] : a[j * front.size + c]) * value;
        }
    }
    for (std::size_t k = order_.size(); k-- > 0;) {
        const Front& front = fronts_[static_cast<std::size_t>(order_[k])];
        const double* a = a_.data() + front.matrix_at;
        const int* index = index_.data() + front.index_at;
        for (std::size_t c = front.own; c-- > 0;) {
            const double* row = a + c * front.size;
            double value = at(index[c]);
            for (std::size_t j = c + 1; j < front.size; ++j) value -= row[j] * at(index[j]);
            at(index[c]) = value * row[c];
        }
    }
}

}  // namespace roboss
