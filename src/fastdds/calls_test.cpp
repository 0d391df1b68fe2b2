#include "fastdds/calls.h"

#include <gtest/gtest.h>

using namespace roboss;
using namespace roboss::fastdds;

namespace {

Guid guid_of(std::uint8_t participant, std::uint8_t own) {
    Guid guid{};
    guid[0] = 1, guid[1] = 0x0f, guid[11] = participant, guid[15] = own;
    return guid;
}

const std::string kRequest("\0\1\0\0\7", 5);
const std::string kHeader("client 8\3\0\0\0\0\0\0\0", 16);
const std::string kBigHeader("8 tneilc\0\0\0\0\0\0\0\3", 16);

std::string with_header(std::string bytes, const std::string& header) {
    return bytes.insert(4, header);
}

}  // namespace

TEST(Calls, ReaderThatARequestNamesGetsTheReply) {
    Calls calls;
    const auto request = calls.open({guid_of(1, 2), 5, guid_of(1, 3), kRequest, false});
    ASSERT_TRUE(request);
    EXPECT_EQ(request->bytes, kRequest);
    const auto reply = calls.close(request->call, kRequest);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->related, guid_of(1, 3));
    EXPECT_EQ(reply->number, 5);
    EXPECT_TRUE(has_reader({guid_of(1, 3)}, *reply));
    EXPECT_FALSE(has_reader({guid_of(1, 2), guid_of(1, 4)}, *reply));
}

TEST(Calls, PlainRequestIsAnsweredToItsParticipant) {
    Calls calls;
    const auto request = calls.open({guid_of(1, 2), 5, Guid{}, kRequest, false});
    ASSERT_TRUE(request);
    const auto reply = calls.close(request->call, kRequest);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->related, guid_of(1, 2));
    EXPECT_TRUE(has_reader({guid_of(0, 9), guid_of(1, 7)}, *reply));
    EXPECT_FALSE(has_reader({guid_of(0, 9), guid_of(2, 7)}, *reply));
}

TEST(Calls, HeaderOfCycloneIsTakenOffAndPutBack) {
    for (const bool is_big : {false, true}) {
        Calls calls;
        std::string bytes = with_header(kRequest, is_big ? kBigHeader : kHeader);
        if (is_big) bytes[1] = 0;
        const auto request = calls.open({guid_of(1, 2), 9, Guid{}, bytes, true});
        ASSERT_TRUE(request);
        EXPECT_EQ(request->bytes.substr(4), kRequest.substr(4));
        EXPECT_EQ(request->call.number, 3);
        const auto reply = calls.close(request->call, kRequest);
        ASSERT_TRUE(reply);
        EXPECT_EQ(reply->bytes, with_header(kRequest, kHeader));
        EXPECT_FALSE(calls.close(request->call, kRequest)) << "a call has one reply";
    }
}

TEST(Calls, VendorOrAHalfOfTheGuidTellsTheDialectOfCyclone) {
    Calls calls;
    Guid cyclone = guid_of(1, 2);
    cyclone[1] = 0x10;
    EXPECT_EQ(calls.open({cyclone, 1, Guid{}, with_header(kRequest, kHeader), false})->bytes, kRequest);
    const Guid other = guid_of(1, 2);
    const std::string half(reinterpret_cast<const char*>(other.data()) + 8, 8);
    const std::string own_header = half + std::string("\3\0\0\0\0\0\0\0", 8);
    EXPECT_EQ(calls.open({other, 1, Guid{}, with_header(kRequest, own_header), false})->bytes, kRequest);
    EXPECT_NE(calls.open({other, 1, Guid{}, with_header(kRequest, kHeader), false})->bytes, kRequest);
}

TEST(Calls, BytesThatAreNoCdrAreNoRequest) {
    Calls calls;
    for (const std::string& bytes : {std::string(), std::string("\0\1\0", 3), std::string("\0\3\0\0", 4),
                                     std::string("\1\1\0\0", 4), std::string(100, '\xff')})
        EXPECT_FALSE(calls.open({guid_of(1, 2), 5, Guid{}, bytes, true}));
}

TEST(Calls, CallsThatNobodyAnswersDoNotPileUp) {
    Calls calls;
    std::optional<ros2::Incoming> first, last;
    for (int i = 0; i < 20'000; ++i) {
        std::string header = kHeader;
        header[8] = static_cast<char>(i), header[9] = static_cast<char>(i >> 8);
        last = calls.open({guid_of(1, 2), i, Guid{}, with_header(kRequest, header), true});
        if (!first) first = last;
    }
    EXPECT_FALSE(calls.close(first->call, kRequest));
    EXPECT_TRUE(calls.close(last->call, kRequest));
}
