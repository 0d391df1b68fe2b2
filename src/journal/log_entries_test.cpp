// The log's bytes give back what was written, and no bytes can break their decoders.
#include "journal/log_entries.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss {
namespace {

LogBatch a_batch() {
    LogBatch batch;
    batch.orders = {
        {{5, ClientId(0u), 1, RobotId(2u), SetVelocity{{1, 2, 3}, {4, 5, 6}}}, 3},
        {{5, ClientId(), 7, RobotId(0u), ApplyWrench{LinkId(1u), {1, 0, 0}, {}, 9}}, -1},
        {{6, ClientId(1u), 2, RobotId(1u), SetJoint{JointId(0u), 0, MotorMode::kEffort, 2.5, 1}}, 4}};
    batch.replies = {{ClientId(0u), 3}, {ClientId(1u), 4}};
    batch.notes = {{4, "paused"}, {5, ""}};
    batch.clients = {{0, "driver"}, {1, "other"}};
    return batch;
}

TEST(LogEntries, GiveBackWhatWasWritten) {
    const std::vector<std::uint8_t> bytes = encode(a_batch());
    const Result<LogBatch> back = decode_batch(bytes);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value().replies, a_batch().replies);
    EXPECT_EQ(back.value().notes, a_batch().notes);
    EXPECT_EQ(back.value().clients, a_batch().clients);
    ASSERT_EQ(back.value().orders.size(), 3u);
    EXPECT_EQ(back.value().orders[1].given_at, -1);
    EXPECT_EQ(back.value().orders[2].order.robot, RobotId(1u));
    EXPECT_EQ(encode(back.value()), bytes);
    EXPECT_TRUE(decode_batch(encode(LogBatch{})).value().empty());
}

TEST(LogEntries, LaterOnesComeBehind) {
    LogBatch batch = a_batch();
    batch.append(a_batch());
    EXPECT_EQ(batch.orders.size(), 6u);
    EXPECT_EQ(batch.replies.size(), 4u);
    EXPECT_EQ(batch.clients.size(), 2u);
}

TEST(LogEntries, EveryTruncationIsRefusedByName) {
    const std::vector<std::uint8_t> bytes = encode(a_batch());
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        const Result<LogBatch> back = decode_batch(std::span(bytes).first(n));
        ASSERT_FALSE(back.ok()) << "cut to " << n;
        EXPECT_NE(back.error().message.find("damaged"), std::string::npos) << back.error().message;
    }
}

/// Random changes of good bytes, and noise: refused, or understood as something that is written the same way.
template <class Decode, class Encode>
void fuzz(const std::vector<std::uint8_t>& good, Decode decode_bytes, Encode encode_value) {
    std::mt19937_64 random(20261121);
    int refused = 0;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::uint8_t> bytes = good;
        if (i % 4 == 0) bytes.resize(random() % (good.size() + 8));
        for (std::uint64_t k = 0; k < 1 + random() % 4 && !bytes.empty(); ++k)
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        const auto back = decode_bytes(bytes);
        if (!back.ok()) {
            ++refused;
            EXPECT_FALSE(back.error().message.empty());
        } else {
            EXPECT_EQ(encode_value(back.value()).size(), bytes.size());
        }
    }
    EXPECT_GT(refused, 5000);
}

TEST(LogEntries, RefuseOrUnderstandEveryMutation) {
    fuzz(
        encode(a_batch()), [](const auto& bytes) { return decode_batch(bytes); },
        [](const LogBatch& batch) { return encode(batch); });
}

TEST(LogEntries, MemoryOfProgramsIsGivenBackAndFuzzed) {
    const ClientMemory memory{{"a", "12"}, {"b", std::string("\0x", 2)}};
    const std::vector<std::uint8_t> bytes = encode_memory(memory);
    ASSERT_TRUE(decode_memory(bytes).ok());
    EXPECT_EQ(decode_memory(bytes).value(), memory);
    fuzz(
        bytes, [](const auto& b) { return decode_memory(b); },
        [](const ClientMemory& m) { return encode_memory(m); });
}

}  // namespace
}  // namespace roboss
