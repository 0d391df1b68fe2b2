// The 64-bit state hash: a fixed, portable function of a sequence of 64-bit words (multiply-rotate-xor;
// finaliser of MurmurHash3 by Appleby, public domain constants). Doubles enter by their bits, so one changed
// bit changes the hash.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace roboss {

/// Hash of a sequence of words. The order counts. Not cryptographic.
class Hash {
  public:
    /// Adds one word.
    void add(std::uint64_t word) {
        h_ ^= word * 0x9E3779B97F4A7C15ull;
        h_ = std::rotl(h_, 29) * 0xBF58476D1CE4E5B9ull + 0x94D049BB133111EBull;
    }
    /// Adds the bits of a number: 0.0 and -0.0 differ.
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    /// Adds each number; the length does not count.
    void add(std::span<const double> values) {
        for (double v : values) add(v);
    }
    /// Adds a text.
    void add(std::string_view text);

    /// The hash of all that was added so far.
    std::uint64_t value() const {
        std::uint64_t h = h_;
        h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDull;
        h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53ull;
        return h ^ (h >> 33);
    }

  private:
    std::uint64_t h_ = 0x2545F4914F6CDD1Dull;
};

/// 16 lower-case hex digits.
std::string to_hex(std::uint64_t value);

}  // namespace roboss
