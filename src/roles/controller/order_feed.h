// OrderFeed: orders go from the order log into assignments. Orders of the next window are sent while
// Simulators step this one, so that the next assignments, for which everybody waits, hold only the orders
// since then.
#pragma once

#include <vector>

#include "bus/bus.h"
#include "roles/controller/order_log.h"
#include "roles/controller/roster.h"
#include "roles/controller/round.h"
#include "schedule/forecast.h"

namespace roboss {

class OrderFeed {
  public:
    /// Sends the orders for the ticks from the end of `round` to `until` to the Simulators that step their
    /// robots in it, unless there are fewer than `least`. Once per window. Returns how many were sent.
    std::size_t send_ahead(Bus& bus, OrderLog& order_log, const Round& round, const Roster& roster,
                           Tick until, std::size_t least);
    bool sent_in(std::uint64_t window) const { return window_ == window; }
    /// Adds to the assignments of a window's first attempt the orders that were not sent ahead.
    void give_rest(OrderLog& order_log, Round& round) const;
    /// Orders of these ticks that a forecast asks for.
    std::vector<Order> leaps(OrderLog& order_log, Tick from, Tick until) const;

  private:
    bool covers(Tick from) const { return from_ == from && until_ > from_; }
    void sort_by_robot(std::size_t robots);

    std::uint64_t window_ = 0;  // in which they were sent
    Tick from_ = 0, until_ = 0;
    std::vector<Order> orders_, leaps_;              // canonical order
    std::vector<std::uint32_t> offsets_, of_robot_;  // by RobotId: indices into orders_
    std::vector<SeatId> seat_;                       // by RobotId: seat that got them
    std::vector<bool> sent_ahead_;                   // by seat: whether it got some
};

/// Adds all orders to the assignments of this attempt.
void give_all(OrderLog& order_log, Round& round);
/// Adds all orders to an assignment, whatever was sent ahead.
void give_all(OrderLog& order_log, Assignment& assignment);

}  // namespace roboss
