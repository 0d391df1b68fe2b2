// CDR: the bytes of a message of ROS 2 on the wire and in recordings (OMG CDR version 1, as all ROS 2
// middlewares use it): four bytes that say how it is encoded, then the fields in order, each number aligned
// to its size. Written in little-endian order, read in both.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "core/result.h"
#include "ros2_types/field_types.h"

namespace roboss::ros2 {

/// Appends fields to bytes.
class CdrWriter {
  public:
    CdrWriter() : bytes_(std::string("\0\1\0\0", kHead)) {}

    /// visit() of Message::fields.
    template <class T>
    void operator()(const char*, const T& value) {
        write(value);
    }
    /// Appends all fields of a message, or one value.
    template <class T>
    void write(const T& value) {
        if constexpr (Message<T>)
            T::fields(*this, value);
        else if constexpr (Primitive<T>)
            numbers(&value, 1);
        else if constexpr (std::is_same_v<T, std::string>) {
            write(static_cast<std::uint32_t>(value.size() + 1));
            bytes_.append(value.c_str(), value.size() + 1);
        } else {
            if constexpr (kIsSequence<T>) write(static_cast<std::uint32_t>(value.size()));
            if constexpr (Primitive<typename T::value_type> && !std::is_same_v<T, std::vector<bool>>)
                numbers(value.data(), value.size());
            else
                for (const auto& each : value) write(each);
        }
    }
    /// All bytes so far.
    std::string take() { return std::move(bytes_); }

  private:
    static constexpr std::size_t kHead =
        4;  // bytes that say how the rest is encoded; alignment begins behind

    template <Primitive T>
    void numbers(const T* first, std::size_t count) {
        static_assert(std::endian::native == std::endian::little);
        if (count == 0) return;
        const std::size_t at = bytes_.size() - kHead;
        bytes_.append((sizeof(T) - at % sizeof(T)) % sizeof(T), '\0');
        bytes_.append(reinterpret_cast<const char*>(first), count * sizeof(T));
    }

    std::string bytes_;
};

/// Reads fields from bytes. After the first that does not fit, it reads nothing more.
class CdrReader {
  public:
    /// Reads the bytes of a whole message.
    explicit CdrReader(std::string_view bytes) {
        if (bytes.size() < 4 || bytes[0] != 0 || (bytes[1] != 0 && bytes[1] != 1)) {
            fail("it does not begin as CDR");
            return;
        }
        swapped_ = bytes[1] == 0;
        rest_ = bytes.substr(4);
    }

    /// visit() of Message::fields.
    template <class T>
    void operator()(const char* name, T& value) {
        if (problem_.empty()) read(name, value);
    }
    /// Why the bytes are no such message; empty: they are one. Bytes behind the last field do not count.
    const std::string& problem() const { return problem_; }

  private:
    template <class T>
    static constexpr std::size_t least_bytes() {
        return Primitive<T> ? sizeof(T) : 1;
    }

    template <class T>
    void read(const char* name, T& value) {
        if constexpr (Message<T>)
            T::fields(*this, value);
        else if constexpr (Primitive<T>)
            numbers(name, &value, 1);
        else if constexpr (std::is_same_v<T, std::string>)
            text(name, value);
        else if constexpr (kIsSequence<T>) {
            std::uint32_t count = 0;
            numbers(name, &count, 1);
            // No count can ask for more memory than there are bytes.
            if (count > (rest_.size() - at_) / least_bytes<typename T::value_type>())
                return fail(name, "its length");
            if (kBound < T >> 0 && count > kBound<T>) return fail("'" + std::string(name) + "' is too long");
            if (!problem_.empty()) return;
            if constexpr (Primitive<typename T::value_type>) {
                value.resize(count);
                elements(name, value);
            } else {
                value.clear();  // it grows as elements are read: each is larger here than its bytes
                while (value.size() < count && problem_.empty()) read(name, value.emplace_back());
            }
        } else
            elements(name, value);
    }
    template <class T>
    void elements(const char* name, T& values) {
        if constexpr (std::is_same_v<T, std::vector<bool>>)
            for (std::size_t i = 0; i < values.size(); ++i) {
                bool value = false;
                numbers(name, &value, 1);
                values[i] = value;
            }
        else if constexpr (Primitive<typename T::value_type>)
            numbers(name, values.data(), values.size());
        else
            for (auto& each : values) {
                if (!problem_.empty()) return;
                read(name, each);
            }
    }
    void text(const char* name, std::string& value) {
        std::uint32_t size = 0;
        numbers(name, &size, 1);
        if (!problem_.empty()) return;
        if (size > rest_.size() - at_) return fail(name, "its length");
        const std::string_view all = rest_.substr(at_, size);
        value = all.substr(0, all.find('\0'));
        at_ += size;
    }
    template <Primitive T>
    void numbers(const char* name, T* first, std::size_t count) {
        if (!problem_.empty() || count == 0) return;
        const std::size_t start = at_ + (sizeof(T) - at_ % sizeof(T)) % sizeof(T);
        if (start > rest_.size() || count > (rest_.size() - start) / sizeof(T))
            return fail(name, "its bytes");
        if constexpr (std::is_same_v<T, bool>) {
            for (std::size_t i = 0; i < count; ++i) first[i] = rest_[start + i] != 0;
        } else {
            std::memcpy(first, rest_.data() + start, count * sizeof(T));
            if (swapped_ && sizeof(T) > 1)
                for (std::size_t i = 0; i < count; ++i) {
                    char* const bytes = reinterpret_cast<char*>(first + i);
                    std::reverse(bytes, bytes + sizeof(T));
                }
        }
        at_ = start + count * sizeof(T);
    }
    void fail(const char* name, const char* part) {
        fail("'" + std::string(name) + "': " + part + " reach beyond the end");
    }
    void fail(std::string problem) {
        if (problem_.empty()) problem_ = std::move(problem);
        at_ = rest_.size();
    }

    std::string_view rest_;
    std::size_t at_ = 0;  // in rest_
    bool swapped_ = false;
    std::string problem_;
};

/// The bytes of a message.
template <Message M>
std::string to_cdr(const M& message) {
    CdrWriter writer;
    writer.write(message);
    return writer.take();
}

/// The message of these bytes. An Error, "bad-message", names the field at which they end.
template <Message M>
Result<M> from_cdr(std::string_view bytes) {
    M message;
    CdrReader reader(bytes);
    M::fields(reader, message);
    if (!reader.problem().empty())
        return Error{"these bytes are no " + std::string(M::kName) + ": " + reader.problem(),
                     "send messages of this type", "bad-message"};
    return message;
}

}  // namespace roboss::ros2
