// Bytes of messages: as an independent implementation writes them, back again, and what damaged ones do.
#include "ros2_types/cdr.h"

#include <gtest/gtest.h>

#include <random>

#include "core/hex.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/parameter_services.h"
#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {
namespace {

std::string hex(const std::string& bytes) {
    return hexadecimal({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

JointStateMessage joints() {
    JointStateMessage message;
    message.header = {{1, 500}, "a"};
    message.name = {"left", "right"}, message.position = {1, -2}, message.velocity = {0.5},
    message.effort = {};
    return message;
}

// The bytes are those of rosbags 0.11.9 (PyPI): python/tests/test_ros2.py compares all types with it.
TEST(Cdr, BytesAreAlignedAndLittleEndian) {
    EXPECT_EQ(hex(to_cdr(joints())),
              "00010000"
              "01000000f4010000"  // stamp
              "0200000061000000"  // "a", then two bytes to the next multiple of 4
              "02000000050000006c65667400000000060000007269676874000000"
              "02000000"  // positions, aligned to 8
              "000000000000f03f00000000000000c0"
              "0100000000000000000000000000e03f"
              "00000000");
}

TEST(Cdr, WhatIsWrittenIsRead) {
    const Result<JointStateMessage> read = from_cdr<JointStateMessage>(to_cdr(joints()));
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().name, joints().name);
    EXPECT_EQ(read.value().position, joints().position);
    EXPECT_EQ(read.value().velocity, joints().velocity);
    EXPECT_EQ(read.value().header.frame_id, "a");
    EXPECT_EQ(read.value().header.stamp.nanosec, 500u);
}

TEST(Cdr, BigEndianIsReadToo) {
    std::string bytes("\0\0\0\0\x3f\xf0\0\0\0\0\0\0\xc0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 28);
    const Result<Vector3> read = from_cdr<Vector3>(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().x, 1);
    EXPECT_EQ(read.value().y, -2);
    EXPECT_EQ(read.value().z, 0);
}

TEST(Cdr, MessagesThatEndTooSoonAreRefused) {
    const std::string bytes = to_cdr(joints());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Result<JointStateMessage> read = from_cdr<JointStateMessage>(bytes.substr(0, size));
        ASSERT_FALSE(read) << size;
        EXPECT_EQ(read.error().code, "bad-message");
    }
}

TEST(Cdr, LengthsBeyondTheEndAreRefusedBeforeMemoryIsTaken) {
    std::string bytes = to_cdr(ImageMessage{});
    bytes.replace(bytes.size() - 4, 4, "\xff\xff\xff\xff");
    const Result<ImageMessage> read = from_cdr<ImageMessage>(bytes);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().text().find("'data'"), std::string::npos) << read.error().text();
}

/// Counts how many of it were made.
struct Counted {
    static constexpr const char* kName = "test_msgs/msg/Counted";
    static inline std::size_t made = 0;
    Counted() { ++made; }
    std::string text;

    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("text", m.text);
    }
};
struct ManyCounted {
    static constexpr const char* kName = "test_msgs/msg/ManyCounted";
    std::vector<Counted> all;

    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("all", m.all);
    }
};

TEST(Cdr, ElementsAreMadeAsTheyAreRead) {
    std::string bytes("\0\1\0\0\0\0\x10\0\xff\xff\xff\xff", 12);  // 2^20 of them, the first is damaged
    bytes.resize(8 + (std::size_t{1} << 20));
    Counted::made = 0;
    EXPECT_FALSE(from_cdr<ManyCounted>(bytes));
    EXPECT_EQ(Counted::made, 1u);
    const std::string good = to_cdr(ManyCounted{{{}, {}, {}}});
    ASSERT_TRUE(from_cdr<ManyCounted>(good));
    EXPECT_EQ(from_cdr<ManyCounted>(good).value().all.size(), 3u);
}

TEST(Cdr, MessagesWithoutFieldsHaveAByte) {
    EXPECT_EQ(hex(to_cdr(Empty{})), "0001000000");
    EXPECT_TRUE(from_cdr<Empty>(to_cdr(Empty{})));
}

TEST(Cdr, SequencesOfBoolsAndBytesAreRead) {
    rcl_interfaces::ParameterValue value;
    value.type = rcl_interfaces::kBoolArray;
    value.bool_array_value = {true, false, true}, value.byte_array_value = {std::byte{7}};
    const Result<rcl_interfaces::ParameterValue> read =
        from_cdr<rcl_interfaces::ParameterValue>(to_cdr(value));
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().bool_array_value, value.bool_array_value);
    EXPECT_EQ(read.value().byte_array_value, value.byte_array_value);
}

TEST(Cdr, BoundedSequencesThatAreTooLongAreRefused) {
    rcl_interfaces::ParameterDescriptor descriptor;
    descriptor.integer_range.resize(1);
    EXPECT_TRUE(from_cdr<rcl_interfaces::ParameterDescriptor>(to_cdr(descriptor)));
    descriptor.integer_range.resize(2);
    EXPECT_FALSE(from_cdr<rcl_interfaces::ParameterDescriptor>(to_cdr(descriptor)));
}

TEST(Cdr, ChangedBytesNeverCrash) {
    std::mt19937 random(7);
    TFMessage frames;
    frames.transforms = {{{{1, 2}, "world"}, "car", {}}, {{{1, 2}, "car"}, "wheel", {}}};
    const std::string bytes = to_cdr(frames);
    for (int round = 0; round < 20'000; ++round) {
        std::string changed = bytes.substr(0, 1 + random() % bytes.size());
        for (int i = 0; i < 3; ++i) changed[random() % changed.size()] = static_cast<char>(random());
        const Result<TFMessage> read = from_cdr<TFMessage>(changed);
        if (read) {
            EXPECT_LE(read.value().transforms.size(), bytes.size());
        }
    }
}

}  // namespace
}  // namespace roboss::ros2
