// Text into the state hash, and the hash as text.
#include "core/hash.h"

namespace roboss {

void Hash::add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    std::uint64_t word = 0;
    int n = 0;
    for (unsigned char c : text) {
        word = word << 8 | c;
        if (++n == 8) {
            add(word);
            word = 0;
            n = 0;
        }
    }
    if (n > 0) add(word);
}

std::string to_hex(std::uint64_t value) {
    static const char* digits = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[15 - i] = digits[(value >> (4 * i)) & 15u];
    return text;
}

}  // namespace roboss
