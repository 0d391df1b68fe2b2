// Telling orders ahead, and the rest of them.
#include "roles/order_feed.h"

#include <algorithm>
#include <numeric>

namespace roboss {

std::size_t OrderFeed::send_ahead(Bus& bus, OrderBook& book, const Round& round, const Roster& roster,
                                  Tick until, std::size_t least) {
    window_ = round.span().window;
    from_ = until_ = round.span().until;
    orders_.clear(), leaps_.clear();
    book.visit(from_, until, [this](const Order& order) { orders_.push_back(order); });
    if (orders_.size() >= std::max<std::size_t>(least, 1)) until_ = until;
    book.watch(from_, until_);
    if (until_ == from_) return 0;
    seat_.assign(round.seats().begin(), round.seats().end());
    std::vector<OrdersAhead> messages(roster.size());
    for (const Order& order : orders_) {
        messages[seat_[order.robot.index()]].orders.push_back(order);
        if (roboss::leaps(order)) leaps_.push_back(order);
    }
    told_.assign(roster.size(), false);
    for (std::uint32_t place = 0; place < messages.size(); ++place) {
        OrdersAhead& message = messages[place];
        if (message.orders.empty()) continue;
        told_[place] = true;
        message.window = window_;
        message.simulator = roster.id_of(place);
        bus.send(kControllerAddress, roster.address_of(place), std::move(message));
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

void OrderFeed::give_rest(OrderBook& book, Round& round) const {
    const RoundSpan& span = round.span();
    if (!covers(span.from)) return give_all(book, round);
    for (const Order& order : book.late())
        if (order.apply_at < span.until) round.give(order);
    for (std::size_t robot = 0; robot < seat_.size(); ++robot) {
        if (round.seats()[robot] == seat_[robot]) continue;
        for (std::uint32_t i = offsets_[robot]; i < offsets_[robot + 1]; ++i)
            if (const Order& order = orders_[of_robot_[i]]; order.apply_at < span.until) round.give(order);
    }
    book.visit(until_, span.until, [&round](const Order& order) { round.give(order); });
    round.give_ahead(window_, told_);
}

std::vector<Order> OrderFeed::leaps(OrderBook& book, Tick from, Tick until) const {
    std::vector<Order> leaps;
    const auto take = [&](const Order& order) {
        if (roboss::leaps(order) && order.apply_at < until) leaps.push_back(order);
    };
    if (!covers(from)) {
        book.visit(from, until, take);
        return leaps;
    }
    for (const Order& order : leaps_) take(order);
    for (const Order& order : book.late()) take(order);
    book.visit(until_, until, take);
    return leaps;
}

void give_all(OrderBook& book, Round& round) {
    book.visit(round.span().from, round.span().until, [&round](const Order& order) { round.give(order); });
}

void give_all(OrderBook& book, Plan& plan) {
    plan.ahead = 0;
    plan.orders.clear();
    std::vector<RobotId> robots = plan.robots;
    std::sort(robots.begin(), robots.end());
    book.visit(plan.from, plan.until, [&](const Order& order) {
        if (std::binary_search(robots.begin(), robots.end(), order.robot)) plan.orders.push_back(order);
    });
}

}  // namespace roboss
