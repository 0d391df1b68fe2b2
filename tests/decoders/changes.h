// Changes of good bytes, by seed, and what is done with them: a decoder must take them or refuse them.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/result.h"

namespace roboss::test {

/// A decoder of this test. `read` returns true if it takes the bytes; it fails the test itself if a refusal
/// gives no reason.
struct Decoder {
    std::string name;
    std::vector<std::string> good;  // inputs that it takes
    std::size_t rounds = 1'000;     // changed ones that it gets, see fuzz_rounds()
    std::function<bool(const std::string& bytes, std::size_t which)>
        read;  // `which`: of the good ones it comes from
};

/// True if it was read; fails the test if a refusal gives no reason.
template <class T>
bool taken(const Result<T>& read) {
    if (read.ok()) return true;
    EXPECT_FALSE(read.error().message.empty());
    return false;
}

/// The bytes of a file.
std::string contents(const std::filesystem::path& file);

/// One to three changes: bits, bytes, numbers and words, pieces that are cut, repeated or swapped.
std::string changed(const std::string& good, std::size_t seed);

/// Feeds the good inputs, the kept cases of `cases`/NAME, and changed inputs. Where the process ends by a
/// signal, the input stays as a file in the current folder, whose name is printed.
void expect_total(const Decoder& decoder, const std::string& cases);

}  // namespace roboss::test
