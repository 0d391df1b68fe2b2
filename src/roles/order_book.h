// The order log: every accepted order in canonical order, from the last recovery checkpoint on. What a window
// applies and what a recovery applies again both come from here.
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "journal/log_entries.h"

namespace roboss {

class OrderBook {
  public:
    /// Takes an order that was checked and stamped. `said`: the tick it answers, or at which it was given. An
    /// order without Client (from a file, say) may come twice. False: one with this (apply_at, client,
    /// sequence) is here already, and nothing changes.
    bool add(const Order& order, Tick said);
    /// Calls visit(order) for those with from <= apply_at < until, canonical order.
    template <class Visit>
    void visit(Tick from, Tick until, Visit&& visit) {
        if (from >= until) return;
        settle();
        for (auto e = first_at(from); e != entries_.end() && e->order.apply_at < until; ++e) visit(e->order);
    }
    /// From now on those that are added with from <= apply_at < until are also among late(), as they come.
    void watch(Tick from, Tick until);
    const std::vector<Order>& late() const { return late_; }
    /// What a run saved at `tick` must take along: orders still to come that do not answer an observation of
    /// `tick` or later (the restored run observes those ticks itself).
    std::vector<SaidOrder> pending(Tick tick);
    /// Forgets orders with apply_at < tick.
    void trim(Tick tick);
    std::size_t size() const { return entries_.size() - first_ + fresh_.size(); }

  private:
    void settle();
    /// The first with apply_at >= tick.
    std::vector<SaidOrder>::iterator first_at(Tick tick);
    std::vector<SaidOrder>::iterator begin() {
        return entries_.begin() + static_cast<std::ptrdiff_t>(first_);
    }

    std::vector<SaidOrder> entries_;  // canonical order
    std::size_t first_ = 0;           // of them; those before are forgotten
    std::vector<SaidOrder> fresh_;    // not sorted in yet
    Tick late_from_ = 0, late_until_ = 0;
    std::vector<Order> late_;
    std::set<std::tuple<Tick, ClientId, std::uint64_t>> given_;
};

}  // namespace roboss
