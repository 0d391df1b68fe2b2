// The state hash: fixed for ever (golden values), and moved by one changed bit, by order and by length.
#include "core/hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <set>
#include <vector>

namespace roboss {
namespace {

template <class... Words>
std::uint64_t hash_of(Words... words) {
    Hash hash;
    (hash.add(words), ...);
    return hash.value();
}

// Recordings and golden state hashes depend on these: a change of one is a change for every user (changelog
// line).
TEST(Hash, ValuesAreFixedForEver) {
    EXPECT_EQ(to_hex(Hash().value()), "b800bd6c02472607");
    EXPECT_EQ(to_hex(hash_of(std::uint64_t{1}, std::uint64_t{2})), "637e890efd4281cc");
    EXPECT_EQ(to_hex(hash_of(0.1)), "afab6e1b789bcf73");
    EXPECT_EQ(to_hex(hash_of(std::string_view("a longer name"))), "55a9d5670cee33c2");
}

TEST(Hash, EveryOneOfTheBitsOfADoubleCounts) {
    const auto bits = std::bit_cast<std::uint64_t>(0.1);
    std::set<std::uint64_t> seen{hash_of(0.1)};
    for (int bit = 0; bit < 64; ++bit)
        seen.insert(hash_of(std::bit_cast<double>(bits ^ (std::uint64_t{1} << bit))));
    EXPECT_EQ(seen.size(), 65u);
}

TEST(Hash, OneChangedBitChangesAboutHalfOfTheHash) {
    int changed = 0;
    for (int bit = 0; bit < 64; ++bit) {
        changed += std::popcount(hash_of(std::uint64_t{0}) ^ hash_of(std::uint64_t{1} << bit));
    }
    EXPECT_GT(changed, 64 * 26);
    EXPECT_LT(changed, 64 * 38);
}

TEST(Hash, OrderAndLengthCount) {
    EXPECT_NE(hash_of(std::uint64_t{1}, std::uint64_t{2}), hash_of(std::uint64_t{2}, std::uint64_t{1}));
    EXPECT_NE(hash_of(std::uint64_t{0}), hash_of(std::uint64_t{0}, std::uint64_t{0}));
    EXPECT_NE(hash_of(std::string_view("ab"), std::string_view("c")),
              hash_of(std::string_view("a"), std::string_view("bc")));
    EXPECT_NE(hash_of(0.0), hash_of(-0.0));
}

TEST(Hash, ASpanOfDoublesIsItsDoublesOneByOne) {
    const std::vector<double> values{0.5, -1.25, 3e300};
    Hash hash;
    hash.add(std::span<const double>(values));
    EXPECT_EQ(hash.value(), hash_of(0.5, -1.25, 3e300));
}

TEST(Hash, HexHasSixteenLowerCaseDigits) {
    EXPECT_EQ(to_hex(0), "0000000000000000");
    EXPECT_EQ(to_hex(0x0123456789ABCDEFull), "0123456789abcdef");
}

}  // namespace
}  // namespace roboss
