// How many changed inputs a test of a decoder tries.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace roboss::test {

/// `usual`, or as many times more as the variable ROBOSS_FUZZ_ROUNDS is greater than 3000 (docs/testing.md):
/// cheap decoders get more rounds than expensive ones.
inline std::size_t fuzz_rounds(std::size_t usual) {
    const char* wanted = std::getenv("ROBOSS_FUZZ_ROUNDS");
    return wanted == nullptr ? usual : 1 + usual * std::strtoull(wanted, nullptr, 10) / 3'000;
}

}  // namespace roboss::test
