// Long messages survive being cut; what does not fit together gives nothing.
#include "dds/fragments.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss {
namespace {

std::vector<std::uint8_t> message_of(std::size_t size) {
    std::vector<std::uint8_t> message(size);
    for (std::size_t i = 0; i < size; ++i) message[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
    return message;
}

TEST(Fragments, MessagesOfAnyLengthComeBackWhole) {
    Assembly assembly;
    std::uint32_t serial = 0;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, kPieceBytesMax, kPieceBytesMax + 1, std::size_t{1'000'000}}) {
        const auto message = message_of(size);
        const auto pieces = cut_in_pieces(++serial, message);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            EXPECT_LE(pieces[i].size(), 65'000u) << "one datagram";
            const auto whole = assembly.take(pieces[i]);
            ASSERT_EQ(whole.has_value(), i + 1 == pieces.size());
            if (whole) {
                EXPECT_EQ(*whole, message);
            }
        }
    }
}

TEST(Fragments, AMessageWithAMissingPieceIsDroppedAndTheNextOneComes) {
    const auto message = message_of(3 * kPieceBytesMax);
    auto broken = cut_in_pieces(1, message);
    Assembly assembly;
    EXPECT_FALSE(assembly.take(broken[0]));
    EXPECT_FALSE(assembly.take(broken[2]));
    EXPECT_FALSE(assembly.take(broken[1])) << "a late piece may follow, but then the end is missing";
    std::optional<std::vector<std::uint8_t>> whole;
    for (const auto& piece : cut_in_pieces(2, message)) whole = assembly.take(piece);
    ASSERT_TRUE(whole);
    EXPECT_EQ(*whole, message);
}

TEST(Fragments, NoiseGivesNothingOrWhatItSays) {
    std::mt19937_64 random(3);
    Assembly assembly;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::uint8_t> noise(random() % 40);
        for (std::uint8_t& b : noise) b = static_cast<std::uint8_t>(random() % 3);
        if (const auto whole = assembly.take(noise)) {
            EXPECT_LE(whole->size(), 28u * 4);
        }
    }
}

}  // namespace
}  // namespace roboss
