// See similar.h.
#include "core/similar.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace roboss {
namespace {

/// Letters to change, add, leave out, or swap with their neighbour, from one word to the other (Damerau
/// 1964).
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> older, before(b.size() + 1), now(b.size() + 1);
    std::iota(before.begin(), before.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] =
                std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], older[j - 2] + 1);
        }
        older = std::exchange(before, now);
    }
    return before.back();
}

}  // namespace

std::string similar_to(const std::string& word, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t d = word.size() > 2 && name.starts_with(word) ? 1 : distance(word, name);
        if (d < least) least = d, best = name;
    }
    return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise) {
    const std::string name = similar_to(word, names);
    return name.empty() ? otherwise : "did you mean '" + name + "'?";
}

std::string pattern_of(const std::string& text) {
    std::string pattern;
    bool in_quotes = false;
    for (const char c : text) {
        if (c == '\'') in_quotes = !in_quotes;
        if (!in_quotes && std::isdigit(static_cast<unsigned char>(c)) == 0) pattern += c;
    }
    return pattern;
}

}  // namespace roboss
