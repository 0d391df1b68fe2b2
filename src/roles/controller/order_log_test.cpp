// The order log keeps canonical order whatever comes when.
#include "roles/controller/order_log.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

Order order(Tick at, std::uint32_t client, std::uint64_t sequence) {
    return {at, ClientId(client), sequence, RobotId(0u), SetVelocity{}};
}

std::vector<Order> between(OrderLog& order_log, Tick from, Tick until) {
    std::vector<Order> orders;
    order_log.visit(from, until, [&](const Order& o) { orders.push_back(o); });
    return orders;
}

TEST(OrderLog, SortsByTickThenClientThenSequence) {
    OrderLog order_log;
    order_log.add(order(5, 1, 2), 3);
    order_log.add(order(4, 2, 1), 3);
    EXPECT_EQ(between(order_log, 0, 10).size(), 2u);
    order_log.add(order(5, 1, 1), 3);
    order_log.add(order(5, 0, 9), 3);
    const std::vector<Order> all = between(order_log, 4, 6);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].client, ClientId(2u));
    EXPECT_EQ(all[1].client, ClientId(0u));
    EXPECT_EQ(all[2].sequence, 1u);
    EXPECT_EQ(all[3].sequence, 2u);
    EXPECT_EQ(between(order_log, 4, 5).size(), 1u);
    EXPECT_TRUE(between(order_log, 6, 9).empty());
}

TEST(OrderLog, TakesAGivenOrderOnce) {
    OrderLog order_log;
    EXPECT_TRUE(order_log.add(order(5, ClientId().value, 1), -1));
    EXPECT_FALSE(order_log.add(order(5, ClientId().value, 1), -1));
    EXPECT_TRUE(order_log.add(order(6, ClientId().value, 1), -1));
    EXPECT_EQ(order_log.size(), 2u);
}

TEST(OrderLog, TellsWhatCameAmongThoseThatAreWatched) {
    OrderLog order_log;
    order_log.add(order(12, 0, 1), 3);
    order_log.watch(10, 20);
    EXPECT_TRUE(order_log.late().empty()) << "it was there before";
    for (const Tick at : {9, 10, 20, 19}) order_log.add(order(at, 0, 2 + static_cast<std::uint64_t>(at)), 3);
    ASSERT_EQ(order_log.late().size(), 2u);
    EXPECT_EQ(order_log.late()[0].apply_at, 10);
    EXPECT_EQ(order_log.late()[1].apply_at, 19);
    order_log.watch(20, 30);
    EXPECT_TRUE(order_log.late().empty());
    EXPECT_EQ(between(order_log, 0, 30).size(), 5u);
}

TEST(OrderLog, SavesWhatTheRestoredRunWillNotOrderAgain) {
    OrderLog order_log;
    order_log.add(order(30, 0, 1), 10);  // ordered on seeing tick 10: goes along
    order_log.add(order(40, 0, 2), 20);  // on seeing tick 20: a run restored at 20 sees that itself
    order_log.add(order(19, 0, 3), 5);   // past
    order_log.add(order(50, ClientId().value, 1), -1);  // from a file: goes along
    const std::vector<LoggedOrder> pending = order_log.pending(20);
    ASSERT_EQ(pending.size(), 2u);
    EXPECT_EQ(pending[0].order.apply_at, 30);
    EXPECT_EQ(pending[1].order.apply_at, 50);
    order_log.trim(35);
    EXPECT_EQ(order_log.size(), 2u);
}

}  // namespace
}  // namespace roboss
