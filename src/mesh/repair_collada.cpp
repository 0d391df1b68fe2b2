// Works on the text: a second XML parser would be too much for so little.
#include "mesh/repair_collada.h"

#include <cctype>

namespace roboss {
namespace {

bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool begins_number(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
}

/// assimp 5.2 skips white space after a number, not before the first.
std::string without_leading_space(const std::string& text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        result += text[i];
        if (text[i] != '>') continue;
        std::size_t next = i + 1;
        while (next < text.size() && is_space(text[next])) ++next;
        if (next < text.size() && begins_number(text[next])) i = next - 1;
    }
    return result;
}

/// Takes every element of this name out of the text, from its opening tag to its closing one.
std::string without(std::string text, const std::string& element) {
    const std::string open = "<" + element, close = "</" + element + ">";
    std::size_t from = 0;
    while ((from = text.find(open, from)) != std::string::npos) {
        const std::size_t after = from + open.size();
        if (after >= text.size() || (!is_space(text[after]) && text[after] != '>' && text[after] != '/')) {
            from = after;  // a longer name
            continue;
        }
        const std::size_t tag_end = text.find('>', after);
        if (tag_end == std::string::npos) break;
        std::size_t end = tag_end + 1;
        if (text[tag_end - 1] != '/') {
            const std::size_t closing = text.find(close, tag_end);
            if (closing == std::string::npos) break;
            end = closing + close.size();
        }
        text.erase(from, end - from);
    }
    return text;
}

}  // namespace

std::string repaired_collada(const std::string& text) {
    std::string result = without_leading_space(text);
    for (const char* element : {"texture", "library_images", "library_animations", "library_controllers"})
        result = without(std::move(result), element);
    return result;
}

}  // namespace roboss
