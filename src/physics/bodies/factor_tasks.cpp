// See factor_tasks.h.
#include "physics/bodies/factor_tasks.h"

#include <algorithm>

#include "physics/bodies/body_island.h"

namespace roboss {

void FactorTasks::plan(const BodyOrder& order, std::size_t threads) {
    list_updates(order);
    weigh(order);
    list_tasks(threads);
}

void FactorTasks::list_updates(const BodyOrder& order) {
    const std::vector<BodyOrder::Pivot>& pivots = order.pivots();
    first_update_.assign(pivots.size() + 1, 0);
    for (const int body : order.ends()) ++first_update_[order.position(body)];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_update_) first = sum += first;
    updates_.resize(sum);
    for (std::size_t k = pivots.size(); k-- > 0;)
        for (std::size_t e = pivots[k].first; e < pivots[k].last; ++e)
            updates_[--first_update_[order.position(order.ends()[e])]] = {static_cast<std::uint32_t>(k),
                                                                          static_cast<std::uint32_t>(e)};
}

/// The elimination tree, and how many blocks the pivots of each subtree update.
void FactorTasks::weigh(const BodyOrder& order) {
    const std::vector<BodyOrder::Pivot>& pivots = order.pivots();
    parents_.assign(pivots.size(), static_cast<std::uint32_t>(pivots.size()));
    weights_.assign(pivots.size() + 1, 0);
    for (std::size_t k = 0; k < pivots.size(); ++k) {
        for (std::size_t e = pivots[k].first; e < pivots[k].last; ++e)
            parents_[k] = std::min(parents_[k], static_cast<std::uint32_t>(order.position(order.ends()[e])));
        const auto edges = static_cast<double>(pivots[k].last - pivots[k].first);
        weights_[k] += 2 + edges * (edges + 5) / 2;
        weights_[parents_[k]] += weights_[k];
    }
}

/// Subtrees as large as a fair share allows, the heaviest first, then what is above them.
void FactorTasks::list_tasks(std::size_t threads) {
    constexpr double kPerThread = 6;
    const auto count = static_cast<std::uint32_t>(parents_.size());
    const double most = weights_[count] / (kPerThread * static_cast<double>(threads));
    roots_.clear();
    for (std::uint32_t k = 0; k < count; ++k)
        if (weights_[k] <= most && (parents_[k] == count || weights_[parents_[k]] > most))
            roots_.push_back(k);
    std::ranges::sort(roots_, [&](std::uint32_t a, std::uint32_t b) {
        return weights_[a] != weights_[b] ? weights_[a] > weights_[b] : a < b;
    });
    auto tasks = static_cast<std::uint32_t>(roots_.size());
    task_of_.assign(count, 0);
    for (std::uint32_t r = 0; r < roots_.size(); ++r) task_of_[roots_[r]] = r;
    for (std::uint32_t k = 0; k < count; ++k)
        if (weights_[k] > most) task_of_[k] = tasks++;
    for (std::uint32_t k = count; k-- > 0;)
        if (weights_[k] <= most && parents_[k] != count && weights_[parents_[k]] <= most)
            task_of_[k] = task_of_[parents_[k]];
    first_.assign(tasks + 1, 0);
    for (const std::uint32_t task : task_of_) ++first_[task];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_) first = sum += first;
    sequence_.resize(count);
    for (std::uint32_t k = count; k-- > 0;) sequence_[--first_[task_of_[k]]] = k;
}

}  // namespace roboss
