// Sends orders ahead, and the rest with the assignments.
#include "roles/controller/order_feed.h"

#include <algorithm>
#include <numeric>

namespace roboss {

std::size_t OrderFeed::send_ahead(Bus& bus, OrderLog& order_log, const Round& round, const Roster& roster,
                                  Tick until, std::size_t least) {
    window_ = round.span().window;
    from_ = until_ = round.span().until;
    orders_.clear(), leaps_.clear();
    order_log.visit(from_, until, [this](const Order& order) { orders_.push_back(order); });
    if (orders_.size() >= std::max<std::size_t>(least, 1)) until_ = until;
    order_log.watch(from_, until_);
    if (until_ == from_) return 0;
    seat_.assign(round.seats().begin(), round.seats().end());
    std::vector<OrdersAhead> messages(roster.size());
    for (const Order& order : orders_) {
        messages[seat_[order.robot.index()]].orders.push_back(order);
        if (roboss::leaps(order)) leaps_.push_back(order);
    }
    sent_ahead_.assign(roster.size(), false);
    for (SeatId seat_id = 0; seat_id < messages.size(); ++seat_id) {
        OrdersAhead& message = messages[seat_id];
        if (message.orders.empty()) continue;
        sent_ahead_[seat_id] = true;
        message.window = window_;
        message.simulator = roster.id_of(seat_id);
        bus.send(kControllerAddress, roster.address_of(seat_id), std::move(message));
    }
    sort_by_robot(seat_.size());
    return orders_.size();
}

void OrderFeed::sort_by_robot(std::size_t robots) {
    offsets_.assign(robots + 1, 0);
    for (const Order& order : orders_) ++offsets_[order.robot.index() + 1];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    of_robot_.resize(orders_.size());
    for (std::uint32_t i = 0; i < orders_.size(); ++i) of_robot_[next[orders_[i].robot.index()]++] = i;
}

void OrderFeed::give_rest(OrderLog& order_log, Round& round) const {
    const RoundSpan& span = round.span();
    if (!covers(span.from)) return give_all(order_log, round);
    for (const Order& order : order_log.late())
        if (order.apply_at < span.until) round.give(order);
    for (std::size_t robot = 0; robot < seat_.size(); ++robot) {
        if (round.seats()[robot] == seat_[robot]) continue;
        for (std::uint32_t i = offsets_[robot]; i < offsets_[robot + 1]; ++i)
            if (const Order& order = orders_[of_robot_[i]]; order.apply_at < span.until) round.give(order);
    }
    order_log.visit(until_, span.until, [&round](const Order& order) { round.give(order); });
    round.give_ahead(window_, sent_ahead_);
}

std::vector<Order> OrderFeed::leaps(OrderLog& order_log, Tick from, Tick until) const {
    std::vector<Order> leaps;
    const auto take = [&](const Order& order) {
        if (roboss::leaps(order) && order.apply_at < until) leaps.push_back(order);
    };
    if (!covers(from)) {
        order_log.visit(from, until, take);
        return leaps;
    }
    for (const Order& order : leaps_) take(order);
    for (const Order& order : order_log.late()) take(order);
    order_log.visit(until_, until, take);
    return leaps;
}

void give_all(OrderLog& order_log, Round& round) {
    order_log.visit(round.span().from, round.span().until,
                    [&round](const Order& order) { round.give(order); });
}

void give_all(OrderLog& order_log, Assignment& assignment) {
    assignment.ahead = 0;
    assignment.orders.clear();
    std::vector<RobotId> robots = assignment.robots;
    std::sort(robots.begin(), robots.end());
    order_log.visit(assignment.from, assignment.until, [&](const Order& order) {
        if (std::binary_search(robots.begin(), robots.end(), order.robot)) assignment.orders.push_back(order);
    });
}

}  // namespace roboss
