// See block_pattern.h.
#include "core/block_pattern.h"

#include <algorithm>
#include <atomic>

namespace roboss {
namespace {

// Zeros that a front may hold besides: always in so small a one (nodes), else this share of its entries.
constexpr std::size_t kSmall = 6;
constexpr double kZeros = 0.15;

}  // namespace

void BlockPattern::analyse(std::size_t count, std::span<const std::pair<int, int>> couplings) {
    static std::atomic<std::uint64_t> analyses{0};
    stamp_ = ++analyses;
    elimination_.begin(count);
    for (const auto& [a, b] : couplings)
        if (a != b) elimination_.join(a, b);
    elimination_.eliminate();
    sort_tree();
    gather_ends();
    merge_fronts();
    list_children();
}

/// Puts children in front of their parents, each beside its own, the one with most ends last: it may join.
void BlockPattern::sort_tree() {
    const std::size_t count = elimination_.order().size();
    const auto ends_of = [&](std::size_t k) {
        const auto [first, last] = elimination_.ends_of(k);
        return std::span(elimination_.ends()).subspan(first, last - first);
    };
    parent_.assign(count, -1);
    first_child_.assign(count + 1, 0);
    for (std::size_t k = 0; k < count; ++k) {
        for (const int end : ends_of(k)) {
            const int at = elimination_.position()[static_cast<std::size_t>(end)];
            if (parent_[k] < 0 || at < parent_[k]) parent_[k] = at;
        }
        if (parent_[k] >= 0) ++first_child_[static_cast<std::size_t>(parent_[k]) + 1];
    }
    for (std::size_t k = 0; k < count; ++k) first_child_[k + 1] += first_child_[k];
    child_.resize(first_child_[count]);
    next_.assign(first_child_.begin(), first_child_.end() - 1);
    for (std::size_t k = 0; k < count; ++k)
        if (parent_[k] >= 0) child_[next_[static_cast<std::size_t>(parent_[k])]++] = k;
    for (std::size_t k = 0; k < count; ++k)
        std::sort(child_.begin() + static_cast<std::ptrdiff_t>(first_child_[k]),
                  child_.begin() + static_cast<std::ptrdiff_t>(first_child_[k + 1]),
                  [&](std::size_t a, std::size_t b) {
                      return std::pair(ends_of(a).size(), a) < std::pair(ends_of(b).size(), b);
                  });
    position_.resize(count);
    node_.clear();
    next_.assign(first_child_.begin(), first_child_.end() - 1);
    for (std::size_t k = 0; k < count; ++k)
        if (parent_[k] < 0) visit(k);
}

/// A root's subtree in postorder.
void BlockPattern::visit(std::size_t root) {
    stack_.assign(1, root);
    while (!stack_.empty()) {
        const std::size_t k = stack_.back();
        if (next_[k] < first_child_[k + 1]) {
            stack_.push_back(child_[next_[k]++]);
            continue;
        }
        stack_.pop_back();
        const auto node = static_cast<std::size_t>(elimination_.order()[k]);
        position_[node] = node_.size();
        node_.push_back(node);
    }
}

/// By the new positions.
void BlockPattern::gather_ends() {
    all_ends_.clear(), all_first_.assign(1, 0);
    for (const std::size_t node : node_) {
        const auto [first, last] =
            elimination_.ends_of(static_cast<std::size_t>(elimination_.position()[node]));
        const auto begin = static_cast<std::ptrdiff_t>(all_ends_.size());
        for (std::size_t e = first; e < last; ++e)
            all_ends_.push_back(position_[static_cast<std::size_t>(elimination_.ends()[e])]);
        std::sort(all_ends_.begin() + begin, all_ends_.end());
        all_first_.push_back(all_ends_.size());
    }
}

/// Whether the node at the next position may join the front, which then holds `more` further zeros. Its ends
/// are all of the front's but itself.
bool BlockPattern::joins(const Front& front, std::size_t zeros, std::size_t position,
                         std::size_t& more) const {
    if (front.ends_first == front.ends_last || ends_[front.ends_first] != position) return false;
    const std::size_t own = front.last - front.first, held = front.ends_last - front.ends_first;
    const std::size_t ends = all_first_[position + 1] - all_first_[position];
    more = own * (ends + 1 - held);
    const double entries = static_cast<double>((own + 1) * (own + 1 + ends));
    return more == 0 || own + 1 + ends <= kSmall || static_cast<double>(zeros + more) <= kZeros * entries;
}

void BlockPattern::merge_fronts() {
    fronts_.clear(), ends_.clear();
    front_of_.resize(node_.size());
    std::size_t zeros = 0, more = 0;
    for (std::size_t k = 0; k < node_.size(); ++k) {
        if (!fronts_.empty() && joins(fronts_.back(), zeros, k, more)) {
            zeros += more;
            ends_.resize(fronts_.back().ends_first);
        } else {
            fronts_.push_back({k, k, ends_.size(), 0, 0, 0, -1});
            zeros = 0;
        }
        ends_.insert(ends_.end(), all_ends_.begin() + static_cast<std::ptrdiff_t>(all_first_[k]),
                     all_ends_.begin() + static_cast<std::ptrdiff_t>(all_first_[k + 1]));
        Front& front = fronts_.back();
        front.last = k + 1, front.ends_last = ends_.size();
        front_of_[k] = fronts_.size() - 1;
    }
}

void BlockPattern::list_children() {
    for (Front& front : fronts_)
        if (front.ends_first < front.ends_last) {
            front.parent = static_cast<int>(front_of_[ends_[front.ends_first]]);
            ++fronts_[static_cast<std::size_t>(front.parent)].children_last;  // for now their number
        }
    std::size_t first = 0;
    for (Front& front : fronts_) {
        front.children_first = first;
        first += front.children_last;
        front.children_last = front.children_first;
    }
    children_.resize(first);
    for (std::size_t f = 0; f < fronts_.size(); ++f)
        if (fronts_[f].parent >= 0)
            children_[fronts_[static_cast<std::size_t>(fronts_[f].parent)].children_last++] = f;
}

}  // namespace roboss
