// Orders in canonical order; new ones are merged in before the next read.
#include "roles/controller/order_log.h"

#include <algorithm>

namespace roboss {

bool OrderLog::add(const Order& order, Tick given_at) {
    // orders of a file may also come from a saved run; those of Clients are numbered
    if (!order.client.valid() && !given_.insert({order.apply_at, order.client, order.sequence}).second)
        return false;
    fresh_.push_back({order, given_at});
    if (late_from_ <= order.apply_at && order.apply_at < late_until_) late_.push_back(order);
    return true;
}

void OrderLog::settle() {
    if (fresh_.empty()) return;
    const auto before = [](const LoggedOrder& a, const LoggedOrder& b) {
        return comes_before(a.order, b.order);
    };
    std::sort(fresh_.begin(), fresh_.end(), before);
    const auto middle = static_cast<std::ptrdiff_t>(entries_.size());
    const bool in_order = first_ == entries_.size() || !before(fresh_.front(), entries_.back());
    entries_.insert(entries_.end(), fresh_.begin(), fresh_.end());
    if (!in_order) std::inplace_merge(begin(), entries_.begin() + middle, entries_.end(), before);
    fresh_.clear();
}

std::vector<LoggedOrder>::iterator OrderLog::first_at(Tick tick) {
    const auto earlier = [](const LoggedOrder& e, Tick t) { return e.order.apply_at < t; };
    return std::lower_bound(begin(), entries_.end(), tick, earlier);
}

void OrderLog::watch(Tick from, Tick until) {
    late_from_ = from;
    late_until_ = until;
    late_.clear();
}

std::vector<LoggedOrder> OrderLog::pending(Tick tick) {
    settle();
    std::vector<LoggedOrder> orders;
    for (auto e = begin(); e != entries_.end(); ++e)
        if (e->order.apply_at >= tick && e->given_at < tick) orders.push_back(*e);
    return orders;
}

void OrderLog::trim(Tick tick) {
    settle();
    first_ = static_cast<std::size_t>(first_at(tick) - entries_.begin());
    if (2 * first_ > entries_.size()) {  // so that each is moved but a few times
        entries_.erase(entries_.begin(), begin());
        first_ = 0;
    }
    given_.erase(given_.begin(), given_.lower_bound({tick, ClientId(0u), 0}));
}

}  // namespace roboss
