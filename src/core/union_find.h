// Which of many things are joined, by way of others or directly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace roboss {

/// Disjoint sets of 0 .. n-1 with the lowest member as root (path halving, Tarjan and van Leeuwen 1984).
class UnionFind {
  public:
    void reset(std::size_t n) {
        parent_.resize(n);
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::size_t size() const { return parent_.size(); }
    std::uint32_t find(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    /// Whether they were apart.
    bool unite(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        if (a == b) return false;
        parent_[a < b ? b : a] = a < b ? a : b;
        return true;
    }

    /// Set by set, as the first of each comes; within a set things stay in their order. O(n), by counting.
    void sort_by_set(std::vector<std::uint32_t>& things) {
        if (things.size() < 2) return;
        places_.assign(parent_.size(), {});
        for (const std::uint32_t x : things) ++places_[find(x)].count;
        sorted_.resize(things.size());
        std::uint32_t free = 0;
        for (const std::uint32_t x : things) {
            Places& set = places_[find(x)];
            if (set.count > 0) set.next = std::exchange(free, free + std::exchange(set.count, 0));
            sorted_[set.next++] = x;
        }
        things.swap(sorted_);
    }
    /// act(set) for each set of things sorted so.
    template <class Act>
    void for_each_set(std::span<const std::uint32_t> things, Act&& act) {
        for (std::size_t first = 0; first < things.size();) {
            std::size_t last = first + 1;
            while (last < things.size() && find(things[last]) == find(things[first])) ++last;
            act(things.subspan(first, last - first));
            first = last;
        }
    }

  private:
    struct Places {
        std::uint32_t count = 0, next = 0;  // that the set needs, until it has them; the next of them
    };

    std::vector<std::uint32_t> parent_;
    std::vector<Places> places_;  // by root; buffers
    std::vector<std::uint32_t> sorted_;
};

}  // namespace roboss
