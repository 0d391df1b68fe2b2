// Orders in canonical order; new ones are merged in when somebody reads.
#include "roles/order_book.h"

#include <algorithm>

namespace roboss {

bool OrderBook::add(const Order& order, Tick said) {
    // those from a file come from a saved run too; words of Clients are numbered
    if (!order.client.valid() && !given_.insert({order.apply_at, order.client, order.sequence}).second)
        return false;
    fresh_.push_back({order, said});
    if (late_from_ <= order.apply_at && order.apply_at < late_until_) late_.push_back(order);
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

std::vector<SaidOrder>::iterator OrderBook::first_at(Tick tick) {
    const auto earlier = [](const SaidOrder& e, Tick t) { return e.order.apply_at < t; };
    return std::lower_bound(begin(), entries_.end(), tick, earlier);
}

void OrderBook::watch(Tick from, Tick until) {
    late_from_ = from;
    late_until_ = until;
    late_.clear();
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
    first_ = static_cast<std::size_t>(first_at(tick) - entries_.begin());
    if (2 * first_ > entries_.size()) {  // so that each is moved but a few times
        entries_.erase(entries_.begin(), begin());
        first_ = 0;
    }
    given_.erase(given_.begin(), given_.lower_bound({tick, ClientId(0u), 0}));
}

}  // namespace roboss
