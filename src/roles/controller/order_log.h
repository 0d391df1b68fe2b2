// OrderLog: every accepted order since the last recovery checkpoint, in canonical order. Windows and
// recoveries both take their orders from here.
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "journal/log_entries.h"

namespace roboss {

class OrderLog {
  public:
    /// Adds an order that was checked and has its tick. `given_at`: the tick that it answers, or at which it
    /// was given. False: an order with this (apply_at, client, sequence) is here already (one without Client,
    /// from a file say, may come twice); nothing changes.
    bool add(const Order& order, Tick given_at);
    /// Calls visit(order) for those with from <= apply_at < until, canonical order.
    template <class Visit>
    void visit(Tick from, Tick until, Visit&& visit) {
        if (from >= until) return;
        settle();
        for (auto e = first_at(from); e != entries_.end() && e->order.apply_at < until; ++e) visit(e->order);
    }
    /// Orders added from now on with from <= apply_at < until also go to late().
    void watch(Tick from, Tick until);
    const std::vector<Order>& late() const { return late_; }
    /// Orders that a run saved at `tick` includes: those still to be applied that do not answer an
    /// observation of `tick` or later (the restored run observes those ticks itself).
    std::vector<LoggedOrder> pending(Tick tick);
    /// Forgets orders with apply_at < tick.
    void trim(Tick tick);
    std::size_t size() const { return entries_.size() - first_ + fresh_.size(); }

  private:
    void settle();
    /// The first with apply_at >= tick.
    std::vector<LoggedOrder>::iterator first_at(Tick tick);
    std::vector<LoggedOrder>::iterator begin() {
        return entries_.begin() + static_cast<std::ptrdiff_t>(first_);
    }

    std::vector<LoggedOrder> entries_;  // canonical order
    std::size_t first_ = 0;             // of them; those before are forgotten
    std::vector<LoggedOrder> fresh_;    // not sorted in yet
    Tick late_from_ = 0, late_until_ = 0;
    std::vector<Order> late_;
    std::set<std::tuple<Tick, ClientId, std::uint64_t>> given_;
};

}  // namespace roboss
