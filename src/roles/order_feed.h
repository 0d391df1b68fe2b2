// How orders get from the order log into plans. Those of the next window are told while Simulators step this
// one, so that its plans, for which everybody waits, hold only what came since.
#pragma once

#include <vector>

#include "bus/bus.h"
#include "plan/forecast.h"
#include "roles/order_book.h"
#include "roles/roster.h"
#include "roles/round.h"

namespace roboss {

class OrderFeed {
  public:
    /// Sends the orders for the ticks from the end of `round` to `until` to who steps their robots in it,
    /// unless these are fewer than `least`. Once a window. Returns how many were sent.
    std::size_t send_ahead(Bus& bus, OrderBook& book, const Round& round, const Roster& roster, Tick until,
                           std::size_t least);
    bool sent_in(std::uint64_t window) const { return window_ == window; }
    /// Gives the plans of a window's first attempt what their Simulators were not told.
    void give_rest(OrderBook& book, Round& round) const;
    /// Orders of these ticks that a forecast asks for.
    std::vector<Order> leaps(OrderBook& book, Tick from, Tick until) const;

  private:
    bool covers(Tick from) const { return from_ == from && until_ > from_; }
    void sort_by_robot(std::size_t robots);

    std::uint64_t window_ = 0;  // in which they were told
    Tick from_ = 0, until_ = 0;
    std::vector<Order> orders_, leaps_;              // canonical order
    std::vector<std::uint32_t> offsets_, of_robot_;  // by RobotId: places in orders_
    std::vector<std::uint32_t> seat_;                // by RobotId: who was told
    std::vector<bool> told_;                         // by seat: something was
};

/// Gives the plans of this attempt all their orders.
void give_all(OrderBook& book, Round& round);
/// Gives a plan all its orders, whatever was told ahead.
void give_all(OrderBook& book, Plan& plan);

}  // namespace roboss
