// Reads UTF-8 (RFC 3629), one character after the other.
#include "core/printable.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace roboss {
namespace {

struct Character {
    char32_t code = 0;
    std::size_t bytes = 1;
    bool valid = false;
};

Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    Character c{byte(0), 1, byte(0) < 0x80};
    if (c.valid) return c;
    const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
    if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return c;
    char32_t code = byte(0) & (0x7Fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0u) != 0x80) return c;
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // by the number of bytes
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < kLeast[bytes] || code > 0x10FFFF || surrogate) return c;
    return {code, bytes, true};
}

bool is_shown(char32_t c) {
    if (c < 0x20) return c == '\n' || c == '\t';
    const bool is_control = c >= 0x7F && c <= 0x9F;
    const bool breaks_line = c == 0x2028 || c == 0x2029;
    const bool turns = c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) ||
                       (c >= 0x2066 && c <= 0x2069);
    return !is_control && !breaks_line && !turns;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const Character c = first_of(text);
        if (c.valid && is_shown(c.code))
            shown.append(text.substr(0, c.bytes));
        else
            shown += '?';
        text.remove_prefix(c.bytes);
    }
    return shown;
}

std::string printable_line(std::string_view text) {
    std::string line = printable(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return line;
}

}  // namespace roboss
