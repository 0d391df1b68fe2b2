// Frames come out as they went in, however the stream is cut; and whatever bytes come, a reader takes them or
// says that the stream is broken. More rounds: ROBOSS_FUZZ_ROUNDS=1000000 (docs/testing.md).
#include "net/frames.h"

#include <gtest/gtest.h>

#include <support/fuzz_rounds.h>
#include <random>

#include "wire/codec.h"

namespace roboss {
namespace {

std::vector<std::uint8_t> noise(std::mt19937_64& random, std::size_t most) {
    std::vector<std::uint8_t> bytes(random() % (most + 1));
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
    return bytes;
}

std::vector<std::uint8_t> content_of(FrameKind kind, std::mt19937_64& random) {
    switch (kind) {
        case FrameKind::kHello:
            return encode_hello({kWireVersion, "city", "simulator", "node7/4711"});
        case FrameKind::kRefuse:
            return encode_refusal({"bad-certificate", "the certificate of 'sim-3' has expired"});
        case FrameKind::kOwn:
            return encode_address({Role::kClient, random()});
        case FrameKind::kOver:
            return encode_farewell({"its duration was over", true});
        default:
            return noise(random, 300);
    }
}

constexpr FrameKind kKinds[] = {FrameKind::kHello, FrameKind::kAccept, FrameKind::kRefuse,
                                FrameKind::kPing,  FrameKind::kWhole,  FrameKind::kPiece,
                                FrameKind::kLast,  FrameKind::kOwn,    FrameKind::kOver};

/// All contents of this kind are read, as a peer would.
void decode(const Frame& frame) {
    if (frame.kind == FrameKind::kHello) (void)decode_hello(frame.content).ok();
    if (frame.kind == FrameKind::kOwn) (void)decode_address(frame.content).ok();
    if (frame.kind == FrameKind::kRefuse) {
        EXPECT_LT(decode_refusal(frame.content).reason.size(), 1'000u);
    }
    if (frame.kind == FrameKind::kOver) {
        EXPECT_LT(decode_farewell(frame.content).reason.size(), 1'000u);
    }
    if (frame.kind == FrameKind::kWhole) (void)decode_ends(frame.content).ok();
}

/// Feeds the stream in pieces of any length. The frames that came.
std::vector<std::pair<FrameKind, std::vector<std::uint8_t>>> read(const std::vector<std::uint8_t>& stream,
                                                                  std::mt19937_64& random,
                                                                  FrameReader& reader) {
    std::vector<std::pair<FrameKind, std::vector<std::uint8_t>>> frames;
    for (std::size_t at = 0; at < stream.size();) {
        const std::size_t length = std::min<std::size_t>(1 + random() % 200, stream.size() - at);
        reader.buffer().insert(reader.buffer().end(), stream.begin() + static_cast<std::ptrdiff_t>(at),
                               stream.begin() + static_cast<std::ptrdiff_t>(at + length));
        at += length;
        for (Frame frame; reader.next(frame);) {
            frames.emplace_back(frame.kind,
                                std::vector<std::uint8_t>(frame.content.begin(), frame.content.end()));
            decode(frame);
        }
    }
    return frames;
}

TEST(Frames, ComeOutAsTheyWentInHoweverTheStreamIsCut) {
    std::mt19937_64 random(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::pair<FrameKind, std::vector<std::uint8_t>>> sent;
        std::vector<std::uint8_t> stream;
        for (int i = 0; i < 20; ++i) {
            const FrameKind kind = kKinds[random() % std::size(kKinds)];
            sent.emplace_back(kind, content_of(kind, random));
            append_frame(stream, kind, sent.back().second);
        }
        FrameReader reader;
        EXPECT_EQ(read(stream, random, reader), sent);
        EXPECT_TRUE(reader.broken().empty());
    }
}

TEST(Frames, AnyBytesAreTakenOrTheStreamIsBroken) {
    const std::size_t rounds = test::fuzz_rounds(3'000);
    std::mt19937_64 random(11);
    std::size_t broken = 0, whole = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        std::vector<std::uint8_t> stream;
        for (std::uint64_t i = random() % 4; i > 0; --i) {
            const FrameKind kind = kKinds[random() % std::size(kKinds)];
            append_frame(stream, kind, content_of(kind, random));
        }
        for (std::uint64_t k = random() % 4; k > 0 && !stream.empty(); --k)
            stream[random() % stream.size()] = static_cast<std::uint8_t>(random());
        const std::vector<std::uint8_t> more = noise(random, random() % 4 == 0 ? 40 : 0);
        stream.insert(stream.end(), more.begin(), more.end());
        FrameReader reader;
        (void)read(stream, random, reader);
        (reader.broken().empty() ? whole : broken) += 1;
        EXPECT_LE(reader.buffer().size(), stream.size());
    }
    EXPECT_GT(broken, rounds / 20);
    EXPECT_GT(whole, rounds / 20);
}

TEST(Frames, ContentsSurviveTheirBytes) {
    const Result<Caller> hello = decode_hello(encode_hello({kWireVersion, "city", "client", "node7/4711"}));
    ASSERT_TRUE(hello.ok());
    EXPECT_EQ(hello.value().simulation, "city");
    EXPECT_EQ(hello.value().name, "node7/4711");
    const RunOver over = decode_farewell(encode_farewell({"no fuel\n  remedy: fill it up", true}));
    EXPECT_TRUE(over.failed);
    EXPECT_EQ(over.reason, "no fuel\n  remedy: fill it up");
    EXPECT_EQ(decode_refusal(encode_refusal({"a", "b"})).reason, "b");
    EXPECT_EQ(decode_address(encode_address({Role::kClient, 77})).value(), (Address{Role::kClient, 77}));
}

}  // namespace
}  // namespace roboss
