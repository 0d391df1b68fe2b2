#include "foxglove/keep_last.h"

#include <gtest/gtest.h>

#include <string>

namespace roboss::foxglove {
namespace {

std::string all_of(KeepLast<std::string>& queue) {
    std::string all;
    while (const auto item = queue.take()) all += *item;
    return all;
}

TEST(KeepLast, TopicsKeepTheirNewestItemsInTheOrderOfAll) {
    KeepLast<std::string> queue;
    for (const char* item : {"a", "b", "c"}) {
        queue.push(1, 2, item);
        queue.push(2, 1, std::string("x") + item);
    }
    EXPECT_EQ(queue.waiting(1), 2u);
    EXPECT_EQ(queue.bytes(), 4u);
    EXPECT_EQ(queue.dropped(), 3u);
    EXPECT_EQ(all_of(queue), "bcxc");
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.bytes(), 0u);
}

TEST(KeepLast, ForgetsATopicAndDropsTheOldest) {
    KeepLast<std::string> queue;
    queue.push(1, 5, "a");
    queue.push(2, 5, "b");
    queue.push(1, 5, "c");
    queue.push(2, 5, "d");
    queue.drop_oldest();
    EXPECT_EQ(queue.waiting(1), 1u);
    queue.forget(2);
    queue.forget(3);
    EXPECT_EQ(queue.dropped(), 1u);
    EXPECT_EQ(all_of(queue), "c");
}

TEST(KeepLast, ADepthOfZeroKeepsOne) {
    KeepLast<std::string> queue;
    queue.push(1, 0, "a");
    queue.push(1, 0, "b");
    EXPECT_EQ(all_of(queue), "b");
}

}  // namespace
}  // namespace roboss::foxglove
