// The order log keeps canonical order whatever comes when.
#include "roles/order_book.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

Order order(Tick at, std::uint32_t client, std::uint64_t sequence) {
    return {at, ClientId(client), sequence, RobotId(0u), SetVelocity{}};
}

std::vector<Order> between(OrderBook& book, Tick from, Tick until) {
    std::vector<Order> orders;
    book.visit(from, until, [&](const Order& o) { orders.push_back(o); });
    return orders;
}

TEST(OrderBook, SortsByTickThenClientThenSequence) {
    OrderBook book;
    book.add(order(5, 1, 2), 3);
    book.add(order(4, 2, 1), 3);
    EXPECT_EQ(between(book, 0, 10).size(), 2u);
    book.add(order(5, 1, 1), 3);
    book.add(order(5, 0, 9), 3);
    const std::vector<Order> all = between(book, 4, 6);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].client, ClientId(2u));
    EXPECT_EQ(all[1].client, ClientId(0u));
    EXPECT_EQ(all[2].sequence, 1u);
    EXPECT_EQ(all[3].sequence, 2u);
    EXPECT_EQ(between(book, 4, 5).size(), 1u);
    EXPECT_TRUE(between(book, 6, 9).empty());
}

TEST(OrderBook, TakesAGivenOrderOnce) {
    OrderBook book;
    EXPECT_TRUE(book.add(order(5, ClientId().value, 1), -1));
    EXPECT_FALSE(book.add(order(5, ClientId().value, 1), -1));
    EXPECT_TRUE(book.add(order(6, ClientId().value, 1), -1));
    EXPECT_EQ(book.size(), 2u);
}

TEST(OrderBook, TellsWhatCameAmongThoseThatAreWatched) {
    OrderBook book;
    book.add(order(12, 0, 1), 3);
    book.watch(10, 20);
    EXPECT_TRUE(book.late().empty()) << "it was there before";
    for (const Tick at : {9, 10, 20, 19}) book.add(order(at, 0, 2 + static_cast<std::uint64_t>(at)), 3);
    ASSERT_EQ(book.late().size(), 2u);
    EXPECT_EQ(book.late()[0].apply_at, 10);
    EXPECT_EQ(book.late()[1].apply_at, 19);
    book.watch(20, 30);
    EXPECT_TRUE(book.late().empty());
    EXPECT_EQ(between(book, 0, 30).size(), 5u);
}

TEST(OrderBook, SavesWhatTheRestoredRunWillNotOrderAgain) {
    OrderBook book;
    book.add(order(30, 0, 1), 10);                 // ordered on seeing tick 10: goes along
    book.add(order(40, 0, 2), 20);                 // on seeing tick 20: a run restored at 20 sees that itself
    book.add(order(19, 0, 3), 5);                  // past
    book.add(order(50, ClientId().value, 1), -1);  // from a file: goes along
    const std::vector<SaidOrder> pending = book.pending(20);
    ASSERT_EQ(pending.size(), 2u);
    EXPECT_EQ(pending[0].order.apply_at, 30);
    EXPECT_EQ(pending[1].order.apply_at, 50);
    book.trim(35);
    EXPECT_EQ(book.size(), 2u);
}

}  // namespace
}  // namespace roboss
