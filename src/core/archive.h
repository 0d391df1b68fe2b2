// Writing and reading plain values as little-endian bytes. A message describes its fields once, as a function
// template over the archive, so that encoder and decoder cannot disagree. Reading past the end or an
// impossible count sets the reader's failure and gives zeros; it never throws, and never allocates for a
// count that the bytes cannot hold.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/types.h"

namespace roboss::wire {

static_assert(std::endian::native == std::endian::little,
              "the encoding is the memory of a little-endian machine");

template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Writer {
  public:
    static constexpr bool kReading = false;

    template <Scalar T>
    void scalar(const T& value) {
        raw(&value, sizeof(T));
    }
    void count(std::size_t n) { scalar(static_cast<std::uint32_t>(n)); }
    void raw(const void* data, std::size_t n) {
        if (n == 0) return;
        if (bytes_.size() - used_ < n) bytes_.resize(std::max(2 * bytes_.size(), used_ + n));
        std::memcpy(bytes_.data() + used_, data, n);
        used_ += n;
    }
    std::vector<std::uint8_t> take() {
        bytes_.resize(used_);
        used_ = 0;
        return std::move(bytes_);
    }

  private:
    std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(256);  // room for what comes
    std::size_t used_ = 0;
};

class Reader {
  public:
    static constexpr bool kReading = true;

    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    template <Scalar T>
    void scalar(T& value) {
        value = T{};
        if (!take(sizeof(T))) return;
        std::memcpy(&value, bytes_.data() + at_ - sizeof(T), sizeof(T));
    }
    /// A count of items of which each takes at least `bytes_each`.
    std::size_t count(std::size_t bytes_each) {
        std::uint32_t n = 0;
        scalar(n);
        return plausible(n, bytes_each);
    }
    /// The same of a count that was read.
    std::size_t plausible(std::uint64_t n, std::size_t bytes_each) {
        if (n > (bytes_.size() - at_) / bytes_each) fail("a count is larger than the bytes that follow");
        return failed() ? 0 : n;
    }
    void raw(void* data, std::size_t n) {
        if (take(n) && n > 0) std::memcpy(data, bytes_.data() + at_ - n, n);
    }
    void fail(const char* what) {
        if (failed_) return;
        failed_ = true;
        failure_ = what;
    }
    bool failed() const { return failed_; }
    const std::string& failure() const { return failure_; }
    std::size_t left() const { return bytes_.size() - at_; }

  private:
    bool take(std::size_t n) {
        if (n > bytes_.size() - at_) fail("the bytes end too early");
        if (failed()) return false;
        at_ += n;
        return true;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;  // asked at every field
    std::string failure_;
};

/// T as the archive needs it: const for a Writer.
template <class Archive, class T>
using Of = std::conditional_t<Archive::kReading, T, const T>;

template <class Archive, Scalar T>
requires(!std::same_as<T, bool>) void field(Archive& a, T& value) {
    a.scalar(const_cast<std::remove_const_t<T>&>(value));
}

inline void field(Writer& a, const bool& value) {
    a.scalar(static_cast<std::uint8_t>(value ? 1 : 0));
}
inline void field(Reader& a, bool& value) {
    std::uint8_t byte = 0;
    a.scalar(byte);
    if (byte > 1) a.fail("a yes-or-no is neither 0 nor 1");
    value = byte == 1;
}

/// A number that is mostly small: seven bits a byte, the lowest first.
inline void compact(Writer& a, std::uint64_t value) {
    for (; value > 0x7F; value >>= 7) a.scalar(static_cast<std::uint8_t>(value | 0x80));
    a.scalar(static_cast<std::uint8_t>(value));
}
inline void compact(Reader& a, std::uint64_t& value) {
    value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        std::uint8_t byte = 0;
        a.scalar(byte);
        value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
        if (shift == 63 && byte > 1) break;
        if (byte >= 0x80) continue;
        if (byte == 0 && shift > 0) break;  // each number is written in one way
        return;
    }
    a.fail("a number has too many bytes");
}
inline void compact(Reader& a, std::uint32_t& value) {
    std::uint64_t wide = 0;
    compact(a, wide);
    if (wide > 0xFFFFFFFFu) a.fail("a number is too large");
    value = static_cast<std::uint32_t>(wide);
}

template <class Tag>
void field(Writer& a, const Id<Tag>& id) {
    a.scalar(id.value);
}
template <class Tag>
void field(Reader& a, Id<Tag>& id) {
    a.scalar(id.value);
}

inline void field(Writer& a, const std::string& text) {
    a.count(text.size());
    a.raw(text.data(), text.size());
}
inline void field(Reader& a, std::string& text) {
    text.resize(a.count(1));
    a.raw(text.data(), text.size());
}

template <Scalar T, std::size_t N>
void field(Writer& a, const std::array<T, N>& values) {
    a.raw(values.data(), sizeof values);
}
template <Scalar T, std::size_t N>
void field(Reader& a, std::array<T, N>& values) {
    values = {};
    a.raw(values.data(), sizeof values);
}

}  // namespace roboss::wire
