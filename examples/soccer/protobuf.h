// The wire format of Protocol Buffers for small messages of numbers
// (https://protobuf.dev/programming-guides/encoding): a reader of fields and a writer. No library and no
// generated code, so that a team's protocol costs no dependency.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace soccer::protobuf {

/// One field of a message.
struct Field {
    enum class Type : unsigned { kVarint = 0, k64 = 1, kBytes = 2, k32 = 5 };
    std::uint32_t number = 0;
    Type type = Type::kVarint;
    std::uint64_t bits = 0;  // of a number
    std::string_view bytes;  // of a message or text

    /// A double, or a float where the sender has one.
    double real() const {
        return type == Type::k32 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                                 : std::bit_cast<double>(bits);
    }
};

/// Reads one field after the other. Unknown fields are returned like others: skip them.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    /// The next field; nothing at the end, or where the bytes are damaged.
    std::optional<Field> next();
    bool damaged() const { return damaged_; }

  private:
    std::optional<std::uint64_t> varint();
    std::optional<std::uint64_t> fixed(std::size_t size);
    std::optional<Field> fail();

    std::string_view rest_;
    bool damaged_ = false;
};

class Writer {
  public:
    Writer& uint(std::uint32_t number, std::uint64_t value);
    Writer& real(std::uint32_t number, double value);  // a double
    Writer& message(std::uint32_t number, const Writer& value);
    const std::string& bytes() const { return bytes_; }

  private:
    void varint(std::uint64_t value);
    std::string bytes_;
};

}  // namespace soccer::protobuf
