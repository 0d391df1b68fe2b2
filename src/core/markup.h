// Text within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace roboss {

/// The text with the characters that mark XML replaced by their entities: it may stand in a value or in an
/// attribute between double quotes.
inline std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

}  // namespace roboss
