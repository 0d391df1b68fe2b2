#include "fastdds/inbox.h"

#include <gtest/gtest.h>

using namespace roboss;
using roboss::fastdds::Inbox;

namespace {

ros2::Incoming message(ros2::EntityId entity, std::string bytes) {
    return {entity, {}, std::move(bytes), ""};
}

std::string all(Inbox& inbox) {
    std::string text;
    for (const ros2::Incoming& each : inbox.take(0)) text += each.bytes;
    return text;
}

}  // namespace

TEST(Inbox, MessagesComeInTheOrderOfTheirArrival) {
    Inbox inbox;
    for (const char* bytes : {"a", "b", "c", "d"}) EXPECT_TRUE(inbox.put(message(bytes[0] % 2, bytes), 10));
    EXPECT_EQ(all(inbox), "abcd");
    EXPECT_EQ(all(inbox), "");
}

TEST(Inbox, OldestMessagesOfAnEntityGoBeyondItsDepth) {
    Inbox inbox;
    EXPECT_TRUE(inbox.put(message(1, "a"), 2));
    EXPECT_TRUE(inbox.put(message(2, "x"), 2));
    EXPECT_TRUE(inbox.put(message(1, "b"), 2));
    EXPECT_FALSE(inbox.put(message(1, "c"), 2));
    EXPECT_EQ(all(inbox), "xbc");
}

TEST(Inbox, MessagesAndBytesHaveAnEnd) {
    Inbox inbox({.messages = 3, .bytes = 10});
    EXPECT_TRUE(inbox.put(message(1, "12345678"), 10));
    EXPECT_FALSE(inbox.put(message(2, "123"), 10));
    EXPECT_TRUE(inbox.put(message(2, "1"), 10));
    EXPECT_TRUE(inbox.put(message(3, "1"), 10));
    EXPECT_FALSE(inbox.put(message(4, ""), 10));
    inbox.forget(1);
    EXPECT_TRUE(inbox.put(message(2, "12345678"), 10));
    EXPECT_EQ(all(inbox), "1112345678");
}

TEST(Inbox, WakeEndsAWait) {
    Inbox inbox;
    inbox.wake();
    EXPECT_TRUE(inbox.take(60'000).empty());
}
