#include "protobuf.h"

namespace soccer::protobuf {

std::optional<std::uint64_t> Reader::varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
        const auto byte = static_cast<unsigned char>(rest_.front());
        rest_.remove_prefix(1);
        value |= static_cast<std::uint64_t>(byte & 0x7fu) << shift;
        if ((byte & 0x80u) == 0) return value;
    }
    return std::nullopt;
}

/// Little-endian.
std::optional<std::uint64_t> Reader::fixed(std::size_t size) {
    if (rest_.size() < size) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(rest_[i])) << (8 * i);
    rest_.remove_prefix(size);
    return value;
}

std::optional<Field> Reader::fail() {
    damaged_ = true;
    rest_ = {};
    return std::nullopt;
}

std::optional<Field> Reader::next() {
    if (rest_.empty()) return std::nullopt;
    const auto key = varint();
    if (!key || *key >> 3 == 0 || *key >> 32 != 0) return fail();
    Field field;
    field.number = static_cast<std::uint32_t>(*key >> 3);
    field.type = static_cast<Field::Type>(*key & 7u);
    std::optional<std::uint64_t> value;
    switch (field.type) {
        case Field::Type::kVarint:
            value = varint();
            break;
        case Field::Type::k64:
            value = fixed(8);
            break;
        case Field::Type::k32:
            value = fixed(4);
            break;
        case Field::Type::kBytes:
            value = varint();
            if (!value || *value > rest_.size()) return fail();
            field.bytes = rest_.substr(0, *value);
            rest_.remove_prefix(*value);
            break;
        default:
            return fail();
    }
    if (!value) return fail();
    field.bits = *value;
    return field;
}

void Writer::varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<char>(value | 0x80u));
    bytes_.push_back(static_cast<char>(value));
}

Writer& Writer::uint(std::uint32_t number, std::uint64_t value) {
    varint(number << 3);
    varint(value);
    return *this;
}

Writer& Writer::real(std::uint32_t number, double value) {
    varint(number << 3 | static_cast<unsigned>(Field::Type::k64));
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i) bytes_.push_back(static_cast<char>(bits >> (8 * i)));
    return *this;
}

Writer& Writer::message(std::uint32_t number, const Writer& value) {
    varint(number << 3 | static_cast<unsigned>(Field::Type::kBytes));
    varint(value.bytes_.size());
    bytes_ += value.bytes_;
    return *this;
}

}  // namespace soccer::protobuf
