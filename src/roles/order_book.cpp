// Orders in canonical order; new ones are merged in when somebody reads.
#include "roles/order_book.h"

#include <algorithm>

namespace roboss {

bool OrderBook::add(const Order& order, Tick said) {
    // those from a file come from a saved run too; words of Clients are numbered
    if (!order.client.valid() && !given_.insert({order.apply_at, order.client, order.sequence}).second)
        return false;
    fresh_.push_back({order, said});
    return true;
}

void OrderBook::settle() {
    if (fresh_.empty()) return;
    const auto before = [](const SaidOrder& a, const SaidOrder& b) { return comes_before(a.order, b.order); };
    std::sort(fresh_.begin(), fresh_.end(), before);
    const auto middle = static_cast<std::ptrdiff_t>(entries_.size());
    const bool in_order = first_ == entries_.size() || !before(fresh_.front(), entries_.back());
    entries_.insert(entries_.end(), fresh_.begin(), fresh_.end());
    if (!in_order) std::inplace_merge(begin(), entries_.begin() + middle, entries_.end(), before);
    fresh_.clear();
}

std::vector<Order> OrderBook::between(Tick from, Tick until) {
    settle();
    const auto earlier = [](const SaidOrder& e, Tick tick) { return e.order.apply_at < tick; };
    const auto first = std::lower_bound(begin(), entries_.end(), from, earlier);
    const auto last = std::lower_bound(first, entries_.end(), until, earlier);
    std::vector<Order> orders;
    orders.reserve(static_cast<std::size_t>(last - first));
    for (auto it = first; it != last; ++it) orders.push_back(it->order);
    return orders;
}

std::vector<SaidOrder> OrderBook::pending(Tick tick) {
    settle();
    std::vector<SaidOrder> orders;
    for (auto e = begin(); e != entries_.end(); ++e)
        if (e->order.apply_at >= tick && e->said < tick) orders.push_back(*e);
    return orders;
}

void OrderBook::trim(Tick tick) {
    settle();
    const auto earlier = [](const SaidOrder& e, Tick t) { return e.order.apply_at < t; };
    first_ =
        static_cast<std::size_t>(std::lower_bound(begin(), entries_.end(), tick, earlier) - entries_.begin());
    if (2 * first_ > entries_.size()) {  // so that each is moved but a few times
        entries_.erase(entries_.begin(), begin());
        first_ = 0;
    }
    given_.erase(given_.begin(), given_.lower_bound({tick, ClientId(0u), 0}));
}

}  // namespace roboss
